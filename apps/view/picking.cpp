// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "picking.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hooke::view {
namespace {

double norm(const Vec3d& v) { return std::sqrt(dot(v, v)); }

// Where a ray meets a triangle, m along it (T. Moeller, B. Trumbore, "Fast, minimum storage ray-triangle intersection",
// 1997).
std::optional<double> meet(const Ray& ray, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d u = b - a, v = c - a, p = cross(ray.direction, v);
  const double det = dot(u, p);
  if (det == 0) return {};
  const Vec3d from = ray.from - a, q = cross(from, u);
  const double x = dot(from, p) / det, y = dot(ray.direction, q) / det, t = dot(v, q) / det;
  if (x < 0 || y < 0 || x + y > 1 || t <= 0) return {};
  return t;
}

}  // namespace

Ray ray_through(const render::Camera& camera, double x, double y, double aspect) {
  const render::CameraAxes own = render::axes(camera);
  const double tangent = std::tan(camera.field_of_view * std::numbers::pi / 360);
  const Vec3d direction = (2 * x - 1) * tangent * aspect * own.right + (1 - 2 * y) * tangent * own.up - own.back;
  return {camera.eye, (1 / norm(direction)) * direction};
}

std::optional<Hit> pick_particle(const ViewFrame& frame, std::span<const float> radii, const Ray& ray,
                                 const std::optional<render::ClipPlane>& clip) {
  std::optional<Hit> first;
  for (std::size_t i = 0; i < frame.particles.size(); ++i) {
    const render::LiveParticle& p = frame.particles[i];
    const std::uint32_t material = p.tag >> 16;
    if (p.tag == render::kHiddenParticle || material >= radii.size()) continue;
    if (clip && dot(clip->normal, Vec3f{p.x, p.y, p.z}) > clip->offset) continue;
    const Vec3d off = Vec3d{p.x, p.y, p.z} - ray.from;
    const double along = dot(off, ray.direction), radius = radii[material];
    const double square = radius * radius - (dot(off, off) - along * along);
    if (square < 0 || along <= 0) continue;
    const double distance = along - std::sqrt(square);
    if (distance > 0 && (!first || distance < first->distance)) first = Hit{distance, i};
  }
  return first;
}

std::optional<Hit> pick_mesh(std::span<const render::ShadedMesh> meshes, const Ray& ray) {
  std::optional<Hit> first;
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const std::vector<render::ShadedMesh::Corner>& corners = meshes[k].corners;
    for (std::size_t c = 0; c + 2 < corners.size(); c += 3) {
      const auto at = meet(ray, vec_cast<double>(corners[c].position), vec_cast<double>(corners[c + 1].position),
                           vec_cast<double>(corners[c + 2].position));
      if (at && (!first || *at < first->distance)) first = Hit{*at, k};
    }
  }
  return first;
}

std::vector<std::uint64_t> particles_near(const ViewFrame& frame, const Vec3d& center, double radius,
                                          std::size_t most) {
  std::vector<std::pair<double, std::uint64_t>> near;
  for (std::size_t i = 0; i < frame.particles.size(); ++i) {
    const render::LiveParticle& p = frame.particles[i];
    const Vec3d off = Vec3d{p.x, p.y, p.z} - center;
    if (dot(off, off) <= radius * radius) near.emplace_back(dot(off, off), frame.ids[i]);
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min(near.size(), most));
  std::vector<std::uint64_t> ids;
  for (const auto& [distance, id] : near) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::vector<std::uint64_t> springs_near(const Structure& structure, const ParticleSet& particles, const Vec3d& origin,
                                        const Ray& ray, double radius, double depth) {
  std::vector<std::uint64_t> found;
  const SpringSet& springs = structure.springs;
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const std::size_t a = particles.find(springs.a[s]), b = particles.find(springs.b[s]);
    if (a == particles.size() || b == particles.size()) continue;
    const Vec3d off = 0.5 * (particles.position[a] + particles.position[b]) - origin - ray.from;
    const double along = dot(off, ray.direction);
    if (along <= 0 || along > depth + radius) continue;
    if (dot(off, off) - along * along <= radius * radius) found.push_back(s);
  }
  return found;
}

}  // namespace hooke::view
