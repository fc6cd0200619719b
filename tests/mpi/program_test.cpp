// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "cli/program.h"
#include "support/bundled_scenes.h"

namespace hooke::test {
namespace {

using testing::HasSubstr;
using testing::Not;

using Words = std::vector<std::string>;

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

// The program, started by mpirun on this machine.
class Ranks : public ProgramTest {
 protected:
  void SetUp() override {
    const std::string mpirun = HOOKE_MPIRUN;
    if (mpirun.empty()) GTEST_SKIP() << "this build has no MPI (HOOKE_MPI)";
    if (!std::filesystem::exists(mpirun)) GTEST_SKIP() << mpirun << " is not there";
    // Also as root in a container, on fewer cores than ranks, beside other tests.
    for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM",
                             "OMPI_MCA_rmaps_base_oversubscribe", "OMPI_MCA_mpi_yield_when_idle"}) {
      setenv(name, "1", 1);
    }
    setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 1);
    write("s.json", pool_scene(12, "symplectic-euler", "single"));
  }

  static Words command(int ranks, const Words& arguments) {
    Words words{"-q", "-np", std::to_string(ranks), program_file()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
  }
  Program start_on(int ranks, const Words& arguments) const {
    return start_other(HOOKE_MPIRUN, command(ranks, arguments));
  }
  Outcome on(int ranks, const Words& arguments) const { return start_on(ranks, arguments).wait(); }
  void ok_on(int ranks, const Words& arguments) const {
    const Outcome outcome = on(ranks, arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }

  // The report without what differs from run to run, and with the number of ranks.
  nlohmann::json figures(const std::string& run) const {
    nlohmann::json report = nlohmann::json::parse(read(run + "/report.json"));
    for (const char* key : {"seconds", "stages", "steps_per_second", "particle_steps_per_second", "peak_bytes",
                            "program_bytes", "ranks", "threads", "costs", "slots_per_particle", "neighbour_rebuilds"}) {
      report.erase(key);
    }
    return report;
  }
  void expect_equal_runs(const std::string& a, const std::string& b) const {
    EXPECT_EQ(state_hash(a), state_hash(b));
    EXPECT_EQ(figures(a), figures(b));
    EXPECT_EQ(read(a + "/series.csv"), read(b + "/series.csv"));
    for (const std::string file : {"/scene.json", "/particles.vtkhdf", "/checkpoint.h5"})
      EXPECT_TRUE(read(a + file) == read(b + file)) << a << ", " << b << ": " << file;
  }

  // Status 2, so many errors, each once, and no folder.
  void expect_refusal(const Outcome& outcome, std::size_t errors, const std::string& part) const {
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_EQ(times(outcome.err, "error: "), errors) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(part));
    EXPECT_FALSE(exists("out"));
  }
};

// Runs on ranks -------------------------------------------------------------------------------------------------------

TEST_F(Ranks, AnyNumberGivesTheSameFiles) {
  for (const char* integrator : {"symplectic-euler", "velocity-verlet"}) {
    for (const char* precision : {"single", "double"}) {
      write("s.json", pool_scene(12, integrator, precision));
      hooke_ok({"run", "s.json", "-o", "alone", "--overwrite"});
      for (const int ranks : {1, 2, 3, 4}) {
        SCOPED_TRACE(std::string(integrator) + ", " + precision + ", ranks " + std::to_string(ranks));
        ok_on(ranks, {"run", "s.json", "-o", "ranks", "--overwrite"});
        expect_equal_runs("ranks", "alone");
        EXPECT_EQ(nlohmann::json::parse(read("ranks/report.json")).at("ranks"), ranks);
      }
    }
  }
}

TEST_F(Ranks, ARunGoesOnWithAnotherNumberOfThem) {
  hooke_ok({"run", "s.json", "-o", "whole"});
  for (const auto& [first, second] : {std::pair{3, 2}, {2, 4}, {1, 3}, {2, 1}}) {
    SCOPED_TRACE(std::to_string(first) + " ranks, then " + std::to_string(second));
    ok_on(first, {"run", "s.json", "-o", "part", "--overwrite", "--steps", "30"});
    ok_on(second, {"run", "s.json", "-o", "part", "--resume", "part/checkpoint.h5"});
    EXPECT_EQ(state_hash("part"), state_hash("whole"));
    EXPECT_TRUE(read("part/checkpoint.h5") == read("whole/checkpoint.h5"));
    EXPECT_EQ(read("part/series.csv"), read("whole/series.csv"));
  }
}

