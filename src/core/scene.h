// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/base/vec3.h"
#include "hooke/core/attraction.h"
#include "hooke/core/colliders.h"
#include "hooke/core/contact_walk.h"
#include "hooke/core/emitters.h"
#include "hooke/core/fields.h"
#include "hooke/core/materials.h"
#include "hooke/core/scene_picture.h"
#include "hooke/core/springs.h"

namespace hooke {

/// How positions and velocities advance (docs/theory.md section 3).
enum class Integrator {
  symplectic_euler,  ///< a(x_n, v_n); v += dt a; x += dt v
  velocity_verlet,   ///< v += dt/2 a; x += dt v; a = f(x_new, v_half); v += dt/2 a
};

/// The number type that a back end computes in. The reference back end is double whatever is asked.
enum class Precision { single_precision, double_precision };

/// "symplectic-euler" and "velocity-verlet", "single" and "double", as in scene files.
const char* to_string(Integrator integrator);
const char* to_string(Precision precision);

/// What the two faces across one axis do.
enum class Boundary {
  spring,    ///< walls that push back by the contact law
  open,      ///< particles whose centre leaves are removed and counted
  periodic,  ///< what leaves on one side comes in on the other
};

/// The simulated box.
struct Domain {
  Vec3d min{0, 0, 0};  ///< m
  Vec3d max{1, 1, 1};  ///< m, above min on every axis
  std::array<Boundary, 3> boundary{Boundary::spring, Boundary::spring, Boundary::spring};

  double length(int axis) const { return component(max, axis) - component(min, axis); }
  /// Its spring walls.
  Walls walls() const {
    Walls found{{}, min, max};
    for (std::size_t axis = 0; axis < 3; ++axis) found.across[axis] = boundary[axis] == Boundary::spring;
    return found;
  }
  /// The lengths of periodic axes, m; 0 for the others.
  Vec3d period() const {
    Vec3d lengths{0, 0, 0};
    for (int axis = 0; axis < 3; ++axis) {
      if (boundary[static_cast<std::size_t>(axis)] == Boundary::periodic) component(lengths, axis) = length(axis);
    }
    return lengths;
  }
};

/// When a run writes: the first step at or after each multiple of `seconds`, or every `steps`.
struct OutputCadence {
  double seconds = 0;      ///< > 0, or 0 where `steps` rules
  std::int64_t steps = 0;  ///< >= 1, or 0 where `seconds` rules

  /// Whether the state after `step` (>= 0) steps of `dt` (s, > 0) is to be written. Step 0 always is.
  bool is_due(std::int64_t step, double dt) const;
};

/// Everything that rules a simulation but the particles themselves: plain data with default values.
/// A scene file fills it, or code does. SI units.
struct Scene {
  std::string name;
  double time_step = 0.005;  ///< dt, s, > 0
  std::int64_t steps = 0;    ///< how long a run lasts, in steps from the start, >= 0
  Integrator integrator = Integrator::symplectic_euler;
  Precision precision = Precision::single_precision;
  Vec3d gravity{0, -9.8, 0};  ///< m/s^2
  Domain domain;
  std::vector<Material> materials;        ///< at most kMostMaterials
  std::vector<ContactEntry> contacts;     ///< pairs that do not follow the mixing rule
  std::vector<Collider> colliders;
  std::vector<Emitter> emitters;          ///< where particles are born
  std::vector<Sink> sinks;                ///< where they are taken away
  std::shared_ptr<const Structure> structure;  ///< springs, and what holds particles; null where there is nothing
  std::vector<Field> fields;
  std::optional<Attraction> attraction;  ///< of all particles by each other
  OutputCadence output;
  SceneCamera camera;
  ScenePicture picture;
};

/// What makes `scene` unusable, if anything: values that are not finite, wrong signs, empty domains, duplicate names
/// or pairs. Empty where all is well. Paths are those of the scene file.
std::vector<Finding> validate(const Scene& scene);

}  // namespace hooke
