// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/program.h"
#include "source_dir.h"

namespace hooke::test {
namespace {

class States : public ProgramTest {
 protected:
  // The exit status of bench/make_states, with the folder `states` in this test's folder.
  int make_states(const std::string& names) const {
    return std::system((std::string(HOOKE_SOURCE_DIR "/bench/make_states --hooke ") + program_file() + " --folder '" +
                        path("states").string() + "' " + names)
                           .c_str());
  }

  nlohmann::json bench(const std::string& name) const {
    return nlohmann::json::parse(
        hooke_ok({"bench", "states/" + name + "/scene.json", "--steps", "20", "--warmup", "0", "--json"}));
  }
};

TEST_F(States, AreWhatTheyAreCalled) {
  ASSERT_EQ(make_states("dam-1k"), 0);
  const auto calm = bench("calm-1k"), dam = bench("dam-1k");
  for (const auto& report : {calm, dam}) {
    EXPECT_EQ(report.at("particles"), 1000);
    EXPECT_GT(report.at("contacts_per_particle"), 3);
    EXPECT_LT(report.at("max_pair_overlap_ratio"), 0.15);
    EXPECT_LT(report.at("max_overlap_ratio"), 0.3) << "with the floor: over the radius, half of a pair's distance";
  }
  EXPECT_LT(calm.at("energy").at("kinetic"), 50) << "J: a thousand balls at 0.3 m/s";
  EXPECT_LT(calm.at("max").at(0), 10);
  EXPECT_GT(dam.at("max").at(0), 15) << "it runs out of its door";
}

TEST_F(States, StayUntilTheirRecipeChanges) {
  ASSERT_EQ(make_states("calm-1k"), 0);
  const std::string kept = read("states/calm-1k/recipe.json");
  const auto made = std::filesystem::last_write_time(path("states/calm-1k/particles.ply"));
  ASSERT_EQ(make_states("calm-1k"), 0);
  EXPECT_EQ(std::filesystem::last_write_time(path("states/calm-1k/particles.ply")), made);
  write("states/calm-1k/recipe.json", "[]");
  ASSERT_EQ(make_states("calm-1k"), 0);
  EXPECT_NE(std::filesystem::last_write_time(path("states/calm-1k/particles.ply")), made);
  EXPECT_EQ(read("states/calm-1k/recipe.json"), kept);
}

TEST_F(States, UnknownOnesAreRefused) { EXPECT_NE(make_states("storm 2>/dev/null"), 0); }

}  // namespace
}  // namespace hooke::test
