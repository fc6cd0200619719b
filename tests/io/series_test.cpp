// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/series.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "samples.h"

namespace hooke {
namespace {

TEST(Series, RowsHaveTheColumnsOfTheHeader) {
  io::SeriesRow row = samples::series_row(40);
  row.measurements.particles = 512000;
  row.ledger.removed = 3;
  const std::string header = io::series_header();
  const std::string line = io::to_csv(row);
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), std::count(line.begin(), line.end(), ','));
  EXPECT_EQ(header.rfind("step,t,particles,contacts,", 0), 0U);
  EXPECT_EQ(line.rfind("40,0.2,512000,0,0,13.333333333333334,", 0), 0U);
  EXPECT_NE(header.find(",front_x,"), std::string::npos);
  EXPECT_EQ(header.substr(header.size() - 8), ",removed");
  EXPECT_EQ(line.substr(line.size() - 2), ",3");
}

}  // namespace
}  // namespace hooke
