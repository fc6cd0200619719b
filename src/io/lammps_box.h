// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/scene.h"
#include "hooke/io/snapshot.h"

namespace hooke {

/// A box that LAMMPS loses no particle of: along periodic axes the domain; along others the domain, and whoever has
/// its centre on its faces or beyond them, wholly. Without a scene, what holds all particles, periodic nowhere.
Domain lammps_box(const Snapshot& snapshot, const std::vector<MaterialInfo>& materials, const Scene* scene);

}  // namespace hooke
