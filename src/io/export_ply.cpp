// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Binary PLY of one snapshot's particles as points: x y z vx vy vz radius id material, and red green blue where a scene
// gives the materials' colours. PLY has no 64-bit integers: `id` holds the lower 32 bits; if any id has more, `id_high`
// holds the upper 32. Comments name the materials, which count from 0.
#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/material_words.h"
#include "hooke/io/write_rows.h"

namespace hooke::io {

namespace {

constexpr std::size_t kLongestWord = 500;  // bytes: common readers take lines of 1024

template <class T>
void append_bytes(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Real>
void append_vector_bytes(std::string& bytes, const Vec3d& v) {
  for (const double c : {v.x, v.y, v.z}) append_bytes(bytes, static_cast<Real>(c));
}

template <class Real>
void write_file(const Snapshot& snapshot, const std::vector<MaterialInfo>& materials, const Scene* scene,
                const std::filesystem::path& file) {
  const ParticleSet& p = snapshot.particles;
  const bool long_ids = !p.empty() && p.id.back() >> 32U != 0;
  std::string head = "ply\nformat binary_little_endian 1.0\ncomment step ";
  append_number(head, snapshot.step);
  head += "\ncomment time ";
  append_number(head, snapshot.time);
  head += '\n';
  const std::vector<std::string> words = material_words(materials, kLongestWord, file);
  std::vector<std::string> columns;  // bytes of the columns that depend on the material
  for (std::size_t m = 0; m < materials.size(); ++m) {
    head += "comment material ";
    append_number(head, static_cast<std::uint64_t>(m));
    head += ' ' + words[m] + '\n';
    std::string& bytes = columns.emplace_back();
    append_bytes(bytes, static_cast<std::uint16_t>(m));
    if (scene) {
      for (const std::uint8_t c : rgb_bytes(scene->materials[m].color)) append_bytes(bytes, c);
    }
  }
  head += "element vertex ";
  append_number(head, static_cast<std::uint64_t>(p.size()));
  const std::string real = sizeof(Real) == sizeof(float) ? "float" : "double";
  for (const char* name : {"x", "y", "z", "vx", "vy", "vz", "radius"}) head += "\nproperty " + real + ' ' + name;
  head += "\nproperty uint id";
  if (long_ids) head += "\nproperty uint id_high";
  head += "\nproperty ushort material";
  if (scene) head += "\nproperty uchar red\nproperty uchar green\nproperty uchar blue";
  head += "\nend_header\n";

  OutputFile out(file);
  out.write(head);
  write_rows(out, p.size(), [&](std::string& bytes, std::size_t i) {
    append_vector_bytes<Real>(bytes, p.position[i]);
    append_vector_bytes<Real>(bytes, p.velocity[i]);
    append_bytes(bytes, static_cast<Real>(materials[p.material[i]].radius));
    append_bytes(bytes, static_cast<std::uint32_t>(p.id[i]));
    if (long_ids) append_bytes(bytes, static_cast<std::uint32_t>(p.id[i] >> 32U));
    bytes += columns[p.material[i]];
  });
  out.finish();
}

}  // namespace

std::vector<std::filesystem::path> export_ply(const ExportJob& job) {
  const RunInfo& info = job.run.info();
  const auto write = info.precision == Precision::single_precision ? write_file<float> : write_file<double>;
  return export_each(job, [&](std::size_t index, const std::filesystem::path& file) {
    write(take(job.run.read(index)), info.materials, job.options.scene, file);
  });
}

}  // namespace hooke::io
