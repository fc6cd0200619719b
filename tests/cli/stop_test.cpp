// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gmock/gmock.h>
#include <csignal>
#include <thread>

#include "program.h"

namespace hooke::test {
namespace {

using testing::HasSubstr;

// Runs that are stopped from outside, and go on.
class Stop : public ProgramTest {
 protected:
  static constexpr int kEnd = 4000;

  void SetUp() override {
    write("s.json", small_scene());
    hooke_ok({"run", "s.json", "-o", "whole", "--steps", std::to_string(kEnd)});
  }

  std::vector<std::string> command(const std::string& checkpoint) const {
    std::vector<std::string> arguments{"run", "s.json", "-o", "out", "--steps", std::to_string(kEnd)};
    if (!checkpoint.empty()) arguments.insert(arguments.end(), {"--resume", checkpoint});
    return arguments;
  }

  // Starts the run and sends it `signal` after it has gone some way; returns its outcome.
  Outcome stop_by(int signal) {
    Program program = start(command(""));
    EXPECT_TRUE(wait_until([this] { return exists("out/checkpoint.h5"); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    program.send(signal);
    return program.wait();
  }

  void expect_same_as_whole() {
    hooke_ok(command("out/checkpoint.h5"));
    EXPECT_EQ(state_hash("out"), state_hash("whole"));
    EXPECT_EQ(export_all("out"), export_all("whole"));
  }
};

TEST_F(Stop, AnInterruptLeavesACheckpointFromWhichTheRunGoesOn) {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) {
    const Outcome stopped = stop_by(signal);
    EXPECT_EQ(stopped.status, 130) << stopped.err;
    EXPECT_THAT(stopped.err, HasSubstr("--resume"));
    EXPECT_TRUE(exists("out/report.json"));
    expect_same_as_whole();
    std::filesystem::remove_all(path("out"));
  }
}

TEST_F(Stop, AKillLeavesACheckpointFromWhichTheRunGoesOn) {
  const Outcome killed = stop_by(SIGKILL);
  EXPECT_EQ(killed.status, 128 + SIGKILL);
  EXPECT_THAT(hooke_ok({"info", "out"}), HasSubstr("checkpoint"));
  expect_same_as_whole();
}

}  // namespace
}  // namespace hooke::test
