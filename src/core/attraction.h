// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/base/vec3.h"

namespace hooke {

struct Scene;

/// Bounds of Attraction::accuracy.
inline constexpr double kFinestAccuracy = 1e-6;
inline constexpr double kCoarsestAccuracy = 1e-2;

/// Attraction of every particle by every other (docs/theory.md eq. 11): plain data of a scene.
struct Attraction {
  enum class Method {
    automatic,  ///< whichever of the two is cheaper for so many particles at this accuracy
    direct,     ///< every pair
    tree,       ///< distant particles together, by a tree of cells
  };
  double constant = 6.674e-11;  ///< G, m^3 kg^-1 s^-2, >= 0
  double softening = 0;         ///< Plummer's length eps, m, >= 0
  Method method = Method::automatic;
  double accuracy = 1e-3;  ///< of the tree, kFinestAccuracy to kCoarsestAccuracy: root mean square of the error of a
                           ///< particle's force, relative to it
  bool exact = true;       ///< the same bits on every machine, at some cost in speed
};

/// What makes the attraction of a scene unusable, if it has any; empty where all is well.
std::vector<Finding> validate_attraction(const Scene& scene);

/// Whether a back end that has both sums `particles` by the tree. Depends on the scene and this number alone.
bool attracts_by_tree(const Attraction& attraction, std::size_t particles);

/// Units in which distances and masses of a scene are inside the range of single precision: powers of two, so that they
/// round nothing. Distances from 2^-40 to 2^40 units of length are. That unit is about the geometric mean of the
/// smallest radius and the longest side of the domain.
struct AttractionUnits {
  double length = 1;  ///< m
  double mass = 1;  ///< kg
};
AttractionUnits attraction_units(const Scene& scene);

/// eps^2, m^2, and at least 2^-80 of the unit of length squared, so that two particles on one spot stay finite.
double softening_squared(const Scene& scene);

/// Sums of attraction are split into blocks of this many consecutive ids, from multiples of it: a block's sum starts
/// from 0 and is then added to the sum of the blocks before it.
inline constexpr std::size_t kAttractionBlock = 1024;

}  // namespace hooke
