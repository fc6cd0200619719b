// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "support/capsule_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "support/made_meshes.h"

namespace hooke::test {
namespace {

constexpr int kCells = DistanceFieldView::kCells, kSamples = DistanceFieldView::kSamples;
constexpr int kPieces = 16;  // around the axis, of the triangles

// Distance (m) of x, relative to the capsule's middle, from the whole surface (negative inside), or from the shell
// without the upper cap.
double capsule_distance(const Vec3d& x, double radius, bool closed) {
  const double across = std::sqrt(x.x * x.x + x.z * x.z);
  const double beyond = x.y - std::clamp(x.y, -radius, radius);  // beyond the axis's ends
  const double distance = std::sqrt(across * across + beyond * beyond) - radius;
  if (closed) return distance;
  if (x.y <= radius) return std::abs(distance);
  return std::sqrt((across - radius) * (across - radius) + beyond * beyond);  // from the rim
}

// Adds the next brick, with its first sample at (x0, y0, z0). It gets samples if any of them is in the band.
template <class Distance>
void add_brick(DistanceField& field, int x0, int y0, int z0, const Distance& distance) {
  std::array<float, kSamples * kSamples * kSamples> samples;
  std::size_t n = 0;
  for (int z = 0; z < kSamples; ++z) {
    for (int y = 0; y < kSamples; ++y) {
      for (int x = 0; x < kSamples; ++x) samples[n++] = distance(x0 + x, y0 + y, z0 + z);
    }
  }
  const auto band = static_cast<float>(field.band);
  if (std::none_of(samples.begin(), samples.end(), [&](float d) { return std::abs(d) <= band; })) {
    return;
  }
  field.keys.push_back(brick_key(x0 / kCells, y0 / kCells, z0 / kCells));
  field.samples.insert(field.samples.end(), samples.begin(), samples.end());
}

}  // namespace

MeshShape capsule_with_field(const Vec3d& middle, double radius, bool closed, double reach) {
  TriangleMesh mesh = capsule_mesh(radius, -radius, radius, kPieces);
  const std::ptrdiff_t rings_of_cap = kPieces / 4;  // the first ring has triangles, the others have four corners
  if (!closed) mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + kPieces * (2 * rings_of_cap - 1));
  for (Vec3d& x : mesh.vertices) x += middle;

  DistanceField field;
  field.cell = 0.2 * radius;
  field.open = !closed;
  field.band = reach + 3 * field.cell;
  field.min = middle - radius * Vec3d{1, 2, 1};
  field.max = middle + radius * Vec3d{1, closed ? 2.0 : 1.0, 1};
  const double brick = kCells * field.cell;
  const Vec3d lower = field.min - Vec3d{field.band, field.band, field.band};
  const Vec3d upper = field.max + Vec3d{field.band, field.band, field.band};
  for (int axis = 0; axis < 3; ++axis) {
    const double first = std::floor(component(lower, axis) / brick);
    component(field.origin, axis) = first * brick;
    field.bricks[static_cast<std::size_t>(axis)] =
        static_cast<std::int32_t>(std::ceil(component(upper, axis) / brick) - first);
  }
  const auto distance = [&](int x, int y, int z) {  // at a sample
    const Vec3d at{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
    return static_cast<float>(capsule_distance(field.origin + field.cell * at - middle, radius, closed));
  };
  for (int z = 0; z < field.bricks[2]; ++z) {
    for (int y = 0; y < field.bricks[1]; ++y) {
      for (int x = 0; x < field.bricks[0]; ++x) add_brick(field, kCells * x, kCells * y, kCells * z, distance);
    }
  }
  field.make_directory();
  return {std::make_shared<const TriangleMesh>(std::move(mesh)),
          std::make_shared<const DistanceField>(std::move(field))};
}

}  // namespace hooke::test
