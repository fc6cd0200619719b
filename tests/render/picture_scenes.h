// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/render/coloring.h"

namespace hooke::test {

/// A small scene to take a picture of, the same in every run and on every machine.
struct PictureScene {
  std::string name;  ///< also names the stored picture: images/NAME.png
  Scene scene;
  ParticleSet particles;
  render::ColorBy by = render::ColorBy::material;
  double time = 0;  ///< s
};

inline void PrintTo(const PictureScene& picture, std::ostream* out) { *out << picture.name; }

/// All picture scenes; together they show everything that a picture can hold.
std::vector<PictureScene> picture_scenes();

/// The scene of a tank of this size with balls of one material, "a".
Scene ball_tank(const Vec3d& size, double radius, const std::string& color);
/// Adds a particle with the next id.
void add(ParticleSet& particles, const Vec3d& position, std::uint16_t material = 0, const Vec3d& velocity = {0, 0, 0});

}  // namespace hooke::test
