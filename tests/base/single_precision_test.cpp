// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Rounding to single precision rounds every component, whatever the compiler makes of it.

#include "hooke/base/single_precision.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace hooke::test {

#define HOOKE_DECLARE_LEVEL(level)                   \
  namespace level {                                  \
  Vec3d rounded(const Vec3d& a);                     \
  void round_all(Vec3d* vectors, std::size_t count); \
  }
HOOKE_DECLARE_LEVEL(O0)
HOOKE_DECLARE_LEVEL(O1)
HOOKE_DECLARE_LEVEL(O2)
HOOKE_DECLARE_LEVEL(O3)
HOOKE_DECLARE_LEVEL(Ofast)
#undef HOOKE_DECLARE_LEVEL

namespace {

struct Level {
  const char* name;
  Vec3d (*rounded)(const Vec3d&);
  void (*round_all)(Vec3d*, std::size_t);
};
constexpr Level kLevels[] = {{"O0", O0::rounded, O0::round_all},
                             {"O1", O1::rounded, O1::round_all},
                             {"O2", O2::rounded, O2::round_all},
                             {"O3", O3::rounded, O3::round_all},
                             {"Ofast", Ofast::rounded, Ofast::round_all}};

bool is_single(double a) {
  const volatile float single = static_cast<float>(a);
  return static_cast<double>(single) == a;
}

TEST(SinglePrecision, RoundsAllComponentsAtEveryLevelOfOptimisation) {
  const Vec3d a{1 + 1e-9, 1 + 2e-9, 1 + 3e-9};
  for (const Level& level : kLevels) {
    EXPECT_EQ(level.rounded(a), (Vec3d{1, 1, 1})) << level.name;
    std::vector<Vec3d> many;
    for (int i = 1; i < 100; ++i) many.push_back({0.1 * i, 1.0 / i, -0.7 * i});
    level.round_all(many.data(), many.size());
    for (const Vec3d& x : many) EXPECT_TRUE(is_single(x.x) && is_single(x.y) && is_single(x.z)) << level.name;
    EXPECT_EQ(level.rounded({0.5, -0.25, 3}), (Vec3d{0.5, -0.25, 3})) << level.name << ": what is single stays";
  }
}

}  // namespace
}  // namespace hooke::test
