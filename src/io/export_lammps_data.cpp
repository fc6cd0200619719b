// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// LAMMPS data file of one snapshot, for read_data with atom_style sphere and units si. The type is the material, from
// 1; comments name them. The box is the scene's domain, or without a scene the box around the particles.
#include <numbers>

#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/lammps_box.h"
#include "hooke/io/material_words.h"
#include "hooke/io/write_rows.h"

namespace hooke::io {

namespace {

constexpr std::size_t kLongestWord = 200;  // LAMMPS accepts no line longer than 255 bytes

template <class Real>
void write_file(const Snapshot& snapshot, const std::vector<MaterialInfo>& materials, const Scene* scene,
                const std::filesystem::path& file) {
  const ParticleSet& p = snapshot.particles;
  const Domain box = lammps_box(snapshot, materials, scene);
  std::string head = "Hooke, step ";
  append_number(head, snapshot.step);
  head += ", t = ";
  append_number(head, snapshot.time);
  head += " s\n\n";
  append_number(head, static_cast<std::uint64_t>(p.size()));
  head += " atoms\n";
  append_number(head, static_cast<std::uint64_t>(materials.size()));
  head += " atom types\n";
  const std::vector<std::string> words = material_words(materials, kLongestWord, file);
  std::vector<std::string> columns;  // text of the columns that depend on the material
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const double radius = materials[m].radius, mass = materials[m].mass;
    std::string type;
    append_number(type, static_cast<std::uint64_t>(m + 1));
    head += "# type " + type + ' ' + words[m] + '\n';
    std::string& text = columns.emplace_back(' ' + type + ' ');
    append_number(text, 2 * radius);
    text += ' ';
    append_number(text, mass / (4.0 / 3 * std::numbers::pi * radius * radius * radius));
    text += ' ';
  }
  const char* bounds[] = {" xlo xhi\n", " ylo yhi\n", " zlo zhi\n"};
  for (int axis = 0; axis < 3; ++axis) {
    append_number(head, component(box.min, axis));
    head += ' ';
    append_number(head, component(box.max, axis));
    head += bounds[axis];
  }

  OutputFile out(file);
  out.write(head);
  if (!p.empty()) {  // for LAMMPS an empty section is an error
    out.write("\nAtoms # sphere\n\n");
    write_rows(out, p.size(), [&](std::string& text, std::size_t i) {
      append_number(text, p.id[i]);
      text += columns[p.material[i]];
      append_vector<Real>(text, p.position[i]);
      text += '\n';
    });
    out.write("\nVelocities\n\n");
    write_rows(out, p.size(), [&](std::string& text, std::size_t i) {
      append_number(text, p.id[i]);
      text += ' ';
      append_vector<Real>(text, p.velocity[i]);
      text += " 0 0 0\n";
    });
  }
  out.finish();
}

}  // namespace

std::vector<std::filesystem::path> export_lammps_data(const ExportJob& job) {
  const RunInfo& info = job.run.info();
  const auto write = info.precision == Precision::single_precision ? write_file<float> : write_file<double>;
  return export_each(job, [&](std::size_t index, const std::filesystem::path& file) {
    write(take(job.run.read(index)), info.materials, job.options.scene, file);
  });
}

}  // namespace hooke::io
