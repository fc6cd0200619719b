// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The surface of each material as a mesh of four-sided faces, with its colour where a scene gives it; one file per
// snapshot.
#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/material_words.h"
#include "hooke/io/mesh_file.h"
#include "hooke/volumes/surface_mesh.h"

namespace hooke::io {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestWord = 500;  // bytes: common readers take lines of 1024

struct MaterialMeshes : volumes::SurfaceMesh {
  std::vector<std::array<std::uint8_t, 3>> color;  // of each vertex; empty without a scene
  std::vector<MeshPart> parts;                     // one a material
};

// The particles of each material, in the order of `all`.
std::vector<ParticleSet> by_material(const ParticleSet& all, std::size_t materials) {
  std::vector<std::size_t> counts(materials);
  for (const std::uint16_t m : all.material) ++counts[m];
  std::vector<ParticleSet> sets(materials);
  for (std::size_t m = 0; m < materials; ++m) sets[m].reserve(counts[m]);
  for (std::size_t i = 0; i < all.size(); ++i) {
    ParticleSet& own = sets[all.material[i]];
    own.id.push_back(all.id[i]);
    own.material.push_back(all.material[i]);
    own.position.push_back(all.position[i]);
    own.velocity.push_back(all.velocity[i]);
  }
  return sets;
}

void append(volumes::SurfaceMesh& whole, const volumes::SurfaceMesh& part) {
  const auto first = static_cast<std::uint32_t>(whole.position.size());
  whole.position.insert(whole.position.end(), part.position.begin(), part.position.end());
  whole.normal.insert(whole.normal.end(), part.normal.begin(), part.normal.end());
  whole.velocity.insert(whole.velocity.end(), part.velocity.begin(), part.velocity.end());
  for (std::array<std::uint32_t, 4> face : part.face) {
    for (std::uint32_t& corner : face) corner += first;
    whole.face.push_back(face);
  }
}

MaterialMeshes make_meshes(const ExportJob& job, const ParticleSet& particles, const fs::path& file) {
  const std::vector<MaterialInfo>& materials = job.run.info().materials;
  const std::vector<std::string> words = material_words(materials, kLongestWord, file);
  const std::vector<ParticleSet> sets = by_material(particles, materials.size());
  MaterialMeshes meshes;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    if (sets[m].empty()) continue;
    const volumes::SurfaceMesh mesh =
        take(volumes::make_surface_mesh(sets[m], radii(materials), job.options.surface), file);
    meshes.parts.push_back({words[m], meshes.face.size()});
    append(meshes, mesh);
    if (job.options.scene == nullptr) continue;
    meshes.color.resize(meshes.position.size(), rgb_bytes(job.options.scene->materials[m].color));
  }
  return meshes;
}

template <class Write>
std::vector<fs::path> export_meshes(const ExportJob& job, const Write& write) {
  return export_each(job, [&](std::size_t index, const fs::path& file) {
    const Snapshot snapshot = take(job.run.read(index));
    OutputFile out(file);
    write(out, snapshot, make_meshes(job, snapshot.particles, file));
    out.finish();
  });
}

}  // namespace

std::vector<fs::path> export_surface_obj(const ExportJob& job) {
  return export_meshes(job, [](OutputFile& out, const Snapshot& s, const MaterialMeshes& m) { write_obj(out, s, m); });
}
std::vector<fs::path> export_surface_ply(const ExportJob& job) {
  return export_meshes(job, [](OutputFile& out, const Snapshot& s, const MaterialMeshes& m) { write_ply(out, s, m); });
}

}  // namespace hooke::io
