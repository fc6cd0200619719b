// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "action.h"
#include "hooke/base/expected.h"
#include "hooke/core/simulation.h"

namespace hooke::view {

/// The hand that leads a collider or particles. It follows where it is led no faster than a tenth of a radius a step,
/// so that what it touches is pushed and not run over, and moves before every step: how fast pictures are drawn does
/// not matter.
class Hand {
 public:
  Expected<void> hold(Simulation& simulation, const HoldCollider& what);
  Expected<void> hold(Simulation& simulation, const HoldParticles& what);
  /// Where nothing is held, does nothing.
  void lead(const Lead& where) { target_ = where.shift; }
  Expected<void> let_go(Simulation& simulation);

  /// To be called before each step.
  Expected<void> before_step(Simulation& simulation);
  /// After a state was restored or a simulation rebuilt: the colliders that were led stay where they are.
  Expected<void> reapply(Simulation& simulation) const;

  /// A collider that has been led, with the motion that it has now.
  struct Led {
    std::string name;
    HeldMotion motion;
  };
  const std::vector<Led>& led() const { return led_; }
  /// The name of the collider that is held; empty where there is none.
  const std::string& held_collider() const { return collider_; }
  const std::vector<std::uint64_t>& held_particles() const { return ids_; }

 private:
  Expected<void> pull(Simulation& simulation);
  HeldMotion& motion_of(const std::string& name);

  std::string collider_;
  std::vector<std::uint64_t> ids_;
  std::vector<Vec3d> taken_at_;  // of each particle, m
  Vec3d start_{0, 0, 0};         // of the collider's position, m
  Vec3d shift_{0, 0, 0};         // so far, m
  Vec3d target_{0, 0, 0};        // of the shift, m
  std::vector<Led> led_;
};

}  // namespace hooke::view
