// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"
#include "hooke/scene/load_scene.h"

namespace hooke::scene {

/// Shared by the sections of a scene that tie particles together: the particles so far, to which they add, and the
/// structure that they build.
struct StructureMaker {
  const Scene& scene;
  const std::filesystem::path& folder;
  const LoadOptions& options;
  Findings& findings;
  ParticleSet& particles;
  std::vector<Finding>& warnings;
  FieldMemory& fields;
  Structure structure{};

  /// Index of the material that `entry` names; a finding where the scene has no material of this name.
  std::optional<std::uint16_t> material_of(const Json& entry, const std::string& path);

  /// Whether there is memory for this many more particles and springs; a finding at `path` if not.
  bool fits(double particle_count, double spring_count, const std::string& path);

  /// Adds particles with the next ids; returns the first id. A finding at `path` where one is outside the domain.
  std::uint64_t add_particles(const std::vector<Vec3d>& positions, std::uint16_t material, const Vec3d& velocity,
                              const std::string& path);

  /// Assigns the springs added since the last call to the entry at `path`.
  void end_group(const std::string& path);

  /// Distance of two existing particles (ids), by the nearest image, m.
  double distance(std::uint64_t a, std::uint64_t b) const;

  // The sections, one file each. They make nothing from an entry that findings touch, nor what options.with_particles
  // leaves out.
  void add_cloths(const Json& cloths);
  void add_bodies(const Json& bodies);
  void add_springs(const Json& springs);
};

/// The entry's "break_strain", or infinity.
double break_strain_of(const Json& entry);

/// The springs and pinned particles of a scene; adds the particles of its cloths and bodies to `particles`. Null where
/// there are none.
std::shared_ptr<const Structure> load_structure(const Json& json, const Scene& scene,
                                                const std::filesystem::path& folder, const LoadOptions& options,
                                                Findings& findings, ParticleSet& particles,
                                                std::vector<Finding>& warnings, FieldMemory& fields);

}  // namespace hooke::scene
