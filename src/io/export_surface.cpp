// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The fluid's surface as a mesh of four-sided faces, one file per snapshot.
#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/mesh_file.h"
#include "hooke/volumes/surface_mesh.h"

namespace hooke {

namespace {

namespace fs = std::filesystem;

template <class Write>
std::vector<fs::path> export_meshes(const ExportJob& job, const Write& write) {
  return export_each(job, [&](std::size_t index, const fs::path& file) {
    const Snapshot snapshot = take(job.run.read(index));
    OutputFile out(file);
    write(out, snapshot,
          take(make_surface_mesh(snapshot.particles, radii(job.run.info().materials), job.options.surface), file));
    out.finish();
  });
}

}  // namespace

std::vector<fs::path> export_surface_obj(const ExportJob& job) {
  return export_meshes(job, [](OutputFile& out, const Snapshot& s, const SurfaceMesh& m) { write_obj(out, s, m); });
}
std::vector<fs::path> export_surface_ply(const ExportJob& job) {
  return export_meshes(job, [](OutputFile& out, const Snapshot& s, const SurfaceMesh& m) { write_ply(out, s, m); });
}

}  // namespace hooke
