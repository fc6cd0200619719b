// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/foreign_keys.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hooke/scene/load_scene.h"
#include "hooke/scene/schema.h"
#include "minimal_scene.h"

namespace hooke::scene {
namespace {

using testing::HasSubstr;

TEST(ForeignKeys, SayWhatToWriteInstead) {
  for (const auto& [key, words] : {std::pair{"restitution", "\"damping\""},
                                   {"coefficientRestitution", "\"damping\""},
                                   {"density", "\"mass\""},
                                   {"young", "\"stiffness\""},
                                   {"Young's_modulus", "\"stiffness\""},
                                   {"k_n", "\"stiffness\""},
                                   {"k_t", "no history"},
                                   {"xmu", "\"friction\""},
                                   {"gamma_n", "\"damping\""},
                                   {"coefficientRollingFriction", "no rotation"},
                                   {"diameter", "\"radius\""},
                                   {"pair_style", "docs/from-lammps.md"},
                                   {"timeStepSize", "\"step\""},
                                   {"RigidBodies", "\"colliders\""},
                                   {"viscosity", "\"shear\""},
                                   {"surfaceTension", "\"cohesion\""},
                                   {"DES_EN_INPUT", "\"damping\""},
                                   {"D_p0", "\"radius\""},
                                   {"RO_s0", "\"mass\""}}) {
    EXPECT_THAT(scene::foreign_key_hint(key), HasSubstr(words)) << key;
  }
}

TEST(ForeignKeys, AreWholeWords) {
  for (const std::string key : {"", " ", "_", "raduis", "densit", "restitution2", "density rho", "stiffnes"}) {
    EXPECT_EQ(scene::foreign_key_hint(key), "") << key;
  }
  EXPECT_EQ(scene::foreign_key_hint(std::string(100000, 'k')), "");
}

// Keys of the schema, at any level.
void collect_keys(const scene::Json& schema, std::vector<std::string>& keys) {
  if (schema.is_object() && schema.contains("properties")) {
    for (const auto& property : schema.at("properties").items()) keys.push_back(property.key());
  }
  for (const auto& part : schema.items()) {
    if (part.value().is_structured()) collect_keys(part.value(), keys);
  }
}

TEST(ForeignKeys, AreNoMaterialKeys) {
  std::vector<std::string> keys;
  collect_keys(scene::schema_root().at("properties").at("materials"), keys);
  ASSERT_GT(keys.size(), 15U);
  for (const std::string& key : keys) EXPECT_EQ(scene::foreign_key_hint(key), "") << key;
}

TEST(ForeignKeys, AreExplainedInTheError) {
  std::string scene = kMinimalScene;
  scene.replace(scene.find("\"mass\""), 0, R"("restitution": 0.5, "dampin": 1, )");
  const auto loaded = scene::parse_scene(scene, "s.json", ".");
  ASSERT_FALSE(loaded);
  const std::string text = loaded.error().text();
  EXPECT_THAT(text, HasSubstr("materials.water.restitution"));
  EXPECT_THAT(text, HasSubstr("docs/limits.md"));
  EXPECT_THAT(text, HasSubstr("did you mean \"damping\"?"));
}

}  // namespace
}  // namespace hooke::scene
