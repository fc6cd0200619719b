// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "hooke/base/vec3.h"
#include "hooke/io/export.h"
#include "hooke/io/snapshot.h"

namespace hooke {

/// The surface of a fluid: a closed mesh of four-sided faces.
struct SurfaceMesh {
  std::vector<Vec3f> position;  ///< m
  std::vector<Vec3f> normal;    ///< unit vector, outward
  std::vector<Vec3f> velocity;  ///< m/s, of the fluid there
  std::vector<std::array<std::uint32_t, 4>> face;  ///< its corners, counterclockwise from outside
};

/// The surface around the particles of a snapshot, as the options draw it. Throws Failure, naming `file`.
SurfaceMesh surface_mesh(const Snapshot& snapshot, const std::vector<MaterialInfo>& materials,
                         const SurfaceOptions& options, const std::filesystem::path& file);

}  // namespace hooke
