// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Extended XYZ: all snapshots in one file, each a count, a line of key=value, and one row per particle. Columns have
// the names that OVITO maps to its own properties. The cell is the scene's domain; without a scene there is no cell.
#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/material_words.h"
#include "hooke/io/write_rows.h"

namespace hooke::io {

namespace {

constexpr std::size_t kLongestWord = 65536;  // bytes, far below the longest line that Hooke reads

/// `Lattice="..." Origin="..." pbc="..." `: the edges of the cell, its corner, and which axes are periodic.
std::string cell(const Domain& domain) {
  std::string text = "Lattice=\"";
  append_number(text, domain.length(0));
  text += " 0 0 0 ";
  append_number(text, domain.length(1));
  text += " 0 0 0 ";
  append_number(text, domain.length(2));
  text += "\" Origin=\"";
  append_vector<double>(text, domain.min);
  text += "\" pbc=\"";
  for (std::size_t axis = 0; axis < 3; ++axis) {
    text += axis == 0 ? "" : " ";
    text += domain.boundary[axis] == Boundary::periodic ? 'T' : 'F';
  }
  return text + "\" ";
}

template <class Real>
void write_frame(OutputFile& out, const Snapshot& snapshot, const std::vector<MaterialInfo>& materials,
                 const std::vector<std::string>& species, const std::string& cell) {
  const ParticleSet& p = snapshot.particles;
  std::string head;
  append_number(head, static_cast<std::uint64_t>(p.size()));
  head += '\n' + cell + "Properties=species:S:1:pos:R:3:velo:R:3:id:I:1:radius:R:1:mass:R:1 Time=";
  append_number(head, snapshot.time);
  head += " Step=";
  append_number(head, snapshot.step);
  out.write(head + '\n');

  std::vector<std::string> radius_and_mass;
  for (const MaterialInfo& m : materials) {
    std::string& end = radius_and_mass.emplace_back(" ");
    append_number(end, m.radius);
    end += ' ';
    append_number(end, m.mass);
    end += '\n';
  }
  write_rows(out, p.size(), [&](std::string& text, std::size_t i) {
    text += species[p.material[i]];
    text += ' ';
    append_vector<Real>(text, p.position[i]);
    text += ' ';
    append_vector<Real>(text, p.velocity[i]);
    text += ' ';
    append_number(text, p.id[i]);
    text += radius_and_mass[p.material[i]];
  });
}

}  // namespace

std::vector<std::filesystem::path> export_xyz(const ExportJob& job) {
  const RunInfo& info = job.run.info();
  const std::string cell_text = job.options.scene ? cell(job.options.scene->domain) : R"(pbc="F F F" )";
  const auto write = info.precision == Precision::single_precision ? write_frame<float> : write_frame<double>;
  const std::vector<std::string> species = material_words(info.materials, kLongestWord, job.file);
  OutputFile out(job.file);
  for (const std::size_t index : job.indices) write(out, take(job.run.read(index)), info.materials, species, cell_text);
  out.finish();
  return {job.file};
}

}  // namespace hooke::io
