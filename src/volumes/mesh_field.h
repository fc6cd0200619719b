// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/base/expected.h"
#include "hooke/core/distance_field.h"
#include "hooke/core/triangle_mesh.h"

namespace hooke::volumes {

/// Options for making a distance field.
struct FieldOptions {
  double cell = 0.1;    ///< m, > 0
  double reach = 1;     ///< distances are needed this far from the surface, m
  bool closed = false;  ///< the mesh encloses a space: distances inside are negative
  double depth = 3;     ///< of a closed mesh: distances are needed to so many times the reach inside
};

/// Whether the field's cells can be numbered: a box around the mesh has at most 2^24 along each axis.
bool spans_few_cells(const TriangleMesh& mesh, const FieldOptions& options);

/// Approximate number of samples in the field of a mesh that spans few cells. Counting ends soon after `most`.
double expected_samples(const TriangleMesh& mesh, const FieldOptions& options, double most);

/// Bytes in use, at the most, for each sample of a field that is being made.
inline constexpr double kBytesPerSampleMade = 12;

/// The distance from `mesh`, sampled around it, with the same bits every time. An error that names no file where the
/// mesh spans too many cells or there is too little memory.
Expected<DistanceField> make_distance_field(const TriangleMesh& mesh, const FieldOptions& options);

}  // namespace hooke::volumes
