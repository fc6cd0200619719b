// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "hooke/scene/load_scene.h"

namespace hooke::test {

/// A table of numbers with named columns, as in the reference cases.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  int digits = 0;  ///< the most significant digits of any number in it: the precision of its text

  bool has(const std::string& column) const;
  std::size_t column(const std::string& name) const;  ///< fails the test where there is none
  double at(std::size_t row, const std::string& name) const { return rows[row][column(name)]; }
  /// The largest error of `value` from rounding to the table's digits.
  double rounding(double value) const;
};

Table read_table(const std::filesystem::path& file);

/// One instant of a trajectory: rows of id, x, y, z, vx, vy, vz.
struct ExpectedInstant {
  std::int64_t step = 0;
  std::vector<std::uint64_t> id;
  std::vector<Vec3d> position, velocity;
};

/// A folder of reference/lammps.
struct LammpsCase {
  std::string name;
  std::filesystem::path folder;

  /// The scene, with `overrides` as of --set.
  scene::LoadedScene load(const std::vector<std::string>& overrides = {}) const;
  bool has(const std::string& file) const { return std::filesystem::exists(folder / file); }
  /// Instants of expected.csv, or of every expected_stepN.csv, by step, with the table that each came from.
  std::vector<std::pair<ExpectedInstant, Table>> instants(const std::string& file = "expected.csv") const;
  // For the registration of tests, in every process that runs one of them: parses no table, loads no scene.
  bool has_instants() const;
  std::size_t particle_count() const;  ///< rows of initial.csv

  /// Deviations by step that the README gives for a start changed by `what`, e.g. "1e-12 relative", "float32":
  /// largest |dx| over the particles, m. Empty where it gives none.
  std::map<std::int64_t, double> deviations(const std::string& what) const;
};

inline void PrintTo(const LammpsCase& c, std::ostream* os) { *os << c.name; }

/// All cases found, by name: the cases beside the checkout, or else the project's own small part of them.
std::vector<LammpsCase> lammps_cases();

}  // namespace hooke::test
