// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "support/particles.h"

#include <cmath>

#include "hooke/base/random.h"

namespace hooke::test {

std::array<double, 4> random4(std::uint64_t seed, std::uint64_t index) { return uniform4(seed, index, 0); }

namespace {

// The number of materials before the materials that only colliders have.
std::size_t particle_materials(const Scene& scene) {
  std::size_t count = 0;
  while (count < scene.materials.size() && scene.materials[count].is_of_particles()) ++count;
  return count;
}

}  // namespace

Scene open_scene() {
  Scene scene;
  scene.name = "open";
  scene.time_step = 0.001;
  scene.precision = Precision::double_precision;
  scene.gravity = {0, 0, 0};
  scene.domain.min = {-100, -100, -100};
  scene.domain.max = {100, 100, 100};
  scene.domain.boundary = {Boundary::open, Boundary::open, Boundary::open};
  scene.materials.push_back({"a", 0.5, 1, {1000, 2, 3}, 0, ""});
  return scene;
}

void mix_materials(Scene& scene, double radius) {
  scene.materials = {{"a", radius, 1, {6000, 2, 8}, 0, ""},
                     {"b", 1.6 * radius, 2.5, {8000, 3, 9}, 0.1, ""},
                     {"c", 0.7 * radius, 0.6, {5000, 1, 4}, 0.02, ""}};
  scene.contacts = {{0, 1, {5500, 2.5, 7}}, {1, ContactEntry::kWall, {9000, 1, 6}}};
}

void add_surfaces(Scene& scene) {
  constexpr double kNone = INFINITY;
  scene.materials[0].surface = {0.4, kNone, 2, 0.09375};
  scene.materials[1].surface = {0.2, 0, 3, 0.0625};
  scene.materials[2].surface = {kNone, 0, 0, 0};
  scene.contacts[0].surface = {0.3, kNone, 1, 0.125};
  scene.contacts[1].surface = {0.1, 0, 2, 0.03125};
}

void add(ParticleSet& particles, const Vec3d& position, const Vec3d& velocity, std::uint16_t material) {
  particles.id.push_back(particles.empty() ? 1 : particles.id.back() + 1);
  particles.material.push_back(material);
  particles.position.push_back(position);
  particles.velocity.push_back(velocity);
}

ParticleSet pair_on_x(const Scene& scene, double overlap, const Vec3d& v_1, const Vec3d& v_2) {
  ParticleSet particles;
  const auto second = static_cast<std::uint16_t>(scene.materials.size() - 1);
  const double reach = scene.materials.front().radius + scene.materials[second].radius;
  add(particles, {0, 0, 0}, v_1, 0);
  add(particles, {reach - overlap, 0, 0}, v_2, second);
  return particles;
}

ParticleSet cloud(const Scene& scene, std::size_t count, const Vec3d& min, const Vec3d& max, double speed,
                  std::uint64_t seed) {
  ParticleSet particles;
  particles.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto u = random4(seed, 2 * i);
    const auto w = random4(seed, 2 * i + 1);
    particles.id[i] = 3 * i + 1 + (i % 2);
    particles.material[i] = static_cast<std::uint16_t>(i % particle_materials(scene));
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      component(particles.position[i], axis) =
          component(min, axis) + u[k] * (component(max, axis) - component(min, axis));
      component(particles.velocity[i], axis) = speed * (2 * w[k] - 1);
    }
  }
  return particles;
}

ParticleSet lattice(const Scene& scene, const std::array<int, 3>& count, const Vec3d& corner, double spacing,
                    double jitter, std::uint64_t seed) {
  ParticleSet particles;
  for (int z = 0; z < count[2]; ++z) {
    for (int y = 0; y < count[1]; ++y) {
      for (int x = 0; x < count[0]; ++x) {
        const std::size_t i = particles.size();
        const auto u = random4(seed, i);
        const Vec3d moved{jitter * (2 * u[0] - 1), jitter * (2 * u[1] - 1), jitter * (2 * u[2] - 1)};
        add(particles, corner + spacing * Vec3d{double(x), double(y), double(z)} + moved, {0, 0, 0},
            static_cast<std::uint16_t>(i % particle_materials(scene)));
      }
    }
  }
  return particles;
}

}  // namespace hooke::test
