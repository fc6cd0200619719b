// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hooke::volumes {

/// How the surface of a fluid is drawn around its particles: a smooth skin around spheres. The surface of a lone
/// particle is exactly its sphere.
struct SurfaceOptions {
  /// Radius of a particle's sphere, in radii of the particle, 0.1 to 10. A larger value makes the fluid fatter.
  double radius = 1;
  /// How far beyond its sphere a particle's influence reaches and blends with that of others, in radii of the particle,
  /// from `resolution` to 10. More closes wider gaps and flattens bumps; little leaves single spheres.
  double smoothing = 1.5;
  /// Edge of a voxel, in radii of the smallest particle, from 0.1 to `radius`. Half the edge takes eight times as long.
  double resolution = 0.5;
};

}  // namespace hooke::volumes
