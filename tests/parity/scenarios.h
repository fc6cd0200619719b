// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke::test {

/// A scene and its particles. Single precision holds every coordinate exactly.
struct Scenario {
  std::string name;
  Scene scene;
  ParticleSet particles;
  std::int64_t steps = 40;  ///< to compare over
};

inline void PrintTo(const Scenario& scenario, std::ostream* os) { *os << scenario.name; }

/// Random, negative, huge, degenerate and empty scenarios, odd counts, mixed radii, every mix of boundaries, tiny
/// periodic boxes and thin domains.
const std::vector<Scenario>& scenarios();

}  // namespace hooke::test
