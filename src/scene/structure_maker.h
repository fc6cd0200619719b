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

namespace hooke {

/// What the sections of a scene that tie particles together work on: the particles so far, to which they add, and the
/// structure that comes out.
struct StructureMaker {
  const Scene& scene;
  const std::filesystem::path& folder;
  const LoadOptions& options;
  Findings& findings;
  ParticleSet& particles;
  Structure structure{};

  /// Index of the material that `entry` names; a finding where the scene has none of this name.
  std::optional<std::uint16_t> material_of(const Json& entry, const std::string& path);

  /// Whether there is memory for so many particles and springs more; a finding at `path` where not.
  bool fits(double particle_count, double spring_count, const std::string& path);

  /// Adds particles with the next ids; returns the first one's. A finding at `path` where one is outside the domain.
  std::uint64_t add_particles(const std::vector<Vec3d>& positions, std::uint16_t material, const Vec3d& velocity,
                              const std::string& path);

  /// The springs that were added since the last call are those of the entry at `path`.
  void end_group(const std::string& path);

  /// Distance of two particles (ids) that there are, by the nearest image, m.
  double distance(std::uint64_t a, std::uint64_t b) const;

  // The sections, one file each. Nothing is made where findings touch an entry, or of what options.with_particles
  // leaves out.
  void add_cloths(const Json& cloths);
  void add_bodies(const Json& bodies);
  void add_springs(const Json& springs);
};

/// The entry's "break_strain", or infinity.
double break_strain_of(const Json& entry);

/// What ties and holds a scene's particles, and the particles of its cloths and bodies added to `particles`. Null where
/// there is nothing.
std::shared_ptr<const Structure> load_structure(const Json& json, const Scene& scene,
                                                const std::filesystem::path& folder, const LoadOptions& options,
                                                Findings& findings, ParticleSet& particles);

}  // namespace hooke
