// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/passes/pass_rules.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace hooke {

template <class Real>
PassRules<Real>::PassRules(const Scene& scene) : Rules<Real>(scene) {
  static_cast<RulesView<Real>&>(constants_) = this->view();
  find_few();
  find_levels();
  for (int axis = 0; axis < 3; ++axis) find_clear_range(axis);
}

template <class Real>
void PassRules<Real>::find_few() {
  const std::size_t count = this->material_count();
  if (count * count > FewMaterials<Real>::kPairs) return;
  FewMaterials<Real>& columns = few_.emplace_back();
  for (std::size_t k = 0; k < count * count; ++k) {
    const PairRow<Real>& pair = constants_.pairs[k];
    columns.stiffness[k] = pair.stiffness;
    columns.shear[k] = pair.shear;
    columns.damping[k] = pair.damping;
    columns.contact_distance[k] = pair.contact_distance;
    columns.friction[k] = pair.friction;
    columns.tension[k] = pair.tension;
    columns.cohesion[k] = pair.cohesion;
    columns.range[k] = pair.range;
  }
  for (std::size_t k = 0; k < count; ++k) {
    const MaterialRow<Real>& material = constants_.materials[k];
    columns.inverse_mass[k] = material.inverse_mass;
    columns.drag[k] = material.drag;
    columns.mass[k] = material.mass;
  }
  constants_.few = few_.data();
}

// The largest radius of a level is no more than one and a half times the smallest.
template <class Real>
void PassRules<Real>::find_levels() {
  std::vector<std::size_t> by_radius(this->material_count());
  std::iota(by_radius.begin(), by_radius.end(), std::size_t{0});
  std::sort(by_radius.begin(), by_radius.end(),
            [&](std::size_t a, std::size_t b) { return this->material(a).radius < this->material(b).radius; });
  std::erase_if(by_radius, [&](std::size_t m) { return !(this->material(m).radius > 0) || !this->interacts(m); });
  level_of_.assign(this->material_count(), 0);
  double smallest = 0;  // of the level
  for (const std::size_t m : by_radius) {
    const double radius = this->interaction_radius(m);
    if (level_radius_.empty() || radius > 1.5 * smallest) {
      level_radius_.push_back(radius);
      smallest = radius;
    }
    level_radius_.back() = radius;
    level_of_[m] = level_radius_.size() - 1;
  }
}

// Two steps outwards are far more than the rounding of a bound, or of the distance from a wall.
template <class Real>
void PassRules<Real>::find_clear_range(int axis) {
  constexpr Real kInfinite = std::numeric_limits<Real>::infinity();
  Real from = -kInfinite, to = kInfinite;
  if (constants_.wall[axis]) {
    const auto outward = [](double x, Real end) {
      return std::nextafter(std::nextafter(static_cast<Real>(x), end), end);
    };
    const double contact_distance = this->largest_body_distance();
    from = outward(component(constants_.min, axis) + contact_distance, kInfinite);
    to = outward(component(constants_.max, axis) - contact_distance, -kInfinite);
  }
  component(constants_.clear_of_walls_from, axis) = from;
  component(constants_.clear_of_walls_to, axis) = to;
}

template class PassRules<float>;
template class PassRules<double>;

}  // namespace hooke
