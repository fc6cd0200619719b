// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
//
// As preconditions_test.cpp, for the code that makes particles from the rows of files.

#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "hooke/scene/findings.h"
#include "hooke/scene/particle_file.h"
#include "hooke/scene/particle_rows.h"
#include "support/assertions.h"

namespace hooke {
namespace {

TEST(ScenePreconditions, RowsAreOfTheScenesMaterials) {
  const Material water;
  scene::Findings findings("");
  std::vector<Finding> warnings;
  scene::ParticleFileRules rules;
  rules.materials = std::span(&water, 1);
  scene::ParticleRows rows(rules, "some.csv", false, findings, warnings);
  scene::Row row = rows.blank();
  row.material = 4;
  EXPECT_ASSERTS(rows.add(row, 12), "row.material = 4, rules_.materials.size() = 1, place = 12");
  EXPECT_ASSERTS((void)row[scene::Quantity::id], "quantity = 8");
  EXPECT_TRUE(rows.set_columns({{scene::Quantity::x, "x"},
                                {scene::Quantity::y, "y"},
                                {scene::Quantity::z, "z"},
                                {scene::Quantity::material, "m"}},
                               1));
  EXPECT_ASSERTS(rows.set_labels({}), "columns_.size() = 4");
  rules.material = 1;
  EXPECT_ASSERTS((void)scene::read_particle_file("some.csv", "some.csv", rules, findings, warnings),
                 "rules.materials.size() = 1");
}

}  // namespace
}  // namespace hooke
