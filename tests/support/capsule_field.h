// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/shapes.h"

namespace hooke::test {

/// A capsule of `radius` (m) around `middle`, with an upright axis of two radii, as a mesh with the field of its
/// distances. The field's samples come from the capsule's equation, so the tests of the engine need no reader of
/// meshes. Not `closed`: a shell without its upper cap. `reach` (m): greatest distance of samples from the surface.
MeshShape capsule_with_field(const Vec3d& middle, double radius, bool closed, double reach);

}  // namespace hooke::test
