// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/materials.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hooke {
namespace {

using C = ContactCoefficients<double>;

TEST(Mix, TakesSpringsInSeriesTwiceAndMeansOfDashpots) {
  EXPECT_EQ(mix(C{6000, 2, 8}, C{2000, 4, 2}), (C{3000, 3, 5}));
  EXPECT_EQ(mix(C{6000, 2, 8}, C{6000, 2, 8}), (C{6000, 2, 8})) << "of two alike, their own";
}

TEST(Mix, IsSymmetric) {
  const C a{1.3e6, 160, 210}, b{7, 0.1, 0.3};
  EXPECT_EQ(mix(a, b), mix(b, a));
}

TEST(Mix, HandlesTheEdges) {
  EXPECT_EQ(mix(C{0, 0, 0}, C{0, 0, 0}), (C{0, 0, 0}));
  EXPECT_EQ(mix(C{0, 2, 0}, C{1000, 0, 4}), (C{0, 1, 2})) << "no spring in series with one";
  EXPECT_TRUE(std::isfinite(mix(C{1e300, 0, 0}, C{1e300, 0, 0}).stiffness));
  EXPECT_DOUBLE_EQ(mix(C{1e-300, 0, 0}, C{1e-300, 0, 0}).stiffness, 1e-300);
}

TEST(ContactTable, MixesWhatHasNoEntry) {
  const Material materials[] = {
      {"a", 1, 1, {1000, 1, 2}, 0, ""}, {"b", 1, 1, {3000, 3, 4}, 0, ""}, {"c", 1, 1, {500, 5, 6}, 0, ""}};
  const ContactEntry entries[] = {{1, 0, {42, 43, 44}}, {2, ContactEntry::kWall, {7, 8, 9}}, {2, 2, {1, 1, 1}}};
  const ContactTable table(materials, entries);
  EXPECT_EQ(table.material_count(), 3U);
  EXPECT_EQ(table.pair(0, 0).linear, materials[0].contact);
  EXPECT_EQ(table.pair(0, 1).linear, (C{42, 43, 44}));
  EXPECT_EQ(table.pair(1, 0).linear, (C{42, 43, 44})) << "an entry holds either way round";
  EXPECT_EQ(table.pair(1, 2).linear, mix(materials[1].contact, materials[2].contact));
  EXPECT_EQ(table.pair(2, 1), table.pair(1, 2));
  EXPECT_EQ(table.pair(2, 2).linear, (C{1, 1, 1})) << "also with its own kind";
  EXPECT_EQ(table.wall(0).linear, materials[0].contact) << "walls take the material's own";
  EXPECT_TRUE(table.is_linear());
  EXPECT_EQ(table.wall(2).linear, (C{7, 8, 9}));
}

TEST(ContactTable, MixesSurfacesByTheWeaker) {
  using S = SurfaceCoefficients<double>;
  const double none = INFINITY;
  Material materials[] = {
      {"a", 1, 1, {1000, 1, 2}, 0, ""}, {"b", 1, 1, {3000, 3, 4}, 0, ""}, {"c", 1, 1, {9, 0, 0}, 0, ""}};
  materials[0].surface = {0.5, none, 3, 0.25};
  materials[1].surface = {none, 0, 2, 0.5};
  const ContactEntry entries[] = {{0, 2, {1, 1, 1}, {0.1, none, 7, 0.75}}};
  const ContactTable table(materials, entries);
  EXPECT_EQ(table.pair(0, 1).surface, (S{0.5, 0, 2, 0.25}));
  EXPECT_EQ(table.pair(1, 2).surface, (S{none, 0, 0, 0})) << "nothing coheres with what does not";
  EXPECT_EQ(table.pair(2, 0).surface, (S{0.1, none, 7, 0.75})) << "an entry overrides";
  EXPECT_EQ(table.wall(0).surface, materials[0].surface);
  EXPECT_FALSE(table.pair(2, 2).surface.act());
  EXPECT_FALSE(table.is_linear());
  EXPECT_EQ(table.widest_range(), 0.75);
}

}  // namespace
}  // namespace hooke
