// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/rules.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hooke/core/materials.h"

namespace hooke {

namespace {

template <class Real>
Real real(double value) {
  return static_cast<Real>(value);
}

template <class Real>
PairRow<Real> row_of(const ContactLaw<double>& law, Real contact_distance) {
  const auto& [linear, surface] = law;
  return {real<Real>(linear.stiffness), real<Real>(linear.shear),
          real<Real>(linear.damping),   contact_distance,
          real<Real>(surface.friction), real<Real>(surface.tension),
          real<Real>(surface.cohesion), real<Real>(surface.range)};
}

}  // namespace

template <class Real>
Rules<Real>::Rules(const Scene& scene) {
  compile_materials(scene);
  compile_domain(scene.domain);
  view_.dt = real<Real>(scene.time_step);
  view_.gravity = vec_cast<Real>(scene.gravity);
  // A little below the limits, so that every approach that double precision would report is checked.
  view_.speed_limit = real<Real>(0.999 * smallest_radius_ / scene.time_step);
}

template <class Real>
void Rules<Real>::compile_materials(const Scene& scene) {
  const ContactTable table(scene.materials, scene.contacts);
  // Scene files put materials of colliders alone last; without these there are fewer pairs to tell apart.
  std::size_t n = scene.materials.size();
  while (n > 0 && !scene.materials[n - 1].is_of_particles()) --n;
  pairs_.assign(n * n, PairRow<Real>{});
  wall_pairs_.assign(n, PairRow<Real>{});
  materials_.assign(n, MaterialRow<Real>{});
  interacts_.assign(n, 1);
  widest_range_ = table.widest_range();
  constexpr double kNone = std::numeric_limits<double>::infinity();
  smallest_radius_ = smallest_touching_ = kNone;
  for (std::size_t a = 0; a < n; ++a) {
    const Material& m = scene.materials[a];
    if (!m.is_of_particles()) continue;
    materials_[a] = {Real(1) / real<Real>(m.mass), real<Real>(m.drag), real<Real>(m.mass), real<Real>(m.radius)};
    view_.has_drag = view_.has_drag || m.drag > 0;
    largest_radius_ = std::max(largest_radius_, m.radius);
    smallest_radius_ = std::min(smallest_radius_, m.radius);
    interacts_[a] = m.interacts ? 1 : 0;
    if (m.interacts) {
      largest_touching_ = std::max(largest_touching_, m.radius);
      smallest_touching_ = std::min(smallest_touching_, m.radius);
    }
    wall_pairs_[a] = row_of(table.wall(a), real<Real>(m.radius));
    for (std::size_t b = 0; b < n; ++b) {
      pairs_[a * n + b] = row_of(table.pair(a, b), real<Real>(m.radius) + real<Real>(scene.materials[b].radius));
    }
  }
  if (smallest_radius_ == kNone) smallest_radius_ = 1;
  if (smallest_touching_ == kNone) smallest_touching_ = largest_touching_ = 1;
  for (const Collider& collider : scene.colliders) {
    for (std::size_t m = 0; m < n; ++m) {
      collider_pairs_.push_back(row_of(table.collider(m, collider.material), real<Real>(scene.materials[m].radius)));
    }
  }
  view_.material_count = n;
  view_.pairs = pairs_.data();
  view_.wall_pairs = wall_pairs_.data();
  view_.collider_pairs = collider_pairs_.data();
  view_.materials = materials_.data();
  view_.linear = table.is_linear();
}

template <class Real>
void Rules<Real>::compile_domain(const Domain& domain) {
  view_.min = vec_cast<Real>(domain.min);
  view_.max = vec_cast<Real>(domain.max);
  view_.length = view_.max - view_.min;
  for (int axis = 0; axis < 3; ++axis) {
    const Boundary boundary = domain.boundary[static_cast<std::size_t>(axis)];
    view_.wall[axis] = boundary == Boundary::spring;
    view_.periodic[axis] = boundary == Boundary::periodic;
    view_.open_or_periodic[axis] = boundary != Boundary::spring;
    if (!view_.periodic[axis]) continue;
    component(view_.period, axis) = component(view_.length, axis);
    const double length = component(view_.length, axis);
    view_.images[axis] = static_cast<int>(2 * largest_interaction_radius() / length) + 1;
    const bool only_nearest = length > 4.001 * largest_interaction_radius();
    if (!only_nearest) view_.periodic_kind = PeriodicKind::images;
    if (view_.periodic_kind == PeriodicKind::none) view_.periodic_kind = PeriodicKind::nearest;
    rounding_ = std::max(rounding_, 4 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * length);
  }
}

template class Rules<float>;
template class Rules<double>;

}  // namespace hooke
