// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gmock/gmock.h>

#include <cstdlib>
#include <ostream>

#include "program.h"

namespace hooke::test {
namespace {

struct Case {
  const char* integrator;
  const char* precision;

  friend std::ostream& operator<<(std::ostream& out, const Case& c) {
    return out << c.integrator << ", " << c.precision;
  }
};

class Determinism : public ProgramTest, public testing::WithParamInterface<Case> {
 protected:
  // Large enough that every thread gets work.
  void SetUp() override { write("s.json", pool_scene(12, GetParam().integrator, GetParam().precision)); }
};

TEST_P(Determinism, AnyNumberOfThreadsGivesTheSameBits) {
  hooke_ok({"run", "s.json", "-o", "one", "--threads", "1"});
  const std::string exported = export_all("one");
  for (const char* threads : {"2", "3", "8"}) {
    hooke_ok({"run", "s.json", "-o", threads, "--threads", threads});
    EXPECT_EQ(state_hash(threads), state_hash("one")) << threads;
    EXPECT_EQ(export_all(threads), exported) << threads;
  }
}

TEST_P(Determinism, HoldsWhereEvenTheSortIsSharedOut) {
  write("large.json", pool_scene(52, GetParam().integrator, GetParam().precision));
  hooke_ok({"run", "large.json", "-o", "one", "--threads", "1", "--steps", "3"});
  hooke_ok({"run", "large.json", "-o", "three", "--threads", "3", "--steps", "3"});
  EXPECT_EQ(state_hash("one"), state_hash("three"));
}

TEST_P(Determinism, AnyInstructionSetGivesTheSameBits) {
  hooke_ok({"run", "s.json", "-o", "widest"});
  for (const char* isa : {"portable", "avx2", "avx512"}) {
    setenv("HOOKE_ISA", isa, 1);
    const Outcome outcome = hooke({"run", "s.json", "-o", isa});
    unsetenv("HOOKE_ISA");
    if (outcome.status == 2 && std::string(isa) != "portable") continue;  // this processor lacks the instruction set
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(state_hash(isa), state_hash("widest")) << isa;
  }
}

TEST_P(Determinism, ARestartGivesTheSameBits) {
  hooke_ok({"run", "s.json", "-o", "whole", "--threads", "2"});
  hooke_ok({"run", "s.json", "-o", "parts", "--threads", "1", "--steps", "30"});
  hooke_ok({"run", "s.json", "-o", "parts", "--threads", "2", "--resume", "parts/checkpoint.h5"});
  EXPECT_EQ(state_hash("parts"), state_hash("whole"));
  EXPECT_EQ(export_all("parts"), export_all("whole"));

  // Into another folder too, and back to an earlier step in the same folder.
  hooke_ok({"run", "s.json", "-o", "half", "--steps", "30"});
  hooke_ok({"run", "s.json", "-o", "other", "--resume", "half/checkpoint.h5"});
  EXPECT_EQ(state_hash("other"), state_hash("whole"));
  std::filesystem::copy_file(path("half/checkpoint.h5"), path("parts/earlier.h5"));
  hooke_ok({"run", "s.json", "-o", "parts", "--resume", "parts/earlier.h5"});
  EXPECT_EQ(export_all("parts"), export_all("whole"));
}

TEST_P(Determinism, ACheckpointOfAnotherRunIsRefused) {
  hooke_ok({"run", "s.json", "-o", "half", "--steps", "30"});
  const std::string checkpoint = "half/checkpoint.h5";
  EXPECT_EQ(hooke({"run", "s.json", "-o", "other", "--resume", checkpoint, "--set", "time.step=0.004"}).status, 2);
  EXPECT_EQ(hooke({"run", "s.json", "-o", "other", "--resume", checkpoint, "--steps", "29"}).status, 2);
  EXPECT_FALSE(exists("other"));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Determinism,
                         testing::Values(Case{"symplectic-euler", "single"}, Case{"velocity-verlet", "single"},
                                         Case{"symplectic-euler", "double"}, Case{"velocity-verlet", "double"}),
                         [](const auto& the_case) {
                           std::string name = std::string(the_case.param.integrator) + "_" + the_case.param.precision;
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace hooke::test
