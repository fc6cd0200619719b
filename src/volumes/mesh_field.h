// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/base/expected.h"
#include "hooke/core/distance_field.h"
#include "hooke/core/triangle_mesh.h"

namespace hooke {

/// How a distance field is made.
struct FieldOptions {
  double cell = 0.1;    ///< m, > 0
  double reach = 1;     ///< how far from the surface distances are needed, m
  bool closed = false;  ///< the mesh encloses a space: distances inside are negative, to three times the reach
};

/// How many samples the field will hold, about.
double expected_samples(const TriangleMesh& mesh, const FieldOptions& options);

/// The distance from `mesh`, sampled around it: the same bits every time. An error, which names no place, where there
/// is too little memory.
Expected<DistanceField> make_distance_field(const TriangleMesh& mesh, const FieldOptions& options);

}  // namespace hooke
