// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/base/vec3.h"
#include "hooke/core/colliders.h"
#include "hooke/core/shapes.h"

namespace hooke {

/// From `least` to `most`, both included.
struct Range {
  double least = 0, most = 0;
};

/// Where particles are born, how fast, and for how long they live (docs/theory.md section 9).
struct Emitter {
  std::string name;          ///< unique
  std::size_t material = 0;  ///< index into the scene's
  Shape shape = DiscShape{}; ///< births are spread evenly over a disc or the faces of an open mesh, or the inside of
                   ///< all but a plane
  double rate = 0;           ///< births per second, >= 0, while it emits
  Range speed;               ///< m/s, >= 0
  Vec3d direction{0, 1, 0};  ///< not 0, of any length
  double spread = 0;         ///< half angle of the cone of velocities around it, degrees, 0 to 180
  std::optional<Range> life; ///< at birth, s, > 0; none: for ever
  Range decay{1, 1};         ///< how fast a life goes by, > 0
  double start = 0;          ///< it emits in steps that begin at this time or later, s
  double stop = std::numeric_limits<double>::infinity();  ///< and before this one, s
  std::optional<std::uint64_t>
      count;  ///< births in all, those that replace an ended life not counted; none: any number
  bool respawn = false;      ///< a particle whose life has ended is born again in the next step, under a new id
  std::uint64_t seed = 1;    ///< of all draws
  Motion motion;             ///< of the shape; newborns move along with it
};

/// Removes every particle whose centre is inside; for a plane, behind it. No disc, and no open mesh.
struct Sink {
  Shape shape;
};

struct Scene;
/// What is wrong with the emitters and sinks of a scene. Paths are those of the scene file.
std::vector<Finding> check_emitters(const Scene& scene);

/// Emitters at rest that have no place for a birth, even without other particles; nothing else may be wrong.
std::vector<Finding> check_places_of_birth(const Scene& scene);

/// About the largest number of particles of `emitter` that exist at a time in a run of `seconds` (s).
double expected_population(const Emitter& emitter, double seconds);

}  // namespace hooke
