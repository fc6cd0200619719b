// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/base/vec3.h"
#include "hooke/core/shapes.h"

namespace hooke {

// How a collider moves. Shapes are written as they are with no motion; a motion shifts them and turns them about a
// pivot, by default the middle of the shape. Rotations are vectors: along the axis, as long as the angle, rad.

struct NoMotion {};

/// Steady motion: the pivot moves with the velocity.
struct SteadyMotion {
  Vec3d velocity{0, 0, 0};          ///< m/s
  Vec3d angular_velocity{0, 0, 0};  ///< rad/s
  std::optional<Vec3d> pivot;       ///< at time 0, m
};

struct Keyframe {
  double time = 0;             ///< s
  Vec3d position{0, 0, 0};     ///< how far the shape is moved, m
  Vec3d rotation{0, 0, 0};     ///< rad; may be more than a whole turn
};
/// From each keyframe to the next, position and rotation change evenly; before the first and after the last the
/// collider rests.
struct KeyframeMotion {
  std::vector<Keyframe> keyframes;  ///< at least one, times ascending
  std::optional<Vec3d> pivot;       ///< m
};

/// To and fro: moved by amplitude * sin(2 pi (frequency t + phase)).
struct Oscillation {
  Vec3d amplitude{0, 0, 0};  ///< m
  double frequency = 1;      ///< Hz, >= 0
  double phase = 0;          ///< turns
};

/// Held by hand: it stays there until its motion is set again. Touching particles feel the velocities.
struct HeldMotion {
  Vec3d position{0, 0, 0};          ///< how far the shape is moved, m
  Vec3d rotation{0, 0, 0};          ///< rad
  Vec3d velocity{0, 0, 0};          ///< of the pivot, m/s
  Vec3d angular_velocity{0, 0, 0};  ///< rad/s
  std::optional<Vec3d> pivot;       ///< m
};

using Motion = std::variant<NoMotion, SteadyMotion, KeyframeMotion, Oscillation, HeldMotion>;

/// A fixed or moving boundary: a partner of infinite mass in contacts with particles. Across periodic faces it has
/// images (placed_colliders.h).
struct Collider {
  std::string name;                      ///< unique
  Shape shape;
  bool hollow = false;                   ///< a shell that is touched from both sides, else a solid
  std::optional<std::size_t> material;   ///< index into the scene's; without one, the law of walls applies
  Motion motion;
};

/// Where a collider is at one instant.
struct ColliderPose {
  Vec3d pivot{0, 0, 0};                                     ///< where it is, m
  std::array<Vec3d, 3> turn{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< where the shape's axes point
  Vec3d velocity{0, 0, 0};                                  ///< of the pivot, m/s
  Vec3d angular_velocity{0, 0, 0};                          ///< about the pivot, rad/s

  friend bool operator==(const ColliderPose&, const ColliderPose&) = default;
};

/// The load of particles on a collider at one instant.
struct ColliderLoad {
  Vec3d force{0, 0, 0};        ///< N
  Vec3d torque{0, 0, 0};       ///< about the pivot, N m
  std::uint64_t contacts = 0;

  friend bool operator==(const ColliderLoad&, const ColliderLoad&) = default;
};

/// The point of the shape, as written, that a collider turns about, m.
Vec3d pivot_of(const Collider& collider);

/// The pose at `time` (s): a function of time alone, the same bits on every machine.
ColliderPose pose_at(const Collider& collider, double time);

/// The turned axes of a rotation vector (rad): Rodrigues' formula.
std::array<Vec3d, 3> turned_axes(const Vec3d& rotation);

/// Where the point `x` of the shape, as written, is in a pose of the collider, m.
Vec3d moved_point(const Collider& collider, const ColliderPose& pose, const Vec3d& x);

/// What is wrong with a motion at the path `where`, if anything.
std::vector<Finding> validate(const Motion& motion, const std::string& where);

struct Scene;
/// What is wrong with the colliders of a scene. Paths are those of the scene file.
std::vector<Finding> check_colliders(const Scene& scene);

}  // namespace hooke
