// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hand.h"

#include <algorithm>
#include <cmath>

#include "hooke/physics/periodic.h"

namespace hooke::view {
namespace {

constexpr double kSteps = 10;    // in which it would catch up, were it not for the limit
constexpr double kFastest = 0.1;  // radii of the smallest particle a step
constexpr double kPull = 0.2;     // the frequency of the pull times the step

double smallest_radius(const Scene& scene) {
  double smallest = INFINITY;
  for (const Material& m : scene.materials) {
    if (m.is_of_particles()) smallest = std::min(smallest, m.radius);
  }
  return smallest;
}

// How far a hand goes in one step.
Vec3d advance(const Vec3d& from, const Vec3d& to, double radius) {
  const Vec3d way = (1 / kSteps) * (to - from);
  const double length = std::sqrt(dot(way, way)), most = kFastest * radius;
  if (length < 1e-6 * radius) return to - from;
  return length > most ? (most / length) * way : way;
}

}  // namespace

HeldMotion& Hand::motion_of(const std::string& name) {
  for (Led& led : led_) {
    if (led.name == name) return led.motion;
  }
  led_.push_back({name, {}});
  return led_.back().motion;
}

Expected<void> Hand::hold(Simulation& simulation, const HoldCollider& what) {
  const std::vector<Collider>& colliders = simulation.scene().colliders;
  const auto found =
      std::find_if(colliders.begin(), colliders.end(), [&](const Collider& c) { return c.name == what.name; });
  if (found == colliders.end()) {
    return fail(Error::Kind::bad_input, "colliders", "there is none of the name \"" + printable(what.name) + "\"");
  }
  if (auto free = let_go(simulation); !free) return free;
  const ColliderPose& pose = simulation.collider_poses()[static_cast<std::size_t>(found - colliders.begin())];
  collider_ = what.name;
  HeldMotion& motion = motion_of(what.name);
  const Vec3d pivot = pivot_of(*found);
  motion = {pose.pivot - pivot, what.rotation, {0, 0, 0}, {0, 0, 0}, pivot};
  start_ = motion.position;
  shift_ = target_ = {0, 0, 0};
  return simulation.set_collider_motion(collider_, motion);
}

Expected<void> Hand::hold(Simulation& simulation, const HoldParticles& what) {
  std::vector<Vec3d> taken_at;
  for (const std::uint64_t id : what.ids) {
    const auto found = simulation.find(id);
    if (!found) return fail(found.error());
    taken_at.push_back(found->position);
  }
  if (auto free = let_go(simulation); !free) return free;
  ids_ = what.ids;
  taken_at_ = std::move(taken_at);
  shift_ = target_ = {0, 0, 0};
  return {};
}

Expected<void> Hand::let_go(Simulation& simulation) {
  if (!ids_.empty()) {
    ids_.clear();
    taken_at_.clear();
    return simulation.set_external_forces({}, {});
  }
  if (!collider_.empty()) {
    HeldMotion& motion = motion_of(collider_);
    motion.velocity = {0, 0, 0};
    const std::string name = std::exchange(collider_, {});
    return simulation.set_collider_motion(name, motion);
  }
  return {};
}

Expected<void> Hand::before_step(Simulation& simulation) {
  if (ids_.empty() && collider_.empty()) return {};
  const Scene& scene = simulation.scene();
  const Vec3d way = advance(shift_, target_, smallest_radius(scene));
  shift_ += way;
  if (!ids_.empty()) return pull(simulation);
  HeldMotion& motion = motion_of(collider_);
  const Vec3d velocity = (1 / scene.time_step) * way;
  if (velocity == motion.velocity && velocity == Vec3d{0, 0, 0}) return {};
  motion.position = start_ + shift_;
  motion.velocity = velocity;
  return simulation.set_collider_motion(collider_, motion);
}

// A critically damped spring from each particle to where the hand would have it.
Expected<void> Hand::pull(Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const double omega = kPull / scene.time_step;
  std::vector<std::uint64_t> ids;
  std::vector<Vec3d> forces;
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    const auto at = simulation.find(ids_[k]);
    if (!at) continue;  // it has left or died
    const double mass = scene.materials[at->material].mass;
    const Vec3d off = nearest_displacement(taken_at_[k] + shift_, at->position, scene.domain.period());
    ids.push_back(ids_[k]);
    forces.push_back(mass * (omega * omega * off - 2 * omega * at->velocity));
  }
  return simulation.set_external_forces(ids, forces);
}

Expected<void> Hand::reapply(Simulation& simulation) const {
  for (const Led& led : led_) {
    if (auto set = simulation.set_collider_motion(led.name, led.motion); !set) return set;
  }
  return {};
}

}  // namespace hooke::view
