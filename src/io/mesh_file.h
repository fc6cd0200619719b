// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hooke/io/output_file.h"
#include "hooke/io/snapshot.h"
#include "hooke/io/write_rows.h"

namespace hooke::io {

template <class T>
void append_bytes(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Faces that belong together, e.g. of one material.
struct MeshPart {
  std::string name;  ///< one word
  std::size_t first_face = 0;
};

/// Wavefront OBJ: positions and normals, as text. A mesh has columns of position, normal and velocity, and faces; a
/// face is an array of corner indices. It may have a column of colours, 3 bytes each, which follow the positions as
/// numbers from 0 to 1, and parts, ascending by face, which become objects.
template <class Mesh>
void write_obj(OutputFile& out, const Snapshot& snapshot, const Mesh& mesh) {
  out.write(fmt::format("# step {}, {} s\n", snapshot.step, snapshot.time));
  const auto write_vectors = [&](const char* keyword, const std::vector<Vec3f>& vectors, const auto& colors) {
    write_rows(out, vectors.size(), [&](std::string& text, std::size_t i) {
      text += keyword;
      append_vector<float>(text, vec_cast<double>(vectors[i]));
      if (!colors.empty()) {
        for (const std::uint8_t channel : colors[i]) text += fmt::format(" {:.4g}", channel / 255.0);
      }
      text += '\n';
    });
  };
  const std::vector<std::array<std::uint8_t, 3>> none;
  constexpr bool kColored = requires { mesh.color; };
  if constexpr (kColored) {
    write_vectors("v ", mesh.position, mesh.color);
  } else {
    write_vectors("v ", mesh.position, none);
  }
  write_vectors("vn ", mesh.normal, none);
  std::vector<MeshPart> parts;
  if constexpr (kColored) parts = mesh.parts;
  if (parts.empty()) parts.push_back({"surface", 0});
  std::size_t part = 0;
  write_rows(out, mesh.face.size(), [&](std::string& text, std::size_t i) {
    for (; part < parts.size() && parts[part].first_face == i; ++part) {
      text += "o " + parts[part].name + "\ns 1\n";
    }
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

/// Binary PLY: x y z, normals nx ny nz, velocities vx vy vz, red green blue where the mesh has colours, and faces.
template <class Mesh>
void write_ply(OutputFile& out, const Snapshot& snapshot, const Mesh& mesh) {
  std::string head =
      fmt::format("ply\nformat binary_little_endian 1.0\ncomment step {}\ncomment time {}\nelement vertex {}\n",
                  snapshot.step, snapshot.time, mesh.position.size());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "vx", "vy", "vz"}) {
    head += fmt::format("property float {}\n", name);
  }
  constexpr bool kColored = requires { mesh.color; };
  bool colored = false;
  if constexpr (kColored) colored = !mesh.color.empty();
  if (colored) head += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  head += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.face.size());
  out.write(head);
  write_rows(out, mesh.position.size(), [&](std::string& bytes, std::size_t i) {
    for (const auto* column : {&mesh.position, &mesh.normal, &mesh.velocity}) append_bytes(bytes, (*column)[i]);
    if constexpr (kColored) {
      if (colored) append_bytes(bytes, mesh.color[i]);
    }
  });
  write_rows(out, mesh.face.size(), [&](std::string& bytes, std::size_t i) {
    append_bytes(bytes, static_cast<std::uint8_t>(mesh.face[i].size()));
    append_bytes(bytes, mesh.face[i]);
  });
}

}  // namespace hooke::io
