// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/base/box3.h"
#include "hooke/base/exact_sum.h"
#include "hooke/core/condition.h"
#include "hooke/core/measurements.h"
#include "hooke/core/work.h"
#include "hooke/physics/contact.h"

namespace hooke {

/// Three exact sums, one per component.
class ExactVectorSum {
 public:
  void add(const Vec3d& a) {
    sums_[0].add(a.x);
    sums_[1].add(a.y);
    sums_[2].add(a.z);
  }
  void add(const ExactVectorSum& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) sums_[axis].add(other.sums_[axis]);
  }
  ExactSum& operator[](int axis) { return sums_[static_cast<std::size_t>(axis)]; }
  const ExactSum& operator[](int axis) const { return sums_[static_cast<std::size_t>(axis)]; }
  Vec3d value() const { return {sums_[0].value(), sums_[1].value(), sums_[2].value()}; }

  friend bool operator==(const ExactVectorSum&, const ExactVectorSum&) = default;

 private:
  std::array<ExactSum, 3> sums_;
};

/// The rates of one evaluation of the forces, gathered particle by particle in any order.
struct StepSums {
  /// Powers at twice the mean of the velocities before and after a kick, W: of the kick that comes with the evaluation,
  /// and, under velocity Verlet, of the one that the next step begins with. For applied causes, see AppliedSums.
  ByCause<ExactSum, kPassCauses> power, next_power;
  ExactVectorSum wall_force;  ///< N
  ExactVectorSum drag_force;  ///< N
  ExactVectorSum collider_force;  ///< N

  void add(const StepSums& other);
};

/// What springs do beside their work.
struct SpringSums {
  ExactSum dissipation;  ///< by their dampers, W; half from each end
  ExactSum broken_energy;  ///< that was in springs that broke, J
  std::uint64_t broken = 0;  ///< springs that broke

  void add(const SpringSums& other);
};

/// The same for applied causes, and SpringSums.
struct AppliedSums {
  struct Rates {
    ExactSum power, next_power;  ///< as in StepSums, W
    ExactVectorSum force;  ///< N
  };

  /// The rates of an applied cause.
  Rates& operator[](Cause cause) {
    HOOKE_ASSERT(static_cast<std::size_t>(cause) >= kPassCauses, cause);
    return of[static_cast<std::size_t>(cause) - kPassCauses];
  }
  const Rates& operator[](Cause cause) const {
    HOOKE_ASSERT(static_cast<std::size_t>(cause) >= kPassCauses, cause);
    return of[static_cast<std::size_t>(cause) - kPassCauses];
  }

  /// A pinned particle, which kept its velocity `pinned` in place of `kicked` (m/s) over `seconds` (> 0).
  void add_pinned(double mass, const Vec3d& pinned, const Vec3d& kicked, double seconds);
  void add(const AppliedSums& other);

  std::array<Rates, kCauses - kPassCauses> of;
  SpringSums springs;
};

/// What a step's evaluation of the forces found beside the particles' new state. Sums are exact, so that parts may be
/// added up in any order.
struct StepReport {
  Condition condition;
  StepSums sums;
  std::optional<AppliedSums> applied;  ///< nothing where the scene has no such causes
  ExactSum mass;  ///< of all particles, kg
};

/// Sums over particles that leave, or come.
struct RemovalSums {
  ExactVectorSum momentum;  ///< kg m/s
  ExactSum energy;  ///< J
  ExactSum elastic;  ///< in contacts between particles and in springs, each counted once, J
  std::uint64_t count = 0;

  void add_particle(double mass, const Vec3d& x, const Vec3d& v, const Vec3d& gravity);
  void add(const RemovalSums& other);

  friend bool operator==(const RemovalSums&, const RemovalSums&) = default;
};

/// The load of particles on each collider, gathered in any order.
class ColliderLoadSums {
 public:
  /// A particle that touches collider `index` at `point` (m, from the pivot) and gets `force` (N) from it.
  void add_contact(std::size_t index, const Vec3d& point, const Vec3d& force);
  void add(const ColliderLoadSums& other);
  /// One entry for each of `count` colliders, which is above all indices that were added.
  std::vector<ColliderLoad> result(std::size_t count) const;

  /// Appends it as bytes, and reads these back, to the last one.
  void write(std::vector<std::byte>& to) const;
  void read(std::span<const std::byte> from);

 private:
  struct Load {
    ExactVectorSum force, torque;
    std::uint64_t contacts = 0;
  };
  std::map<std::size_t, Load> loads_;  // of touched colliders
};

/// Gathers Measurements particle by particle and contact by contact in any order.
class MeasurementSums {
 public:
  void add_particle(double mass, const Vec3d& x, const Vec3d& v, const Vec3d& gravity);
  /// One side of a contact between particles, which cohesion may hold across a gap: call for each of the two. `reach`
  /// is r_i + r_p, m, > 0.
  void add_contact_side(const ContactLaw<double>& law, double overlap, double reach);
  /// A particle of `radius` (m, > 0) that a wall gives `force` (N).
  void add_wall_contact(const ContactLaw<double>& law, double overlap, double radius, const Vec3d& force);
  /// A particle of `radius` (m, > 0) that touches collider `index` at `point` (m, from the pivot) and gets `force` (N)
  /// from it.
  void add_collider_contact(std::size_t index, const Vec3d& point, const ContactLaw<double>& law, double overlap,
                            double radius, const Vec3d& force);
  /// `count` springs of the scene's structure that hold, with this energy, J, in them.
  void add_springs(std::uint64_t count, const ExactSum& energy);
  /// Energy of particles in the attraction of all others, J.
  void add_attraction(double energy) { totals_.attraction_energy.add(energy); }
  void add_attraction(const ExactSum& energy) { totals_.attraction_energy.add(energy); }
  void add(const MeasurementSums& other);
  /// Appends it as bytes, for another rank to add.
  void write(std::vector<std::byte>& to) const;
  void add(std::span<const std::byte> from);
  /// `colliders`: how many the scene has.
  Measurements result(std::size_t colliders) const;

 private:
  struct Totals {
    std::uint64_t particles = 0, contact_sides = 0, wall_contacts = 0, springs = 0;
    ExactSum mass, kinetic, potential, elastic, wall_elastic, overlap_ratio, momentum_scale;
    ExactVectorSum momentum, mass_moment, wall_force;
    ExactSum collider_elastic, spring_energy, attraction_energy;
    double max_speed = 0, max_pair_ratio = 0, max_body_ratio = 0;
    Box3d box = Box3d::none();  // around the centres, m
  };
  Totals totals_;
  ColliderLoadSums collider_loads_;
};

}  // namespace hooke
