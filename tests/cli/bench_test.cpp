// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "program.h"
#include "source_dir.h"

namespace hooke::test {
namespace {

using testing::HasSubstr;

class Bench : public ProgramTest {
 protected:
  void SetUp() override { write("s.json", small_scene()); }
};

TEST_F(Bench, JsonHoldsTheFields) {
  const auto report = nlohmann::json::parse(
      hooke_ok({"bench", "s.json", "--steps", "20", "--warmup", "10", "--threads", "2", "--json"}));
  for (const char* field : {"particles", "steps", "seconds", "steps_per_second", "particle_steps_per_second",
                            "contacts_per_particle", "threads", "device", "isa", "precision", "peak_bytes",
                            "state_hash", "energy", "momentum", "max_overlap_ratio", "removed", "neighbour_rebuilds"}) {
    EXPECT_TRUE(report.contains(field)) << field;
  }
  for (const char* part : {"kinetic", "potential", "elastic", "dissipated"}) {
    EXPECT_TRUE(report.at("energy").contains(part)) << part;
  }
  EXPECT_EQ(report.at("particles"), 216);
  EXPECT_EQ(report.at("steps"), 20);
  EXPECT_EQ(report.at("threads"), 2);
  EXPECT_EQ(report.at("device"), "cpu");
  EXPECT_EQ(report.at("momentum").size(), 3U);
  EXPECT_GT(report.at("particle_steps_per_second"), 0);

  hooke_ok({"run", "s.json", "--steps", "30"});
  EXPECT_EQ(report.at("state_hash"), state_hash("s"));
}

TEST_F(Bench, StagesOfAStepAddUpToIt) {
  for (const char* integrator : {"symplectic-euler", "velocity-verlet"}) {
    write("s.json", pool_scene(16, integrator, "single"));
    const auto report =
        nlohmann::json::parse(hooke_ok({"bench", "s.json", "--steps", "200", "--warmup", "0", "--json"}));
    double sum = 0;
    for (const auto& [stage, seconds] : report.at("stages").items()) {
      EXPECT_GE(seconds, 0) << stage;
      sum += seconds.get<double>();
    }
    const double whole = report.at("seconds");
    EXPECT_NEAR(sum, whole, 1e-9);
    EXPECT_LT(report.at("stages").at("rest"), 0.5 * whole);
    for (const char* stage : {"sort", "list", "force"}) EXPECT_GT(report.at("stages").at(stage), 0) << stage;
    EXPECT_TRUE(report.at("stages").contains("motion"));
    EXPECT_EQ(report.at("stages").at("drift") > 0, std::string(integrator) == "velocity-verlet");
  }
}

TEST_F(Bench, WithoutWallsTheyTakeNoTime) {
  const auto report = nlohmann::json::parse(
      hooke_ok({"bench", "s.json", "--set", "domain.walls=\"periodic\"", "--steps", "5", "--warmup", "0", "--json"}));
  EXPECT_EQ(report.at("stages").at("walls"), 0);
}

TEST_F(Bench, StartsFromACheckpoint) {
  hooke_ok({"run", "s.json", "--steps", "30"});
  hooke_ok({"run", "s.json", "--steps", "50", "-o", "later"});
  const auto report = nlohmann::json::parse(
      hooke_ok({"bench", "s.json", "--resume", "s/checkpoint.h5", "--warmup", "5", "--steps", "15", "--json"}));
  EXPECT_EQ(report.at("state_hash"), state_hash("later"));
}

// Births, ends of lives, sinks and open faces are no escapes.
TEST_F(Bench, MeasuresScenesWhereParticlesComeAndGo) {
  for (const char* scene : {"fountain", "fireworks", "hourglass"}) {
    SCOPED_TRACE(scene);
    const auto report =
        nlohmann::json::parse(hooke_ok({"bench", HOOKE_SOURCE_DIR "/scenes/" + std::string(scene) + ".json", "--steps",
                                        "60", "--warmup", "40", "--json"}));
    EXPECT_GT(report.at("particles"), 0);
  }
}

TEST_F(Bench, PrintsATable) {
  const std::string table = hooke_ok({"bench", "s.json", "--steps", "5", "--warmup", "0"});
  for (const char* row : {"particle-steps/s", "contacts per particle", "rebuilds", "bytes per particle", "state hash",
                          "a step", "sort", "list", "motion", "force", "walls", "rest", " ms, "}) {
    EXPECT_THAT(table, HasSubstr(row));
  }
}

TEST_F(Bench, PrintsNoSpeedForARunThatWentBad) {
  const Outcome bad = hooke({"bench", "s.json", "--set", "materials.water.stiffness=1e7", "--set",
                             "particles[0].velocity=[0,-3,0]", "--steps", "2000"});
  EXPECT_EQ(bad.status, 3);
  EXPECT_THAT(bad.out, testing::Not(HasSubstr("steps/s")));
  EXPECT_THAT(bad.err, HasSubstr("stable step"));
}

}  // namespace
}  // namespace hooke::test
