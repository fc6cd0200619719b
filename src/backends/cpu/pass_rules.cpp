// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/pass_rules.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace hooke {

template <class Real>
PairRow<Real> PassRules<Real>::row_of(const ContactLaw<double>& law, Real reach) {
  const auto& [linear, surface] = law;
  return {real(linear.stiffness), real(linear.shear),    real(linear.damping),   reach,
          real(surface.friction), real(surface.tension), real(surface.cohesion), real(surface.range)};
}

template <class Real>
void PassRules<Real>::configure(const Scene& scene) {
  configure_materials(scene);
  configure_domain(scene.domain);
  pass.dt = real(scene.time_step);
  pass.gravity = vec_cast<Real>(scene.gravity);
  // A little below the limits, so that what double precision would find is always looked at.
  pass.speed_limit = real(0.999 * smallest_of_all_ / scene.time_step);
}

template <class Real>
void PassRules<Real>::configure_materials(const Scene& scene) {
  const ContactTable table(scene.materials, scene.contacts);
  // Materials of colliders alone come last where a file says it; without them there are fewer pairs to tell apart.
  std::size_t n = scene.materials.size();
  while (n > 0 && !scene.materials[n - 1].is_of_particles()) --n;
  pairs.assign(n * n, PairRow<Real>{});
  wall_pairs.assign(n, PairRow<Real>{});
  materials.assign(n, MaterialRow<Real>{});
  largest_radius = largest_touching = 0;
  smallest_radius = smallest_of_all_ = std::numeric_limits<double>::infinity();
  interacts_.assign(n, 1);
  widest_range = table.widest_range();
  pass.linear = table.is_linear();
  pass.has_drag = false;
  for (std::size_t a = 0; a < n; ++a) {
    const Material& m = scene.materials[a];
    if (!m.is_of_particles()) continue;
    materials[a] = {Real(1) / real(m.mass), real(m.drag), real(m.mass), real(m.radius)};
    pass.has_drag = pass.has_drag || m.drag > 0;
    largest_radius = std::max(largest_radius, m.radius);
    smallest_of_all_ = std::min(smallest_of_all_, m.radius);
    interacts_[a] = m.interacts ? 1 : 0;
    if (m.interacts) {
      largest_touching = std::max(largest_touching, m.radius);
      smallest_radius = std::min(smallest_radius, m.radius);
    }
    wall_pairs[a] = row_of(table.wall(a), real(m.radius));
    for (std::size_t b = 0; b < n; ++b) {
      pairs[a * n + b] = row_of(table.pair(a, b), real(m.radius) + real(scene.materials[b].radius));
    }
  }
  if (std::isinf(smallest_of_all_)) smallest_of_all_ = 1;
  if (std::isinf(smallest_radius)) smallest_radius = largest_touching = 1;  // nobody's
  all_interact = std::find(interacts_.begin(), interacts_.end(), 0) == interacts_.end();
  configure_levels();
  configure_few();
  pass.pairs = pairs.data();
  pass.wall_pairs = wall_pairs.data();
  pass.materials = materials.data();
  pass.few = few.empty() ? nullptr : few.data();
  pass.material_count = n;
}

template <class Real>
void PassRules<Real>::configure_few() {
  few.clear();
  if (pairs.size() > FewMaterials<Real>::kPairs) return;
  FewMaterials<Real>& columns = few.emplace_back();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    columns.stiffness[k] = pairs[k].stiffness;
    columns.shear[k] = pairs[k].shear;
    columns.damping[k] = pairs[k].damping;
    columns.reach[k] = pairs[k].reach;
    columns.friction[k] = pairs[k].friction;
    columns.tension[k] = pairs[k].tension;
    columns.cohesion[k] = pairs[k].cohesion;
    columns.range[k] = pairs[k].range;
  }
  for (std::size_t k = 0; k < materials.size(); ++k) {
    columns.inverse_mass[k] = materials[k].inverse_mass;
    columns.drag[k] = materials[k].drag;
    columns.mass[k] = materials[k].mass;
  }
}

// The largest radius of a level is no more than one and a half times the smallest.
template <class Real>
void PassRules<Real>::configure_levels() {
  std::vector<std::size_t> by_radius(materials.size());
  std::iota(by_radius.begin(), by_radius.end(), std::size_t{0});
  std::sort(by_radius.begin(), by_radius.end(),
            [&](std::size_t a, std::size_t b) { return materials[a].radius < materials[b].radius; });
  std::erase_if(by_radius, [&](std::size_t m) { return !(materials[m].radius > 0) || interacts_[m] == 0; });
  level_radius.clear();
  level_of.assign(materials.size(), 0);
  double smallest = 0;  // of the level
  for (const std::size_t m : by_radius) {
    const double radius = reach_of(m);
    if (level_radius.empty() || radius > 1.5 * smallest) {
      level_radius.push_back(radius);
      smallest = radius;
    }
    level_radius.back() = radius;
    level_of[m] = level_radius.size() - 1;
  }
}

template <class Real>
void PassRules<Real>::configure_domain(const Domain& domain) {
  rounding = 0;
  pass.min = vec_cast<Real>(domain.min);
  pass.max = vec_cast<Real>(domain.max);
  pass.length = pass.max - pass.min;
  pass.periodic_kind = PeriodicKind::none;
  for (int axis = 0; axis < 3; ++axis) {
    const Boundary boundary = domain.boundary[static_cast<std::size_t>(axis)];
    pass.wall[axis] = boundary == Boundary::spring;
    find_clear_range(axis);
    pass.periodic[axis] = boundary == Boundary::periodic;
    pass.open_or_periodic[axis] = boundary != Boundary::spring;
    pass.images[axis] = 0;
    component(pass.period, axis) = pass.periodic[axis] ? component(pass.length, axis) : Real(0);
    if (!pass.periodic[axis]) continue;
    const double length = component(pass.length, axis);
    pass.images[axis] = static_cast<int>(2 * largest_reach() / length) + 1;
    const bool only_nearest = length > 4.001 * largest_reach();
    if (!only_nearest) pass.periodic_kind = PeriodicKind::images;
    if (pass.periodic_kind == PeriodicKind::none) pass.periodic_kind = PeriodicKind::nearest;
    rounding = std::max(rounding, 4 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * length);
  }
}

// What rounding a bound, or the distance from a wall, may take is far less than two steps outwards.
template <class Real>
void PassRules<Real>::find_clear_range(int axis) {
  constexpr Real kInfinite = std::numeric_limits<Real>::infinity();
  Real from = -kInfinite, to = kInfinite;
  if (pass.wall[axis]) {
    const double reach = largest_radius + widest_range;
    from = std::nextafter(std::nextafter(real(component(pass.min, axis) + reach), kInfinite), kInfinite);
    to = std::nextafter(std::nextafter(real(component(pass.max, axis) - reach), -kInfinite), -kInfinite);
  }
  component(pass.clear_of_walls_from, axis) = from;
  component(pass.clear_of_walls_to, axis) = to;
}

template struct PassRules<float>;
template struct PassRules<double>;

}  // namespace hooke
