// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke::test {

/// Four random numbers in [0, 1) for `index`, the same in every run.
std::array<double, 4> random4(std::uint64_t seed, std::uint64_t index);

/// A scene without gravity in an open box of 200 m around the origin, one material: radius 0.5, mass 1,
/// k 1000, c_s 2, c_d 3, dt 0.001, double precision.
Scene open_scene();

/// Materials of different radius, mass, stiffness and drag, with entries for one pair and for one wall.
void mix_materials(Scene& scene, double radius);

/// Friction on the materials of mix_materials(), no tension on one, cohesion on two of them, on a pair and on a wall.
void add_surfaces(Scene& scene);

/// Adds a particle with the next id.
void add(ParticleSet& particles, const Vec3d& position, const Vec3d& velocity, std::uint16_t material = 0);

/// Two particles on the x axis, overlapping by `overlap` (m), that move with velocities `v_1` and `v_2`.
ParticleSet pair_on_x(const Scene& scene, double overlap, const Vec3d& v_1, const Vec3d& v_2);

/// `count` particles at random positions in the box from `min` to `max`, with speeds up to `speed` along each axis, all
/// materials in turn, and ids with gaps.
ParticleSet cloud(const Scene& scene, std::size_t count, const Vec3d& min, const Vec3d& max, double speed,
                  std::uint64_t seed);

/// A cubic lattice of `count` particles an axis from `corner`, `spacing` (m) apart, each moved by up to `jitter` (m).
ParticleSet lattice(const Scene& scene, const std::array<int, 3>& count, const Vec3d& corner, double spacing,
                    double jitter, std::uint64_t seed);

}  // namespace hooke::test
