// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/volumes/surface_mesh.h"

#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <cmath>

#include "hooke/base/parallel.h"
#include "hooke/volumes/fluid_volume.h"
#include "hooke/volumes/no_throw.h"

namespace hooke::volumes {

namespace {

constexpr std::size_t kGrain = 4096;  // vertices per piece of work

Vec3f to_vec3f(const openvdb::Vec3s& v) { return {v.x(), v.y(), v.z()}; }

Vec3f cross(const Vec3f& a, const Vec3f& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// The area-weighted mean of the faces around each vertex.
std::vector<Vec3f> vertex_normals(const SurfaceMesh& mesh) {
  std::vector<Vec3f> normals(mesh.position.size(), Vec3f{0, 0, 0});
  for (const auto& f : mesh.face) {
    const auto& x = mesh.position;
    const Vec3f area = cross(x[f[2]] - x[f[0]], x[f[3]] - x[f[1]]);
    for (const std::uint32_t corner : f) normals[corner] += area;
  }
  for (Vec3f& n : normals) {
    const float length = std::sqrt(dot(n, n));
    n = length > 0 ? (1 / length) * n : Vec3f{0, 1, 0};
  }
  return normals;
}

SurfaceMesh mesh_of(const FluidVolume& fluid) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*fluid.surface_field(), points, quads);

  SurfaceMesh mesh;
  mesh.face.reserve(quads.size());
  for (const openvdb::Vec4I& q : quads) mesh.face.push_back({q[3], q[2], q[1], q[0]});  // OpenVDB's faces are clockwise
  mesh.position.resize(points.size());
  mesh.velocity.resize(points.size());
  const openvdb::Vec3SGrid::ConstPtr velocity = fluid.velocity();
  parallel_ranges(points.size(), kGrain, [&](std::size_t first, std::size_t last) {
    const auto accessor = velocity->getConstAccessor();
    const openvdb::tools::GridSampler<openvdb::Vec3SGrid::ConstAccessor, openvdb::tools::BoxSampler> sample(
        accessor, velocity->transform());
    for (std::size_t i = first; i < last; ++i) {
      mesh.position[i] = to_vec3f(points[i]);
      mesh.velocity[i] = to_vec3f(sample.wsSample(points[i]));
    }
  });
  mesh.normal = vertex_normals(mesh);
  return mesh;
}

}  // namespace

Expected<SurfaceMesh> make_surface_mesh(const ParticleSet& particles, std::span<const double> radius,
                                        const SurfaceOptions& options) {
  return no_throw([&]() -> Expected<SurfaceMesh> {
    const auto volume = FluidVolume::create(particles, radius, options);
    if (!volume) return fail(volume.error());
    return mesh_of(*volume);
  });
}

}  // namespace hooke::volumes
