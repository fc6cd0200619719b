// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hooke/core/backend.h"
#include "hooke/core/simulation.h"

namespace hooke::io {

/// One row of series.csv: the physical quantities at one instant.
struct SeriesRow {
  std::int64_t step = 0;
  double time = 0;  ///< s
  Measurements measurements;
  Ledger ledger;
  double integration = 0;  ///< integration_error(), J
};

/// The row of the present instant. `measurements` must come from Simulation::measure() now.
SeriesRow make_series_row(const Simulation& simulation, const Measurements& measurements);

/// The first line of series.csv, and a row as text, both without a line feed. Columns are in SI units; front_x is the
/// largest x of a centre. The last columns give for each collider, by name, the force of the particles on it and their
/// torque about its pivot. Numbers are the shortest that read back to the same double.
std::string series_header(const std::vector<std::string>& colliders = {});
std::string to_csv(const SeriesRow& row);

}  // namespace hooke::io