TEST_F(Ranks, ComputeSpringsBirthsAndAttraction) {
  for (const char* name : {"cloth", "fountain", "galaxy"}) {
    SCOPED_TRACE(name);
    const std::string scene = (bundled_folder() / (std::string(name) + ".json")).string();
    hooke_ok({"run", scene, "-o", "alone", "--overwrite", "--steps", "12"});
    ok_on(2, {"run", scene, "-o", "ranks", "--overwrite", "--steps", "12"});
    expect_equal_runs("ranks", "alone");
  }
}

TEST_F(Ranks, EachHasItsThreads) {
  hooke_ok({"run", "s.json", "-o", "alone"});
  ok_on(2, {"run", "s.json", "-o", "ranks", "--threads", "3"});
  expect_equal_runs("ranks", "alone");
  const auto report = nlohmann::json::parse(read("ranks/report.json"));
  EXPECT_EQ(report.at("ranks"), 2);
  EXPECT_EQ(report.at("threads"), 6);
}

TEST_F(Ranks, MayHaveDifferentInstructionSets) {
  hooke_ok({"run", "s.json", "-o", "alone"});
  const Outcome mixed = start_other(HOOKE_MPIRUN, {"-q", "-np", "1", program_file(), "run", "s.json", "-o", "ranks",
                                                   ":", "-np", "1", "-x", "HOOKE_ISA=portable", program_file()})
                            .wait();
  EXPECT_EQ(mixed.status, 0) << mixed.err;
  EXPECT_EQ(state_hash("ranks"), state_hash("alone"));
}

TEST_F(Ranks, BenchHasTheBitsOfOne) {
  const Words arguments{"bench", "s.json", "--steps", "20", "--warmup", "10", "--json"};
  const auto alone = nlohmann::json::parse(hooke_ok(arguments));
  const Outcome outcome = on(3, arguments);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto ranks = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(ranks.at("state_hash"), alone.at("state_hash"));
  EXPECT_EQ(ranks.at("energy"), alone.at("energy"));
  EXPECT_EQ(ranks.at("ranks"), 3);
  EXPECT_EQ(alone.at("ranks"), 1);
}

