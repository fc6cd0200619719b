// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "lammps_case.h"

namespace hooke::test {

/// The largest allowed deviations of a case from LAMMPS at one step. Absent: no limit.
struct Limit {
  std::optional<double> position;         ///< max |dx| over the particles, m
  std::optional<double> median_position;  ///< median |dx|, m
  std::optional<double> rms_position;     ///< root of the mean square |dx|, m
  std::optional<double> velocity;         ///< max |dv|, m/s
};

/// The limits of one case for one precision: from the case's README.md or, for known patterns of names, from the
/// measured deviations of plain float engines.
class Limits {
 public:
  Limits(const LammpsCase& lammps_case, const scene::LoadedScene& scene, Precision precision);

  Limit at(std::int64_t step) const;

 private:
  Limit in_double(std::int64_t step) const;
  Limit in_single(std::int64_t step) const;
  Limit in_single_by_readme(std::int64_t step) const;

  std::string name_;
  Precision precision_;
  double radius_;  // m, the smallest
  double speed_;  // m/s, the largest at the start
  double time_step_;  // s
  std::size_t particles_;
  std::vector<std::int64_t> instants_;
  std::map<std::int64_t, double> from_1e12_, from_float32_;
};

}  // namespace hooke::test
