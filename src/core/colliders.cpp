// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/colliders.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "hooke/base/assert.h"
#include "hooke/base/format.h"
#include "hooke/base/printable.h"
#include "hooke/base/sine.h"
#include "hooke/core/scene.h"

namespace hooke {
namespace {

constexpr double kTwoPi = 6.283185307179586477;

// The axes turned by a rotation vector, and the angular velocity while the vector changes.
struct Turning {
  std::array<Vec3d, 3> axes;
  Vec3d angular_velocity;
};

// sin(a)/a, (1 - cos a)/a^2 and (a - sin a)/a^3 for the angle a: the coefficients of a rotation vector's formulas.
struct RotationTerms {
  double first, second, third;
};

RotationTerms rotation_terms(double angle2) {
  if (angle2 < 1e-4) {  // their series; what is missing is below 1e-16
    return {1 - angle2 / 6 * (1 - angle2 / 20 * (1 - angle2 / 42)), 0.5 - angle2 / 24 * (1 - angle2 / 30),
            1.0 / 6 - angle2 / 120 * (1 - angle2 / 42)};
  }
  const double angle = std::sqrt(angle2);
  const SineCosine at = sine_cosine_of_turns(angle / kTwoPi);
  return {at.sine / angle, (1 - at.cosine) / angle2, (angle - at.sine) / (angle2 * angle)};
}

Turning turning(const Vec3d& rotation, const Vec3d& rate) {
  const RotationTerms terms = rotation_terms(dot(rotation, rotation));
  const auto turned = [&](const Vec3d& v) {
    const Vec3d once = cross(rotation, v);
    return v + terms.first * once + terms.second * cross(rotation, once);
  };
  const Vec3d once = cross(rotation, rate);
  return {{turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})},
          rate + terms.second * once + terms.third * cross(rotation, once)};
}

ColliderPose posed(const Vec3d& pivot, const Vec3d& position, const Vec3d& rotation, const Vec3d& velocity,
                   const Vec3d& rotation_rate) {
  const Turning turn = turning(rotation, rotation_rate);
  return {pivot + position, turn.axes, velocity, turn.angular_velocity};
}

// At least one, times ascending.
bool is_ascending_in_time(const std::vector<Keyframe>& keyframes) {
  const auto not_later = [](const Keyframe& a, const Keyframe& b) { return !(b.time > a.time); };
  return !keyframes.empty() && std::adjacent_find(keyframes.begin(), keyframes.end(), not_later) == keyframes.end();
}

struct PoseAt {
  const Vec3d& pivot;
  double time;

  ColliderPose operator()(const NoMotion&) const { return posed(pivot, {}, {}, {}, {}); }
  ColliderPose operator()(const SteadyMotion& m) const {
    return posed(pivot, time * m.velocity, time * m.angular_velocity, m.velocity, m.angular_velocity);
  }
  ColliderPose operator()(const KeyframeMotion& m) const {
    HOOKE_ASSERT(is_ascending_in_time(m.keyframes), m.keyframes.size());
    const auto later =
        std::find_if(m.keyframes.begin(), m.keyframes.end(), [this](const Keyframe& k) { return k.time > time; });
    if (later == m.keyframes.begin()) return resting(m.keyframes.front());
    if (later == m.keyframes.end()) return resting(m.keyframes.back());
    const Keyframe &a = *(later - 1), &b = *later;
    const double share = (time - a.time) / (b.time - a.time), per_second = 1 / (b.time - a.time);
    const Vec3d moved = b.position - a.position, turned = b.rotation - a.rotation;
    return posed(pivot, a.position + share * moved, a.rotation + share * turned, per_second * moved,
                 per_second * turned);
  }
  ColliderPose operator()(const Oscillation& m) const {
    HOOKE_ASSERT(m.frequency >= 0, m.frequency);
    const SineCosine at = sine_cosine_of_turns(m.frequency * time + m.phase);
    return posed(pivot, at.sine * m.amplitude, {}, (kTwoPi * m.frequency * at.cosine) * m.amplitude, {});
  }
  ColliderPose operator()(const HeldMotion& m) const {
    ColliderPose pose = posed(pivot, m.position, m.rotation, m.velocity, {});
    pose.angular_velocity = m.angular_velocity;
    return pose;
  }

