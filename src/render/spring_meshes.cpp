// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/spring_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "hooke/base/assert.h"
#include "hooke/physics/periodic.h"
#include "hooke/physics/spring.h"

namespace hooke::render {

namespace {

constexpr int kSides = 8;
constexpr double kThickness = 0.4;    // of a rod over its thinner end's particle
constexpr double kFullStrain = 0.1;   // where springs don't break
constexpr double kStrainSteps = 32;   // either way: as many colours

// A rod from `from` to `to`, without ends: particles are there.
void add_rod(ShadedMesh& mesh, const Vec3d& from, const Vec3d& to, double radius) {
  const Vec3d along = to - from;
  const double length = std::sqrt(dot(along, along));
  if (!(length > 0)) return;
  const Vec3d axis = (1 / length) * along;
  const Vec3d beside = cross(axis, std::abs(axis.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0});
  const Vec3d u = (1 / std::sqrt(dot(beside, beside))) * beside, v = cross(axis, u);
  std::array<Vec3d, kSides + 1> around;
  for (int k = 0; k <= kSides; ++k) {
    const double angle = 2 * std::numbers::pi * k / kSides;
    around[static_cast<std::size_t>(k)] = std::cos(angle) * u + std::sin(angle) * v;
  }
  const auto corner = [&](const Vec3d& end, const Vec3d& normal) {
    mesh.corners.push_back({vec_cast<float>(end + radius * normal), vec_cast<float>(normal)});
  };
  for (std::size_t k = 0; k < kSides; ++k) {
    const Vec3d &a = around[k], &b = around[k + 1];
    corner(from, a);
    corner(from, b);
    corner(to, b);
    corner(from, a);
    corner(to, b);
    corner(to, a);
  }
}

}  // namespace

Color strain_color(double share) {
  constexpr std::array<double, 3> kWhite{235, 235, 230}, kRed{214, 40, 34}, kBlue{38, 92, 214};
  const double full = std::clamp(std::abs(share), 0.0, 1.0);
  const std::array<double, 3>& end = share < 0 ? kBlue : kRed;
  const auto channel = [&](std::size_t k) {
    return static_cast<std::uint8_t>(std::lround(std::lerp(kWhite[k], end[k], full)));
  };
  return {channel(0), channel(1), channel(2)};
}

std::vector<ShadedMesh> spring_meshes(const Scene& scene, const ParticleSet& particles, const Vec3d& origin,
                                      const std::function<Color(std::size_t)>& color_of,
                                      const std::vector<char>& covered) {
  HOOKE_ASSERT(covered.size() == particles.size(), covered.size(), particles.size());
  std::vector<ShadedMesh> meshes;
  if (!scene.structure || scene.picture.springs == SpringLook::none) return meshes;
  const SpringSet& springs = scene.structure->springs;
  std::map<std::array<std::uint8_t, 3>, std::size_t> mesh_of;
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const std::size_t i = particles.find(springs.a[s]), k = particles.find(springs.b[s]);
    if (i == particles.size() || k == particles.size() || (covered[i] != 0 && covered[k] != 0)) continue;
    const Vec3d &from = particles.position[i], &to = particles.position[k];
    const Vec3d across = nearest_displacement(to, from, scene.domain.period());
    if (dot(across, across) < 0.999 * dot(to - from, to - from)) continue;  // through a periodic face
    const double rest = springs.rest_length[s], extension = std::sqrt(dot(across, across)) - rest;
    if (spring_tears(extension, rest, springs.break_strain[s])) continue;
    Color color = color_of(i);
    if (scene.picture.springs == SpringLook::strain) {
      const double full = std::isinf(springs.break_strain[s]) ? kFullStrain : springs.break_strain[s];
      color = strain_color(std::round(kStrainSteps * std::clamp(extension / rest / full, -1.0, 1.0)) / kStrainSteps);
    }
    const auto [found, is_new] = mesh_of.insert({{color.red, color.green, color.blue}, meshes.size()});
    if (is_new) {
      meshes.emplace_back();
      meshes.back().color = color;
    }
    const double thinner =
        std::min(scene.materials[particles.material[i]].radius, scene.materials[particles.material[k]].radius);
    add_rod(meshes[found->second], from - origin, to - origin, kThickness * thinner);
  }
  return meshes;
}

}  // namespace hooke::render