TEST_F(Ranks, OfFewParticlesAreWarnedOf) {
  const Outcome outcome = on(2, {"run", "s.json", "--steps", "2", "-o", "ranks"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(times(outcome.err, "fewer ranks"), 1U) << outcome.err;
  EXPECT_THAT(hooke({"run", "s.json", "--steps", "2", "-o", "alone"}).err, Not(HasSubstr("ranks")));
}

TEST_F(Ranks, ASignalThatMpirunHandsOnStopsAllAndLeavesACheckpoint) {
  hooke_ok({"run", "s.json", "-o", "whole", "--steps", "2000"});
  Program program = start_on(2, {"run", "s.json", "-o", "part", "--steps", "2000"});
  EXPECT_TRUE(wait_until([this] { return exists("part/checkpoint.h5"); }));
  program.send_to_itself(SIGUSR1);
  const Outcome stopped = program.wait();
  EXPECT_EQ(stopped.status, 130) << stopped.err;
  EXPECT_EQ(times(stopped.err, "--resume"), 1U) << stopped.err;
  ok_on(2, {"run", "s.json", "-o", "part", "--steps", "2000", "--resume", "part/checkpoint.h5"});
  EXPECT_EQ(state_hash("part"), state_hash("whole"));
}

TEST_F(Ranks, OnlyTheFirstOneThatIsTerminatedStopsAllWithACheckpoint) {
  hooke_ok({"run", "s.json", "-o", "whole", "--steps", "4000"});
  Program program = start_on(3, {"run", "s.json", "-o", "part", "--steps", "4000"});
  EXPECT_TRUE(wait_until([this] { return exists("part/checkpoint.h5"); }));
  const std::vector<pid_t> ranks = program.children();
  ASSERT_EQ(ranks.size(), 3U);
  kill(ranks[1], SIGTERM);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  for (const pid_t rank : ranks) EXPECT_EQ(kill(rank, 0), 0) << "it goes on";
  kill(ranks[0], SIGTERM);
  const Outcome stopped = program.wait();
  EXPECT_EQ(stopped.status, 130) << stopped.err;
  EXPECT_EQ(times(stopped.err, "--resume"), 1U) << stopped.err;
  hooke_ok({"run", "s.json", "-o", "part", "--steps", "4000", "--resume", "part/checkpoint.h5"});
  EXPECT_EQ(state_hash("part"), state_hash("whole"));
}

TEST_F(Ranks, AFullDiskIsReportedOnce) {
  const Words writes{"run", "s.json", "-o", "full", "--steps", "120", "--checkpoint-every", "0.05"};
  std::string limited = "ulimit -f 800; exec " + program_file();  // blocks of 512 bytes
  for (const std::string& word : writes) limited += " " + word;
  Words words{"-q", "-np", "1", "sh", "-c", limited, ":", "-np", "2", program_file()};
  words.insert(words.end(), writes.begin(), writes.end());
  const Outcome full = start_other(HOOKE_MPIRUN, words).wait();
  EXPECT_EQ(full.status, 3) << full.err;
  EXPECT_EQ(times(full.err, "error: full/"), 1U) << full.err;
  EXPECT_EQ(times(full.err, "the last good checkpoint is of step"), 1U) << full.err;
  ok_on(2, {"run", "s.json", "-o", "full", "--steps", "120", "--resume", "full/checkpoint.h5"});
  hooke_ok({"run", "s.json", "-o", "whole", "--steps", "120"});
  EXPECT_EQ(state_hash("full"), state_hash("whole"));
}

// More particles than a file takes at a time (2^20): its bytes follow from how they are cut into slices.
TEST_F(Ranks, WriteFilesOfManySlicesLikeOneProcess) {
  write("many.json", R"({ "hooke": 1, "name": "many", "time": { "step": 0.002, "steps": 3 }, "gravity": [0, -9.8, 0],
    "domain": { "min": [0, 0, 0], "max": [48, 44, 44] },
    "materials": { "water": { "radius": 0.2, "mass": 1, "stiffness": 6000, "shear": 2, "damping": 8 } },
    "particles": [ { "material": "water", "block": { "min": [0.2, 0.2, 0.2], "max": [43.8, 43.8, 43.8], "spacing": 0.4,
                                                     "jitter": 0.01, "seed": 1 } } ],
    "output": { "every_steps": 2 } })");
  hooke_ok({"run", "many.json", "-o", "one"});
  ASSERT_GT(figures("one").at("particles"), 1'100'000);
  for (const int ranks : {2, 3}) {
    const std::string folder = std::to_string(ranks);
    ok_on(ranks, {"run", "many.json", "-o", folder});
    expect_equal_runs("one", folder);
  }
  hooke_ok({"run", "many.json", "-o", "one-later", "--resume", "one/checkpoint.h5", "--steps", "6"});
  ok_on(3, {"run", "many.json", "-o", "later", "--resume", "2/checkpoint.h5", "--steps", "6"});
  expect_equal_runs("one-later", "later");
}

// One of three is killed, so many times, each time another one at another moment: a few times after every change, many
// times in the long tests.
class RanksOfWhichOneIsKilled : public Ranks, public testing::WithParamInterface<int> {};
INSTANTIATE_TEST_SUITE_P(AFew, RanksOfWhichOneIsKilled, testing::Values(3));
INSTANTIATE_TEST_SUITE_P(Many, RanksOfWhichOneIsKilled, testing::Values(20));

TEST_P(RanksOfWhichOneIsKilled, EndAndLeaveACheckpointThatIsGood) {
  using Clock = std::chrono::steady_clock;
  const Words arguments{"run", "s.json", "--steps", "400", "--checkpoint-every", "0.05", "-o"};
  const auto into = [&](const std::string& folder, const Words& more = {}) {
    Words words = arguments;
    words.push_back(folder);
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const auto start_three = [&](const std::string& folder, std::vector<pid_t>& ranks) {
    Program program = start_on(3, into(folder));
    EXPECT_TRUE(wait_until([&] {
      ranks = program.children();
      return ranks.size() == 3;
    }));
    return program;
  };
  std::vector<pid_t> ranks;
  Program whole = start_three("whole", ranks);
  const auto begin = Clock::now();
  ASSERT_EQ(whole.wait().status, 0);
  auto length = std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - begin).count();

  std::mt19937 random(7);
  int killed = 0, resumed = 0;
  for (int round = 0; (killed < GetParam() || resumed == 0) && round < 10 * GetParam(); ++round) {
    const std::size_t which = random() % 3;
    const auto delay = std::chrono::microseconds(static_cast<std::int64_t>(random() % 900) * length / 1000);
    SCOPED_TRACE(testing::Message() << "round " << round << ": rank " << which << " after " << delay.count() << " us");
    const std::string part = "part-" + std::to_string(round), checkpoint = part + "/checkpoint.h5";
    Program program = start_three(part, ranks);
    ASSERT_EQ(ranks.size(), 3U);
    std::this_thread::sleep_for(delay);
    if (exists(part + "/report.json") || kill(ranks[which], SIGKILL) != 0) {  // it was faster than the whole
      EXPECT_EQ(program.wait().status, 0);
      EXPECT_EQ(state_hash(part), state_hash("whole"));
      length = length * 2 / 3;
      continue;
    }
    const auto start = Clock::now();
    EXPECT_NE(program.wait().status, 0);
    EXPECT_LT(Clock::now() - start, std::chrono::seconds(10));
    for (const pid_t rank : ranks) EXPECT_TRUE(wait_until([&] { return kill(rank, 0) != 0; })) << "it goes on";
    ++killed;
    if (!exists(checkpoint)) continue;
    ok_on(std::array{1, 2, 4}[random() % 3], into(part, {"--resume", checkpoint}));
    EXPECT_EQ(state_hash(part), state_hash("whole"));
    ++resumed;
  }
  EXPECT_GE(killed, GetParam());
  EXPECT_GT(resumed, 0);
}

TEST_F(Ranks, ARunThatGoesBadIsReportedOnce) {
  const Words arguments{
      "run", "s.json", "-o", "bad", "--overwrite", "--set", "time.step=0.1", "--set", "materials.water.damping=0"};
  const Outcome alone = hooke(arguments);
  ASSERT_EQ(alone.status, 3) << alone.err;
  const Outcome ranks = on(3, arguments);
  EXPECT_EQ(ranks.status, 3);
  EXPECT_EQ(times(ranks.err, "error: step"), times(alone.err, "error: step")) << ranks.err;
  EXPECT_EQ(alone.err.substr(alone.err.find("error: step")), ranks.err.substr(ranks.err.find("error: step")));
}

// Where rank 0 needs no others
// ------------------------------------------------------------------------------------------

TEST_F(Ranks, OneSpeaksForAll) {
  const Outcome version = on(3, {"--version"});
  EXPECT_EQ(version.status, 0) << version.err;
  EXPECT_EQ(times(version.out, "hooke "), 1U) << version.out;
  const Outcome check = on(2, {"check", "s.json"});
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_EQ(times(check.out, "1,728"), 1U) << check.out;
}

TEST_F(Ranks, WrongUsageEndsAll) {
  const Outcome wrong = on(3, {"nonsense"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_EQ(times(wrong.err, "nonsense"), 1U) << wrong.err;
  const Outcome nothing = on(2, {});
  EXPECT_EQ(nothing.status, 2);
  EXPECT_EQ(times(nothing.out, "Usage: hooke"), 1U) << nothing.out;
}

// Refusals
// --------------------------------------------------------------------------------------------------------------

TEST_F(Ranks, ABrokenSceneIsReportedOnce) {
  write("broken.json", "{ \"hooke\": 1, \"materials\": { ");
  expect_refusal(on(3, {"run", "broken.json", "-o", "out"}), 1, "broken.json");
  expect_refusal(on(3, {"run", "s.json", "-o", "out", "--set", "nonsense=1"}), 1, "nonsense");
  expect_refusal(on(2, {"run", "nowhere.json", "-o", "out"}), 1, "nowhere.json");
}

TEST_F(Ranks, ABrokenCheckpointIsReportedOnce) {
  write("broken.h5", "nothing");
  expect_refusal(on(2, {"run", "s.json", "-o", "out", "--resume", "broken.h5"}), 1, "broken.h5");
}

TEST_F(Ranks, WhatTheyCannotDoYetIsRefusedByName) {
  for (const char* device : {"cuda", "reference"})
    expect_refusal(on(2, {"run", "s.json", "-o", "out", "--device", device}), 1, device);
  expect_refusal(on(2, {"view", "s.json"}), 1, "window");
}

TEST_F(Ranks, OneThatIsNotReadyIsNamed) {
  const Outcome outcome = start_other(HOOKE_MPIRUN, {"-q", "-np", "2", program_file(), "run", "s.json", "-o", "out",
                                                     ":", "-np", "1", "-x", "HOOKE_ISA=nonsense", program_file()})
                              .wait();
  expect_refusal(outcome, 1, "rank 2: instruction set");
}

TEST_F(Ranks, ThatMpiDoesNotKnowAreRefused) {
  const Words environment{"OMPI_COMM_WORLD_RANK=0", "OMPI_COMM_WORLD_SIZE=4"};
  expect_refusal(hooke({"run", "s.json", "-o", "out"}, environment), 1, "4 ranks were started");
}

}  // namespace
}  // namespace hooke::test
