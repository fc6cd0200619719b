// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hooke/core/scene.h"
#include "hooke/render/camera.h"
#include "hooke/render/live_picture.h"
#include "hooke/render/shaded_mesh.h"
#include "view_frame.h"

namespace hooke::view {

/// A ray of sight.
struct Ray {
  Vec3d from;       ///< m
  Vec3d direction;  ///< unit vector
};

/// The ray through a place of the picture: x from 0 (left) to 1, y from 0 (top) to 1. `aspect`: width over height, > 0.
Ray ray_through(const render::Camera& camera, double x, double y, double aspect);

/// What a ray meets first.
struct Hit {
  double distance = 0;  ///< along the ray, m
  std::size_t index = 0;  ///< of the particle in the frame, or of the mesh
};

/// The first particle of a frame that the ray, which is relative to the frame's origin, meets: one pass over all of
/// them. `radii`: by material, m. Particles that `clip` cuts away are passed over.
std::optional<Hit> pick_particle(const ViewFrame& frame, std::span<const float> radii, const Ray& ray,
                                 const std::optional<render::ClipPlane>& clip);
/// The first triangle of the meshes that the ray meets; its index is that of the mesh.
std::optional<Hit> pick_mesh(std::span<const render::ShadedMesh> meshes, const Ray& ray);

/// Ids of the particles of a frame within `radius` (m) of `center` (relative to its origin), no more than `most`, the
/// nearest first found in order of id.
std::vector<std::uint64_t> particles_near(const ViewFrame& frame, const Vec3d& center, double radius, std::size_t most);

/// Indices of the springs whose middle is within `radius` (m) of the ray, not further along it than `depth` (m) and a
/// radius. The ray is relative to `origin`.
std::vector<std::uint64_t> springs_near(const Structure& structure, const ParticleSet& particles, const Vec3d& origin,
                                        const Ray& ray, double radius, double depth);

}  // namespace hooke::view
