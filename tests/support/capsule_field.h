// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/shapes.h"

namespace hooke::test {

/// A capsule of `radius` (m) around `middle`, its axis of two radii upright, as a mesh with the field of its distances.
/// The field's samples come from the capsule's equation, so the tests of the engine need nothing that reads meshes.
/// Open: without its upper cap, a shell. `reach` (m): how far from the surface there are samples.
MeshShape capsule_with_field(const Vec3d& middle, double radius, bool closed, double reach);

}  // namespace hooke::test
