// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

#include "hooke/io/output_file.h"
#include "hooke/io/snapshot.h"
#include "hooke/io/write_rows.h"

namespace hooke {

template <class T>
void append_bytes(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Wavefront OBJ: positions and normals, as text. A mesh has columns of position, normal and velocity, and faces; a
/// face is an array of corner indices.
template <class Mesh>
void write_obj(OutputFile& out, const Snapshot& snapshot, const Mesh& mesh) {
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

/// Binary PLY: x y z, normals nx ny nz, velocities vx vy vz, and faces.
template <class Mesh>
void write_ply(OutputFile& out, const Snapshot& snapshot, const Mesh& mesh) {
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
    append_bytes(bytes, static_cast<std::uint8_t>(mesh.face[i].size()));
    append_bytes(bytes, mesh.face[i]);
  });
}

}  // namespace hooke
