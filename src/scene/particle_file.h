// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hooke/base/vec3.h"
#include "hooke/core/materials.h"
#include "hooke/scene/file_box.h"
#include "hooke/scene/findings.h"

namespace hooke::scene {

inline constexpr std::uint64_t kLastFrame = std::numeric_limits<std::uint64_t>::max();

/// What a scene says about the particles of a file, for what the file leaves open.
struct ParticleFileRules {
  std::span<const Material> materials;    ///< of the scene: a particle names one and has its radius and mass
  std::optional<std::uint16_t> material;  ///< index; for particles that name no material
  Vec3d velocity{0, 0, 0};                ///< m/s; for particles without a velocity
  /// Index of the material for each type or species of the file.
  std::map<std::string, std::uint16_t, std::less<>> types;
  /// Which snapshot, from 0, or kLastFrame; if empty, the format decides.
  std::optional<std::uint64_t> frame;
};

/// The particles of a file in the order of the file; every column has one entry per particle.
struct FileParticles {
  std::vector<std::uint64_t> id;  ///< empty where the file has no such column
  std::vector<std::uint16_t> material;
  std::vector<Vec3d> position;       ///< m
  std::vector<Vec3d> velocity;       ///< m/s
  std::vector<std::uint64_t> place;  ///< line, from 1; or byte offset where the file is binary
  bool binary = false;
  std::optional<FileBox> box;  ///< where the file gives one
};

/// A kind of file that particles are read from.
struct ParticleFileFormat {
  std::vector<std::string> extensions;  ///< with their dots, in lower case
  const char* description;
  bool has_frames;  ///< may hold several snapshots
};
std::vector<ParticleFileFormat> particle_file_formats();

/// The format that the extension of `file` names, upper or lower case; nothing where it names none.
std::optional<ParticleFileFormat> particle_file_format(const std::filesystem::path& file);

/// Estimates how many particles read_particle_file will find: the number that the file states, limited by what its size
/// allows. 0 where the file can't be read.
std::uint64_t count_particles(const std::filesystem::path& file, const ParticleFileRules& rules);

/// Reads a file whose extension names a format (docs/scene.md, "Particle files"). Findings and warnings call it `name`
/// and give the line; faulty particles are left out. Accepts duplicate ids and any positions.
FileParticles read_particle_file(const std::filesystem::path& file, const std::string& name,
                                 const ParticleFileRules& rules, Findings& findings, std::vector<Finding>& warnings);

/// A place in a file, as messages write it: "initial.csv:12", "initial.ply, byte 4096".
std::string place_in_file(const std::string& name, std::uint64_t place, bool binary);

}  // namespace hooke::scene
