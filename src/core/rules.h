// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hooke/core/rules_view.h"
#include "hooke/core/scene.h"
#include "hooke/physics/contact.h"
#include "hooke/physics/periodic.h"

namespace hooke {

/// A scene compiled once, in a back end's number type, into the plain arrays that all back ends read: what each pair of
/// materials does, walls, colliders' laws, the domain and the integrator's numbers.
template <class Real>
class Rules {
 public:
  Rules() = default;
  explicit Rules(const Scene& scene);
  Rules(const Rules&) = delete;  // the view points into it
  Rules& operator=(const Rules&) = delete;
  Rules(Rules&&) noexcept = default;
  Rules& operator=(Rules&&) noexcept = default;

  const RulesView<Real>& view() const { return view_; }

  std::size_t material_count() const { return view_.material_count; }
  const PairRow<Real>& pair(std::size_t a, std::size_t b) const { return pairs_[a * material_count() + b]; }
  const PairRow<Real>& wall(std::size_t a) const { return wall_pairs_[a]; }
  /// The row of material a and a collider of the scene.
  const PairRow<Real>& collider(std::size_t a, std::size_t c) const {
    return collider_pairs_[c * material_count() + a];
  }
  const MaterialRow<Real>& material(std::size_t a) const { return materials_[a]; }
  /// Whether particles of this material touch others.
  bool interacts(std::size_t a) const { return interacts_[a] != 0; }

  double largest_radius() const { return largest_radius_; }  ///< of all particles, m
  double largest_touching() const { return largest_touching_; }  ///< of particles that touch others, m; 1 without one
  double smallest_touching() const { return smallest_touching_; }  ///< likewise
  /// Particles act on each other, and walls on them, across gaps up to this, m.
  double widest_range() const { return widest_range_; }

  /// Interaction radius of a material's particles, m: two particles act on each other only within the sum of theirs.
  double interaction_radius(std::size_t material) const { return materials_[material].radius + widest_range_ / 2; }
  double largest_interaction_radius() const { return largest_touching_ + widest_range_ / 2; }
  /// Largest distance from a particle's centre at which a wall or a collider acts on it, m.
  double largest_body_distance() const { return largest_radius_ + widest_range_; }
  /// A bound on the rounding of a displacement across a periodic axis, m.
  double rounding() const { return rounding_; }

 private:
  void compile_materials(const Scene& scene);
  void compile_domain(const Domain& domain);

  std::vector<PairRow<Real>> pairs_, wall_pairs_, collider_pairs_;
  std::vector<MaterialRow<Real>> materials_;
  std::vector<std::uint8_t> interacts_;
  double largest_radius_ = 0, largest_touching_ = 0, smallest_touching_ = 1, smallest_radius_ = 1;
  double widest_range_ = 0, rounding_ = 0;
  RulesView<Real> view_;
};

extern template class Rules<float>;
extern template class Rules<double>;

/// A row's law.
template <class Real>
ContactLaw<double> law_of(const PairRow<Real>& row) {
  return {{row.stiffness, row.shear, row.damping}, {row.friction, row.tension, row.cohesion, row.range}};
}

/// Brings the coordinates (m) of a point along periodic axes back into the domain.
template <class Real>
HOOKE_HD void wrap_periodic(const RulesView<Real>& rules, Vec3<Real>& x) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!rules.periodic[axis]) continue;
    component(x, axis) = wrap_coordinate(component(x, axis), component(rules.min, axis), component(rules.max, axis));
  }
}

/// Whether a point (m) has left through an open face.
template <class Real>
HOOKE_HD bool is_outside_open_face(const RulesView<Real>& rules, const Vec3<Real>& x) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!rules.open_or_periodic[axis] || rules.periodic[axis]) continue;
    if (component(x, axis) < component(rules.min, axis) || component(x, axis) > component(rules.max, axis)) return true;
  }
  return false;
}

}  // namespace hooke
