// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/particle_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "hooke/base/assert.h"
#include "hooke/scene/particle_format.h"

namespace hooke::scene {

namespace {

struct Format {
  ParticleFileFormat info;
  ParticleReader* read;
};

const std::vector<Format>& formats() {
  static const std::vector<Format> all{
      {{{".csv", ".txt"}, "a table with a header", false}, read_csv_particles},
      {{{".ply"}, "PLY, text or binary: the vertices", false}, read_ply_particles},
      {{{".xyz", ".extxyz"}, "XYZ, plain or extended", true}, read_xyz_particles},
      {{{".data", ".lmp"}, "LAMMPS data file, atom styles sphere, atomic and charge", false}, read_lammps_data},
      {{{".dump", ".lammpstrj"}, "LAMMPS dump, as text", true}, read_lammps_dump},
  };
  return all;
}

const Format* format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : formats()) {
    const auto& known = format.info.extensions;
    if (std::find(known.begin(), known.end(), extension) != known.end()) return &format;
  }
  return nullptr;
}

bool are_indices_of_materials(const ParticleFileRules& rules) {
  const auto is_known = [&](std::uint16_t material) { return material < rules.materials.size(); };
  return (!rules.material || is_known(*rules.material)) &&
         std::all_of(rules.types.begin(), rules.types.end(), [&](const auto& type) { return is_known(type.second); });
}

void read(const std::filesystem::path& file, ParticleRows& rows) {
  try {
    const Format* format = format_of(file);
    if (format == nullptr) throw FileFault(0, "has no extension that names a format of particles");
    FileScanner in(file);
    format->read(in, rows);
  } catch (const FileFault& fault) {
    rows.give_up(fault);
  }
}

}  // namespace

std::vector<ParticleFileFormat> particle_file_formats() {
  std::vector<ParticleFileFormat> infos;
  for (const Format& format : formats()) infos.push_back(format.info);
  return infos;
}

std::optional<ParticleFileFormat> particle_file_format(const std::filesystem::path& file) {
  const Format* format = format_of(file);
  return format == nullptr ? std::nullopt : std::optional(format->info);
}

std::uint64_t count_particles(const std::filesystem::path& file, const ParticleFileRules& rules) {
  // Faults are dropped here: reading the file will report them.
  Findings findings("");
  std::vector<Finding> warnings;
  ParticleRows rows(rules, file.string(), true, findings, warnings);
  read(file, rows);
  return rows.expected();
}

FileParticles read_particle_file(const std::filesystem::path& file, const std::string& name,
                                 const ParticleFileRules& rules, Findings& findings, std::vector<Finding>& warnings) {
  HOOKE_ASSERT(are_indices_of_materials(rules), rules.materials.size());
  ParticleRows rows(rules, name, false, findings, warnings);
  read(file, rows);
  return rows.finish();
}

std::string place_in_file(const std::string& name, std::uint64_t place, bool binary) {
  if (place == 0) return name;
  return binary ? fmt::format("{}, byte {}", name, place) : fmt::format("{}:{}", name, place);
}

}  // namespace hooke::scene
