// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Scenes that are hard on several ranks, which are threads here: on_ranks/*.json.

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>

#include "hooke/scene/load_scene.h"
#include "source_dir.h"
#include "support/engines.h"
#include "support/ranks.h"

namespace hooke::test {
namespace {

struct HardScene {
  const char* name;
  std::int64_t steps, many_steps;  // until something has happened, and in the long run
  std::function<bool(const Simulation&)> has_happened;  // what the scene is for
};

void PrintTo(const HardScene& scene, std::ostream* os) { *os << scene.name; }

bool there_are_contacts(const Simulation& s) { return measured(s).contacts > s.particle_count() / 2; }

const HardScene kHardScenes[] = {
    {"births", 120, 1000,
     [](const Simulation& s) {
       const PopulationLedger& l = s.ledger().population;
       return l.born > 1000 && l.expired > 100 && l.sunk > 10 && measured(s).contacts > 50;
     }},
    {"breaks", 80, 600, [](const Simulation& s) { return s.ledger().springs.broken > 1000; }},
    {"dam", 100, 800, there_are_contacts},
    {"periodic", 80, 600, there_are_contacts},
    {"flow", 80, 600, there_are_contacts},
    {"sparse", 400, 1000, [](const Simulation& s) { return s.ledger().removed > 10 && s.ledger().dissipated() > 0; }},
    {"thin", 150, 1000, there_are_contacts},
    {"thinner", 150, 1000, there_are_contacts}};

class HardOnRanks : public testing::TestWithParam<HardScene> {
 protected:
  // The bits of one rank, on so many, halfway and after so many steps; and no list ever lacks a contact.
  static void expect_the_bits_of_one(std::int64_t steps, std::initializer_list<int> many) {
    const auto loaded = scene::load_scene(std::filesystem::path(HOOKE_SOURCE_DIR "/tests/scene/on_ranks") /
                                          (std::string(GetParam().name) + ".json"));
    ASSERT_TRUE(loaded) << loaded.error().text();
    const Engine engine{"cpu", loaded->scene.precision, 1, "", false};
    Simulation one = simulate(loaded->scene, loaded->particles, engine);
    ASSERT_TRUE(advance(one, steps / 2));
    const std::uint64_t halfway = one.state_hash();
    ASSERT_TRUE(advance(one, steps - steps / 2));
    ASSERT_TRUE(GetParam().has_happened(one)) << measured(one).contacts << " contacts";
    const Measurements figures = measured(one);
    Engine checked = engine;
    checked.check_list = true;
    for (const int ranks : many) {
      SCOPED_TRACE(ranks);
      on_ranks(ranks, loaded->scene, loaded->particles, checked, [&](Simulation& together) {
        ASSERT_TRUE(advance(together, steps / 2));
        EXPECT_EQ(together.state_hash(), halfway);
        ASSERT_TRUE(advance(together, steps - steps / 2));
        EXPECT_EQ(together.state_hash(), one.state_hash());
        EXPECT_EQ(together.particle_count(), one.particle_count());
        EXPECT_EQ(together.ledger(), one.ledger());
        EXPECT_EQ(together.broken_springs(), one.broken_springs());
        EXPECT_EQ(measured(together).contacts, figures.contacts);
        EXPECT_EQ(measured(together).elastic_energy, figures.elastic_energy);
        EXPECT_EQ(together.neighbour_statistics().missed_contacts, 0U);
      });
    }
  }
};

TEST_P(HardOnRanks, HasTheBitsOfOne) { expect_the_bits_of_one(GetParam().steps, {2, 3, 4, 8}); }

TEST_P(HardOnRanks, HasTheBitsOfOneInTheLongRun) { expect_the_bits_of_one(GetParam().many_steps, {3, 8}); }

INSTANTIATE_TEST_SUITE_P(Scenes, HardOnRanks, testing::ValuesIn(kHardScenes),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace hooke::test
