// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/scene.h"

namespace hooke::test {

/// Gives `scene` a collider of every shape, meshes included, hollow and solid, at rest and moving in every way, in a
/// box of `size` (m) around `middle`; some colliders have a material of their own.
void add_every_collider(Scene& scene, const Vec3d& middle, double size);

}  // namespace hooke::test
