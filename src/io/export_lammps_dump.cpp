// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// LAMMPS text dump: all snapshots in one file, for OVITO and for LAMMPS's read_dump and rerun. The type is the
// material, from 1; the element is its name. The box is the scene's domain, with faces that are not periodic fixed (f);
// without a scene it is the box around the particles (shrink-wrapped, s).
#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/lammps_box.h"
#include "hooke/io/material_words.h"
#include "hooke/io/write_rows.h"

namespace hooke::io {

namespace {

constexpr std::size_t kLongestWord = 500;  // bytes: LAMMPS takes lines of 1024

template <class Real>
void write_frame(OutputFile& out, const Snapshot& snapshot, const std::vector<MaterialInfo>& materials,
                 const std::vector<std::string>& words, const Scene* scene) {
  const ParticleSet& p = snapshot.particles;
  const Domain box = lammps_box(snapshot, materials, scene);
  std::string head = "ITEM: TIME\n";
  append_number(head, snapshot.time);
  head += "\nITEM: TIMESTEP\n";
  append_number(head, snapshot.step);
  head += "\nITEM: NUMBER OF ATOMS\n";
  append_number(head, static_cast<std::uint64_t>(p.size()));
  head += "\nITEM: BOX BOUNDS";
  for (const Boundary boundary : box.boundary) {
    head += boundary == Boundary::periodic ? " pp" : scene ? " ff" : " ss";
  }
  head += '\n';
  for (int axis = 0; axis < 3; ++axis) {
    append_number(head, component(box.min, axis));
    head += ' ';
    append_number(head, component(box.max, axis));
    head += '\n';
  }
  head += "ITEM: ATOMS id type element radius mass x y z vx vy vz\n";
  out.write(head);

  std::vector<std::string> columns;  // text of the columns that depend on the material
  for (std::size_t m = 0; m < materials.size(); ++m) {
    std::string& text = columns.emplace_back(" ");
    append_number(text, static_cast<std::uint64_t>(m + 1));
    text += ' ' + words[m] + ' ';
    append_number(text, materials[m].radius);
    text += ' ';
    append_number(text, materials[m].mass);
    text += ' ';
  }
  write_rows(out, p.size(), [&](std::string& text, std::size_t i) {
    append_number(text, p.id[i]);
    text += columns[p.material[i]];
    append_vector<Real>(text, p.position[i]);
    text += ' ';
    append_vector<Real>(text, p.velocity[i]);
    text += '\n';
  });
}

}  // namespace

std::vector<std::filesystem::path> export_lammps_dump(const ExportJob& job) {
  const RunInfo& info = job.run.info();
  const auto write = info.precision == Precision::single_precision ? write_frame<float> : write_frame<double>;
  const std::vector<std::string> words = material_words(info.materials, kLongestWord, job.file);
  OutputFile out(job.file);
  out.write("ITEM: UNITS\nsi\n");
  for (const std::size_t index : job.indices) {
    write(out, take(job.run.read(index)), info.materials, words, job.options.scene);
  }
  out.finish();
  return {job.file};
}

}  // namespace hooke::io
