// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/interpolate.h"

#include <cmath>

#include "hooke/base/ascending.h"
#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"
#include "hooke/physics/periodic.h"

namespace hooke::render {

namespace {

constexpr std::size_t kGrain = 16384;

// For every particle of `before`, its index in `after`, or after.size() where `after` lacks it.
std::vector<std::size_t> partners(const ParticleSet& before, const ParticleSet& after) {
  std::vector<std::size_t> partner(before.size(), after.size());
  for (std::size_t i = 0, j = 0; i < before.size(); ++i) {
    while (j < after.size() && after.id[j] < before.id[i]) ++j;
    if (j < after.size() && after.id[j] == before.id[i]) partner[i] = j;
  }
  return partner;
}

// `move` the short way, where an axis is periodic.
Vec3d shortest(Vec3d move, const Domain& domain) {
  for (int axis = 0; axis < 3; ++axis) {
    if (domain.boundary[static_cast<std::size_t>(axis)] != Boundary::periodic) continue;
    double& along = component(move, axis);
    along -= domain.length(axis) * std::round(along / domain.length(axis));
  }
  return move;
}

Vec3d wrapped(Vec3d position, const Domain& domain) {
  for (int axis = 0; axis < 3; ++axis) {
    if (domain.boundary[static_cast<std::size_t>(axis)] != Boundary::periodic) continue;
    double& along = component(position, axis);
    along = wrap_coordinate(along, component(domain.min, axis), component(domain.max, axis));
  }
  return position;
}

}  // namespace

ParticleSet interpolate(const Scene& scene, const Moment& before, const Moment& after, double time) {
  HOOKE_ASSERT(before.time <= time && time <= after.time, before.time, time, after.time);
  HOOKE_ASSERT(is_ascending(before.particles.id) && is_ascending(after.particles.id));
  ParticleSet now = before.particles;
  const double span = after.time - before.time;
  if (!(span > 0) || time <= before.time) return now;
  const double s = (time - before.time) / span;
  // The cubic Hermite polynomials: factors of the displacement and of both velocities.
  const double moved = s * s * (3 - 2 * s);
  const double leaving = span * s * (1 - s) * (1 - s), arriving = span * s * s * (s - 1);
  const std::vector<std::size_t> partner = partners(before.particles, after.particles);
  parallel_ranges(now.size(), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Vec3d x = before.particles.position[i], v = before.particles.velocity[i];
      const std::size_t j = partner[i];
      if (j == after.particles.size()) {
        now.position[i] = wrapped(x + (s * span) * v, scene.domain);
        continue;
      }
      const Vec3d w = after.particles.velocity[j];
      const Vec3d move = shortest(after.particles.position[j] - x, scene.domain);
      now.position[i] = wrapped(x + moved * move + leaving * v + arriving * w, scene.domain);
      now.velocity[i] = (1 - s) * v + s * w;
    }
  });
  return now;
}

ParticleSet drawn_back(const Scene& scene, const ParticleSet& particles, double seconds) {
  HOOKE_ASSERT(seconds >= 0, seconds);
  ParticleSet then = particles;
  for (std::size_t i = 0; i < then.size(); ++i) {
    then.position[i] = wrapped(then.position[i] - seconds * then.velocity[i], scene.domain);
  }
  return then;
}

}  // namespace hooke::render
