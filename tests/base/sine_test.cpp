// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/base/sine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hooke {
namespace {

TEST(SineOfTurns, IsThatOfTheLibraryToTheLastDigit) {
  double worst = 0;
  for (int i = -200000; i <= 200000; ++i) {
    const double turns = i * 1.37e-5;
    const SineCosine ours = sine_cosine_of_turns(turns);
    const long double angle = 2 * std::numbers::pi_v<long double> * static_cast<long double>(turns);
    worst = std::max(worst, static_cast<double>(std::abs(ours.sine - std::sin(angle))));
    worst = std::max(worst, static_cast<double>(std::abs(ours.cosine - std::cos(angle))));
  }
  EXPECT_LT(worst, 2e-16) << "what the header promises";
}

TEST(SineOfTurns, IsExactAtQuartersOfATurn) {
  for (const double whole : {0.0, 1.0, -7.0, 1e9, 4e15}) {
    const auto at = [&](double part) { return sine_cosine_of_turns(whole + part); };
    EXPECT_EQ(at(0).sine, 0);
    EXPECT_EQ(at(0).cosine, 1);
    if (whole > 1e15) continue;  // too large to hold a quarter as well
    EXPECT_EQ(at(0.25).sine, 1);
    EXPECT_EQ(at(0.25).cosine, 0);
    EXPECT_EQ(at(0.5).sine, 0);
    EXPECT_EQ(at(0.5).cosine, -1);
    EXPECT_EQ(at(-0.25).sine, -1);
    EXPECT_EQ(at(0.75).cosine, 0);
  }
}

}  // namespace
}  // namespace hooke
