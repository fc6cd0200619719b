// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// One call of the operating system fails, each in turn: what was there before stays, and the run goes on to the same
// end.
#include <gmock/gmock.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <sstream>

#include "hooke/io/run_folder.h"
#include "program.h"

namespace hooke::test {
namespace {

/// Balls, a cloth that tears, births and deaths: every table of a checkpoint, and snapshots of changing length.
constexpr const char* kScene = R"({"hooke": 1, "name": "faults", "time": {"step": 0.001, "steps": 42},
  "domain": {"min": [0, 0, 0], "max": [3, 3, 3], "walls": ["spring", "open", "periodic"]}, "gravity": [0.3, -2, 0.1],
  "materials": {"ball": {"radius": 0.06, "mass": 1, "stiffness": 2000, "damping": 3},
                "linen": {"radius": 0.04, "mass": 0.2, "stiffness": 1000, "damping": 1}},
  "particles": [{"material": "ball", "velocity": [0.5, 0, 0.2],
                 "block": {"min": [0.2, 1.5, 0.2], "max": [2.8, 2.8, 2.8], "spacing": 0.3}}],
  "cloths": [{"material": "linen", "corner": [0.4, 1.2, 0.4], "edges": [[2, 0, 0], [0, 0, 2]], "cells": [8, 8],
              "stretch": 600, "bend": 6, "pins": ["edge:0", "edge:2"], "break_strain": 0.12}],
  "emitters": [{"material": "ball", "shape": {"sphere": {"center": [1.5, 2.2, 1.5], "radius": 0.7}}, "rate": 2000,
                "life": [0.01, 0.05]}],
  "output": {"every_steps": 7}})";

class Faults : public ProgramTest {
 protected:
  void SetUp() override {
    write("s.json", kScene);
    hooke_ok(arguments({"-o", "whole"}));
    hooke_ok(arguments({"-o", "half", "--steps", "20"}));
    expected_ = export_all("whole");
  }

  static std::vector<std::string> arguments(std::vector<std::string> more) {
    std::vector<std::string> all{"run", "s.json", "--threads", "1", "--quiet", "--checkpoint-every", "0.006"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// A copy of the run that ended at step 20, to be continued.
  std::vector<std::string> resumed(const std::string& run) {
    std::filesystem::remove_all(path(run));
    std::filesystem::copy(path("half"), path(run), std::filesystem::copy_options::recursive);
    return arguments({"-o", run, "--resume", run + "/checkpoint.h5"});
  }
  /// How many calls of a kind a program makes.
  long count(const std::string& call, const std::vector<std::string>& program) {
    hooke(program, {"LD_PRELOAD=" + faults_library(), "HOOKE_FAULT_COUNT=" + path("counts").string()});
    std::istringstream lines(read("counts"));
    std::string name;
    for (long n = 0; lines >> name >> n;) {
      if (name == call) return n;
    }
    return 0;
  }
  Outcome failing(const std::string& call, long n, int error, const std::vector<std::string>& program) {
    return hooke(program, {"LD_PRELOAD=" + faults_library(),
                           "HOOKE_FAULT=" + call + ':' + std::to_string(n) + ':' + std::to_string(error)});
  }

  /// The run keeps its first three snapshots, of steps 0, 7 and 14, and goes on to the end of the undisturbed one.
  void expect_whole(const std::string& run) {
    const auto reader = io::RunReader::open(path(run));
    ASSERT_TRUE(reader) << reader.error().text();
    for (const std::int64_t step : {0, 7, 14}) EXPECT_TRUE(reader->find_step(step)) << step;
    hooke_ok(arguments({"-o", run, "--resume", run + "/checkpoint.h5"}));
    EXPECT_TRUE(export_all(run) == expected_);
    EXPECT_EQ(state_hash(run), state_hash("whole"));
  }

  /// Lets calls of a kind fail while a run is continued, about `most` of all that it makes, each in a run of its own.
  void let_fail(const std::string& call, int error, long most) {
    const long calls = count(call, resumed("z"));
    ASSERT_GT(calls, 0) << call;
    const long stride = std::max(calls / most, 1L);
    for (long n = (stride + 1) / 2; n <= calls; n += stride) {
      SCOPED_TRACE(call + ' ' + std::to_string(n));
      const Outcome outcome = failing(call, n, error, resumed("z"));
      EXPECT_LE(outcome.status, 3) << outcome.err;  // no signal
      if (outcome.status == 0) {
        EXPECT_EQ(state_hash("z"), state_hash("whole"));
      } else {
        EXPECT_NE(outcome.err, "");
      }
      expect_whole("z");
      if (HasFailure()) return;
    }
  }

  std::string expected_;
};

constexpr long kFew = 3;
TEST_F(Faults, AFailedWriteLosesNothing) { let_fail("pwrite", ENOSPC, 2 * kFew); }
TEST_F(Faults, AFailedSyncLosesNothing) { let_fail("fsync", EIO, kFew); }
TEST_F(Faults, AFailedRenameLosesNothing) { let_fail("rename", EIO, kFew); }
TEST_F(Faults, AFailedRemovalLosesNothing) { let_fail("unlink", EIO, kFew); }
TEST_F(Faults, AFailedTruncationLosesNothing) { let_fail("ftruncate", EIO, kFew); }
TEST_F(Faults, AFailedReadIsNoAbsence) { let_fail("pread", EIO, 2 * kFew); }

class EveryFault : public Faults, public testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(Calls, EveryFault,
                         testing::Values("pread", "pwrite", "fsync", "rename", "unlink", "ftruncate"),
                         [](const auto& call) { return std::string(call.param); });
TEST_P(EveryFault, LosesNothing) {
  let_fail(GetParam(), GetParam() == std::string("pwrite") ? ENOSPC : EIO, std::numeric_limits<long>::max());
}

// A run without snapshots is not the same as one whose snapshots can't be read.
TEST_F(Faults, AFailedReadIsNoMissingSnapshot) {
  const std::string info = hooke_ok({"info", "half"});
  const long calls = count("pread", {"info", "half"});
  ASSERT_GT(calls, 0);
  for (long n = 1; n <= calls; n += std::max(calls / 8, 1L)) {
    const Outcome outcome = failing("pread", n, EIO, {"info", "half"});
    EXPECT_TRUE(outcome.status == 0 ? outcome.out == info : outcome.status <= 3) << n << outcome.out << outcome.err;
  }
}

}  // namespace
}  // namespace hooke::test
