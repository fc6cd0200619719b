// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "program.h"
#include "source_dir.h"

namespace hooke::test {
namespace {

// The rows of series.csv, each by column.
std::vector<std::map<std::string, double>> rows_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line, cell;
  std::vector<std::string> names;
  std::vector<std::map<std::string, double>> rows;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::map<std::string, double> row;
    for (std::size_t column = 0; std::getline(cells, cell, ','); ++column) {
      if (rows.empty() && names.size() == column && !cell.empty() && std::isalpha(cell[0]) != 0) {
        names.push_back(cell);
      } else {
        row[names.at(column)] = std::stod(cell);
      }
    }
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

class Headline : public ProgramTest {};

// docs/theory.md section 8: the dam break of 512,000 balls, 8 simulated seconds and 4 more.
TEST_F(Headline, WaterRunsSplashesAndSettles) {
  hooke_ok({"run", std::string(HOOKE_SOURCE_DIR) + "/scenes/water.json", "-o", "water", "--set", "output.every=0.5"});
  const auto rows = rows_of(read("water/series.csv"));
  ASSERT_EQ(rows.size(), 25U);
  const auto row_at = [&](double t) {
    return *std::ranges::find_if(rows, [&](const auto& row) { return row.at("t") > t - 1e-9; });
  };
  EXPECT_LT(row_at(0).at("front_x"), 47);
  EXPECT_GT(row_at(3).at("front_x"), 75) << "it runs";
  EXPECT_GT(row_at(5).at("front_x"), 99.5) << "as far as the wall";
  double most_kinetic = 0;
  for (const auto& row : rows) {
    most_kinetic = std::max(most_kinetic, row.at("kinetic"));
    EXPECT_LT(row.at("mean_overlap_ratio"), 0.1) << "at " << row.at("t");
    EXPECT_EQ(row.at("particles"), 512'000);
  }
  EXPECT_GT(most_kinetic, 3e6);
  EXPECT_LT(rows.back().at("kinetic"), most_kinetic / 4) << "it settles";
  EXPECT_LT(rows.back().at("max_y"), 9);
  const auto report = nlohmann::json::parse(read("water/report.json"));
  EXPECT_LT(report.at("momentum_drift"), 1e-5);
  // Only the integrator's error with a coarse step (docs/theory.md section 6).
  EXPECT_LT(std::abs(report.at("energy").at("balance").get<double>()),
            0.03 * report.at("energy").at("initial").get<double>());
}

}  // namespace
}  // namespace hooke::test
