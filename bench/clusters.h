// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "hooke/base/random.h"
#include "hooke/base/vec3.h"

namespace hooke::bench {

// Particles for measuring attraction: the same in every run.

inline Vec3d random_direction(double u, double v) {
  const double z = 2 * u - 1, phi = 2 * std::numbers::pi * v, rho = std::sqrt(1 - z * z);
  return {rho * std::cos(phi), rho * std::sin(phi), z};
}

/// Plummer's sphere of scale `scale`, cut off at `cut` scales (Aarseth, Henon and Wielen 1974).
inline std::vector<Vec3d> plummer_sphere(std::size_t count, double scale, double cut, std::uint64_t seed) {
  std::vector<Vec3d> positions(count);
  const double enclosed = std::pow(1 + 1 / (cut * cut), -1.5);
  for (std::size_t i = 0; i < count; ++i) {
    const auto r = uniform4(seed, i, 0);
    const double mass = (r[0] + 0.5 / 4294967296.0) * enclosed;
    const double radius = scale / std::sqrt(std::pow(mass, -2.0 / 3.0) - 1);
    positions[i] = radius * random_direction(r[1], r[2]);
  }
  return positions;
}

/// Uniform in a cube around 0.
inline std::vector<Vec3d> cube(std::size_t count, double side, std::uint64_t seed) {
  std::vector<Vec3d> positions(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto r = uniform4(seed, i, 0);
    positions[i] = side * Vec3d{r[0] - 0.5, r[1] - 0.5, r[2] - 0.5};
  }
  return positions;
}

/// A thin disc of a radius; its surface density falls off from the middle.
inline std::vector<Vec3d> disc(std::size_t count, double radius, std::uint64_t seed) {
  std::vector<Vec3d> positions(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto r = uniform4(seed, i, 0);
    const double at = radius * r[0], phi = 2 * std::numbers::pi * r[1];
    positions[i] = {at * std::cos(phi), 0.02 * radius * (r[2] - 0.5), at * std::sin(phi)};
  }
  return positions;
}

/// Two spheres of Plummer, one ten times as dense, far apart from each other.
inline std::vector<Vec3d> two_clusters(std::size_t count, double scale, std::uint64_t seed) {
  std::vector<Vec3d> positions = plummer_sphere(count, scale, 10, seed);
  for (std::size_t i = 0; i < count; i += 2) {
    positions[i] = 0.46 * positions[i] + Vec3d{30 * scale, 5 * scale, 0};
  }
  return positions;
}

}  // namespace hooke::bench
