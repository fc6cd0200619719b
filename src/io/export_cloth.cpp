// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The cloths of a scene as one mesh of triangles, one file per snapshot.
#include <algorithm>
#include <array>
#include <cmath>

#include "hooke/core/torn_edges.h"
#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/mesh_file.h"

namespace hooke::io {

namespace {

namespace fs = std::filesystem;

struct ClothMesh {
  std::vector<Vec3f> position;  // m
  std::vector<Vec3f> normal;    // unit vector
  std::vector<Vec3f> velocity;  // m/s
  std::vector<std::array<std::uint32_t, 3>> face;
};

Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Leaves out triangles that lack a particle or have a torn edge.
void add_surface(const Surface& surface, const TornEdges& torn, const ParticleSet& p, ClothMesh& mesh) {
  constexpr std::uint32_t kGone = ~std::uint32_t{0};
  std::vector<std::uint32_t> number(surface.particles.size(), kGone);  // in the mesh
  std::vector<std::size_t> index(surface.particles.size());  // in the set
  std::vector<Vec3d> normal;
  const auto first = mesh.position.size();
  for (std::size_t k = 0; k < number.size(); ++k) {
    const std::size_t i = index[k] = p.find(surface.particles[k]);
    if (i == p.size()) continue;
    number[k] = static_cast<std::uint32_t>(mesh.position.size());
    mesh.position.push_back(vec_cast<float>(p.position[i]));
    mesh.velocity.push_back(vec_cast<float>(p.velocity[i]));
    normal.push_back({0, 0, 0});
  }
  for (std::size_t t = 0; t + 2 < surface.triangles.size(); t += 3) {
    std::array<std::uint32_t, 3> face;
    for (std::size_t k = 0; k < 3; ++k) face[k] = number[surface.triangles[t + k]];
    if (std::find(face.begin(), face.end(), kGone) != face.end()) continue;
    const std::uint32_t* at = surface.triangles.data() + t;
    if (torn.any_of({index[at[0]], index[at[1]], index[at[2]]}, p)) continue;
    mesh.face.push_back(face);
    const Vec3d a = vec_cast<double>(mesh.position[face[0]]);
    const Vec3d n = cross(vec_cast<double>(mesh.position[face[1]]) - a, vec_cast<double>(mesh.position[face[2]]) - a);
    for (const std::uint32_t corner : face) normal[corner - first] += n;
  }
  for (const Vec3d& n : normal) {
    const double length = std::sqrt(dot(n, n));
    mesh.normal.push_back(vec_cast<float>(length > 0 ? (1 / length) * n : Vec3d{0, 0, 0}));
  }
}

std::vector<fs::path> export_cloths(const ExportJob& job,
                                    void (*write)(OutputFile&, const Snapshot&, const ClothMesh&)) {
  const Scene* scene = job.options.scene;
  if (scene == nullptr || !scene->structure || scene->structure->surfaces.empty()) {
    throw Failure(Error::Kind::bad_input, job.run.file(), "is of no run with cloths");
  }
  const TornEdges torn(*scene);
  return export_each(job, [&](std::size_t index, const fs::path& file) {
    const Snapshot snapshot = take(job.run.read(index));
    ClothMesh mesh;
    for (const Surface& surface : scene->structure->surfaces) add_surface(surface, torn, snapshot.particles, mesh);
    OutputFile out(file);
    write(out, snapshot, mesh);
    out.finish();
  });
}

}  // namespace

std::vector<fs::path> export_cloth_obj(const ExportJob& job) { return export_cloths(job, write_obj<ClothMesh>); }
std::vector<fs::path> export_cloth_ply(const ExportJob& job) { return export_cloths(job, write_ply<ClothMesh>); }

}  // namespace hooke::io
