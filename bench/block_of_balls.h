// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke::bench {

// Balls for measuring their surroundings: a block at rest in a box with walls; each ball touches its six neighbours.

inline constexpr std::size_t kBallsInBlock = 512'000;
inline constexpr double kBallRadius = 0.1;  // m
inline constexpr double kBallMass = 1;      // kg
inline constexpr double kBlockEdge = 16;    // edge of the block's floor, from 0, m

/// A scene without particles, colliders and fields.
inline Scene block_of_balls_scene(Precision precision) {
  Scene scene;
  scene.time_step = 1e-3;
  scene.precision = precision;
  scene.domain = {{0, 0, 0}, {kBlockEdge, 2 * kBlockEdge, kBlockEdge}, {}};
  Material ball;
  ball.name = "ball";
  ball.radius = kBallRadius;
  ball.mass = kBallMass;
  ball.contact = {20000, 10, 20};
  scene.materials = {ball};
  return scene;
}

/// kBallsInBlock balls at rest, in layers from the floor up, at all lattice points x except where no_room(x).
template <class NoRoom>
ParticleSet block_of_balls(const NoRoom& no_room) {
  constexpr std::size_t kRow = 80;
  constexpr double kSpacing = kBlockEdge / kRow;
  ParticleSet balls;
  balls.resize(kBallsInBlock);
  std::size_t k = 0;
  for (std::size_t place = 0; k < kBallsInBlock; ++place) {
    const auto at = [](std::size_t n) { return (static_cast<double>(n) + 0.5) * kSpacing; };
    const Vec3d x{at(place % kRow), at(place / (kRow * kRow)), at(place / kRow % kRow)};
    if (no_room(x)) continue;
    balls.id[k] = k + 1;
    balls.material[k] = 0;
    balls.position[k] = x;
    balls.velocity[k] = {0, 0, 0};
    ++k;
  }
  return balls;
}

}  // namespace hooke::bench