 private:
  ColliderPose resting(const Keyframe& k) const { return posed(pivot, k.position, k.rotation, {}, {}); }
};

bool is_finite(const Vec3d& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

class MotionCheck {
 public:
  MotionCheck(std::string where, std::vector<Finding>& findings) : where_(std::move(where)), findings_(findings) {}

  void operator()(const NoMotion&) {}
  void operator()(const SteadyMotion& m) {
    finite("velocity", m.velocity);
    finite("angular_velocity", m.angular_velocity);
    if (m.pivot) finite("pivot", *m.pivot);
  }
  void operator()(const KeyframeMotion& m) {
    if (m.keyframes.empty()) add("keyframes", "is empty; at least one keyframe is needed");
    for (std::size_t i = 0; i < m.keyframes.size(); ++i) {
      const std::string at = formatted("keyframes[{}]", i);
      const Keyframe& k = m.keyframes[i];
      finite(at + ".position", k.position);
      finite(at + ".rotation", k.rotation);
      if (!std::isfinite(k.time)) add(at + ".time", "is not a finite number");
      if (i > 0 && !(k.time > m.keyframes[i - 1].time)) {
        add(at + ".time",
            formatted("{} must be later than that of the keyframe before, {}", k.time, m.keyframes[i - 1].time));
      }
    }
    if (m.pivot) finite("pivot", *m.pivot);
  }
  void operator()(const Oscillation& m) {
    finite("oscillate.amplitude", m.amplitude);
    if (!std::isfinite(m.frequency) || m.frequency < 0) {
      add("oscillate.frequency", formatted("{} must be 0 or more", m.frequency));
    }
    if (!std::isfinite(m.phase)) add("oscillate.phase", "is not a finite number");
  }
  void operator()(const HeldMotion& m) {
    finite("position", m.position);
    finite("rotation", m.rotation);
    finite("velocity", m.velocity);
    finite("angular_velocity", m.angular_velocity);
    if (m.pivot) finite("pivot", *m.pivot);
  }

 private:
  void finite(const std::string& key, const Vec3d& a) {
    if (!is_finite(a)) add(key, "is not finite");
  }
  void add(const std::string& key, std::string message) {
    findings_.push_back({where_ + "." + key, std::move(message)});
  }

  std::string where_;
  std::vector<Finding>& findings_;
};

}  // namespace

Vec3d pivot_of(const Collider& collider) {
  const auto own = std::visit(
      [](const auto& motion) -> std::optional<Vec3d> {
        if constexpr (requires { motion.pivot; }) return motion.pivot;
        return {};
      },
      collider.motion);
  return own ? *own : middle_of(collider.shape);
}

ColliderPose pose_at(const Collider& collider, double time) {
  HOOKE_ASSERT(std::isfinite(time), collider.name, time);
  const Vec3d pivot = pivot_of(collider);
  return std::visit(PoseAt{pivot, time}, collider.motion);
}

std::array<Vec3d, 3> turned_axes(const Vec3d& rotation) { return turning(rotation, {0, 0, 0}).axes; }

Vec3d moved_point(const Collider& collider, const ColliderPose& pose, const Vec3d& x) {
  const Vec3d off = x - pivot_of(collider);
  return pose.pivot + off.x * pose.turn[0] + off.y * pose.turn[1] + off.z * pose.turn[2];
}

std::vector<Finding> validate(const Motion& motion, const std::string& where) {
  std::vector<Finding> findings;
  std::visit(MotionCheck(where, findings), motion);
  return findings;
}

std::vector<Finding> check_colliders(const Scene& scene) {
  std::vector<Finding> findings;
  std::set<std::string> names;
  for (std::size_t i = 0; i < scene.colliders.size(); ++i) {
    const Collider& c = scene.colliders[i];
    const std::string where = formatted("colliders[{}]", i);
    if (!names.insert(c.name).second) {
      findings.push_back(
          {where + ".name", formatted("\"{}\" is the name of another collider, too", printable(c.name))});
    }
    for (Finding& finding : validate(c.shape, where + ".shape")) findings.push_back(std::move(finding));
    if (c.material && *c.material >= scene.materials.size()) {
      findings.push_back({where + ".material", "is no material of the scene"});
    }
    for (Finding& finding : validate(c.motion, where + ".motion")) findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace hooke
