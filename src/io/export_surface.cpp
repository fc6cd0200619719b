// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The fluid's surface as a mesh of four-sided faces, one file a snapshot. Wavefront OBJ: positions and normals, as
// text. Binary PLY: x y z, normals nx ny nz, velocities vx vy vz, and faces.
#include <fmt/format.h>

#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/surface_mesh.h"
#include "hooke/io/write_rows.h"

namespace hooke {

namespace {

namespace fs = std::filesystem;

template <class Write>
std::vector<fs::path> export_meshes(const ExportJob& job, const Write& write) {
  return export_each(job, [&](std::size_t index, const fs::path& file) {
    const Snapshot snapshot = take(job.run.read(index));
    OutputFile out(file);
    write(out, snapshot, surface_mesh(snapshot, job.run.info().materials, job.options.surface, file));
    out.finish();
  });
}

void write_obj(OutputFile& out, const Snapshot& snapshot, const SurfaceMesh& mesh) {
  out.write(fmt::format("# step {}, {} s\no surface\n", snapshot.step, snapshot.time));
  const auto write_vectors = [&](const char* keyword, const std::vector<Vec3f>& vectors) {
    write_rows(out, vectors.size(), [&](std::string& text, std::size_t i) {
      text += keyword;
      append_vector<float>(text, vec_cast<double>(vectors[i]));
      text += '\n';
    });
  };
  write_vectors("v ", mesh.position);
  write_vectors("vn ", mesh.normal);
  out.write("s 1\n");
  write_rows(out, mesh.face.size(), [&](std::string& text, std::size_t i) {
    text += 'f';
    for (const std::uint32_t corner : mesh.face[i]) {
      const std::uint64_t number = std::uint64_t{corner} + 1;
      text += ' ';
      append_number(text, number);
      text += "//";
      append_number(text, number);
    }
    text += '\n';
  });
}

template <class T>
void append_bytes(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void write_ply(OutputFile& out, const Snapshot& snapshot, const SurfaceMesh& mesh) {
  std::string head =
      fmt::format("ply\nformat binary_little_endian 1.0\ncomment step {}\ncomment time {}\nelement vertex {}\n",
                  snapshot.step, snapshot.time, mesh.position.size());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "vx", "vy", "vz"}) {
    head += fmt::format("property float {}\n", name);
  }
  head += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.face.size());
  out.write(head);
  write_rows(out, mesh.position.size(), [&](std::string& bytes, std::size_t i) {
    for (const auto* column : {&mesh.position, &mesh.normal, &mesh.velocity}) append_bytes(bytes, (*column)[i]);
  });
  write_rows(out, mesh.face.size(), [&](std::string& bytes, std::size_t i) {
    append_bytes(bytes, std::uint8_t{4});
    append_bytes(bytes, mesh.face[i]);
  });
}

}  // namespace

std::vector<fs::path> export_surface_obj(const ExportJob& job) { return export_meshes(job, write_obj); }
std::vector<fs::path> export_surface_ply(const ExportJob& job) { return export_meshes(job, write_ply); }

}  // namespace hooke
