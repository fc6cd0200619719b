// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "picture_scenes.h"

#include <cmath>

#include "hooke/base/random.h"

namespace hooke::test {
namespace {

// `at` with a small random shift for particle `index`.
Vec3d jittered(const Vec3d& at, double most, std::uint64_t index) {
  const auto u = uniform4(3, index, 0);
  return at + most * Vec3d{2 * u[0] - 1, 2 * u[1] - 1, 2 * u[2] - 1};
}

// body(x, y, z, k) for the centres of a cubic lattice between two corners.
template <class Body>
void for_lattice(const Vec3d& min, const Vec3d& max, double spacing, const Body& body) {
  std::uint64_t k = 0;
  for (double y = min.y; y <= max.y; y += spacing) {
    for (double z = min.z; z <= max.z; z += spacing) {
      for (double x = min.x; x <= max.x; x += spacing) body(Vec3d{x, y, z}, k++);
    }
  }
}

PictureScene pile_in_three_colors() {
  PictureScene picture{"pile", ball_tank({8, 3, 5}, 0.15, "#c9485b"), {}};
  picture.scene.materials.push_back({"b", 0.15, 1, {}, 0, "#e4c233"});
  picture.scene.materials.push_back({"c", 0.15, 1, {}, 0, "#3f6fd6"});
  for_lattice({0.2, 0.15, 0.2}, {7.8, 2.5, 4.8}, 0.28, [&](const Vec3d& at, std::uint64_t k) {
    const double away = std::hypot(at.x - 4, at.z - 2.5);
    if (at.y > 2.4 * std::exp(-away * away / 3) + 0.3) return;
    add(picture.particles, jittered(at, 0.03, k), static_cast<std::uint16_t>(std::fmod(away, 1.8) / 0.6));
  });
  return picture;
}

PictureScene large_on_small() {
  PictureScene picture{"large-on-small", ball_tank({6, 3, 4}, 0.1, "#7d8794"), {}};
  picture.scene.materials.push_back({"b", 1, 1, {}, 0, "#d65a2f"});
  for_lattice({0.15, 0.1, 0.15}, {5.9, 0.4, 3.9}, 0.19,
              [&](const Vec3d& at, std::uint64_t k) { add(picture.particles, jittered(at, 0.02, k)); });
  add(picture.particles, {2.6, 1.4, 2}, 1);
  return picture;
}

// A pool, a crown that rises from it, and drops.
PictureScene splash() {
  PictureScene picture{"splash", ball_tank({8, 4, 5}, 0.06, "#2f7fd6"), {}};
  picture.scene.materials[0].look = MaterialLook::water;
  for_lattice({0.06, 0.06, 0.06}, {7.94, 1.2, 4.94}, 0.11, [&](const Vec3d& at, std::uint64_t k) {
    const double away = std::hypot(at.x - 4, at.z - 2.5);
    const double level = 0.9 + 0.12 * std::sin(3 * away) - 0.7 * std::exp(-away * away);
    if (at.y < level) add(picture.particles, jittered(at, 0.02, k), 0, {0, 0.3 * std::sin(3 * away), 0});
  });
  for (std::uint64_t k = 0; k < 3000; ++k) {
    const auto u = uniform4(11, k, 0);
    const double angle = 6.283185307179586 * u[0], rise = u[1] * u[1];
    const double away = 1.15 + 0.5 * rise + 0.08 * u[2];
    const double height = 0.8 + rise * (1.6 + 0.4 * std::sin(9 * angle));
    add(picture.particles, {4 + away * std::cos(angle), height, 2.5 + away * std::sin(angle)}, 0,
        {2 * std::cos(angle), 7 * (0.4 + rise), 2 * std::sin(angle)});
  }
  return picture;
}

PictureScene by_speed() {
  PictureScene picture{"speed", ball_tank({8, 4, 4}, 0.12, ""), {}, render::ColorBy::speed};
  for_lattice({0.15, 0.12, 0.15}, {7.85, 1.9, 3.85}, 0.24, [&](const Vec3d& at, std::uint64_t k) {
    if (at.y < 0.4 + 1.5 * at.x / 8) add(picture.particles, jittered(at, 0.03, k), 0, {1.1 * at.x, -at.y, 0});
  });
  return picture;
}

// The pile again, with z upward, walls on four sides, and an eye and an orbit from the scene.
PictureScene orbit() {
  PictureScene picture{"orbit", ball_tank({4, 4, 4}, 0.3, "#4cb35a"), {}};
  picture.scene.gravity = {0, 0, -9.8};
  picture.scene.domain.boundary[2] = Boundary::open;
  SceneCamera& camera = picture.scene.camera;
  camera.eye = Vec3d{-7, -5, 4};
  camera.target = Vec3d{2, 2, 1};
  camera.field_of_view = 40;
  camera.orbit = 30;
  picture.time = 2;
  for_lattice({0.4, 0.4, 0.3}, {3.7, 3.7, 2.8}, 0.55, [&](const Vec3d& at, std::uint64_t k) {
    if (at.x + at.y + 1.5 * at.z < 5) add(picture.particles, jittered(at, 0.05, k));
  });
  return picture;
}

}  // namespace

Scene ball_tank(const Vec3d& size, double radius, const std::string& color) {
  Scene scene;
  scene.domain.max = size;
  scene.materials = {{"a", radius, 1, {}, 0, color}};
  return scene;
}

void add(ParticleSet& particles, const Vec3d& position, std::uint16_t material, const Vec3d& velocity) {
  particles.id.push_back(particles.size() + 1);
  particles.material.push_back(material);
  particles.position.push_back(position);
  particles.velocity.push_back(velocity);
}

std::vector<PictureScene> picture_scenes() {
  return {pile_in_three_colors(), large_on_small(), splash(), by_speed(), orbit()};
}

}  // namespace hooke::test
