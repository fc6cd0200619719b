// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/scene.h"
#include "hooke/io/snapshot.h"

namespace hooke::io {

/// A box from which LAMMPS loses no particle: the domain, extended along axes that are not periodic to hold the whole
/// of particles with their centre on a face or beyond. Without a scene, a box around all particles, periodic nowhere.
Domain lammps_box(const Snapshot& snapshot, const std::vector<MaterialInfo>& materials, const Scene* scene);

}  // namespace hooke::io
