// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hooke {

/// How the surface of a fluid is drawn around its particles: a smooth skin around spheres. A lone particle's is exactly
/// its sphere.
struct SurfaceOptions {
  /// Of the sphere that a particle stands for, in its own radii, 0.1 to 10. More makes the fluid fatter.
  double radius = 1;
  /// How far beyond its sphere a particle's influence reaches, where it blends with that of others, in its own radii,
  /// from `resolution` to 10. More closes wider gaps and flattens bumps; little leaves the single spheres.
  double smoothing = 1.5;
  /// Edge of a voxel, in radii of the smallest particle, from 0.1 to `radius`. Half of it takes eight times as long.
  double resolution = 0.5;
};

}  // namespace hooke
