// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/base/expected.h"
#include "hooke/core/distance_field.h"
#include "hooke/core/triangle_mesh.h"

namespace hooke {

/// Options for making a distance field.
struct FieldOptions {
  double cell = 0.1;    ///< m, > 0
  double reach = 1;     ///< distances are needed this far from the surface, m
  bool closed = false;  ///< the mesh encloses a space: distances inside are negative, to three times the reach
};

/// Approximate number of samples in the field.
double expected_samples(const TriangleMesh& mesh, const FieldOptions& options);

/// The distance from `mesh`, sampled around it, with the same bits every time. An error that names no file where there
/// is too little memory.
Expected<DistanceField> make_distance_field(const TriangleMesh& mesh, const FieldOptions& options);

}  // namespace hooke
