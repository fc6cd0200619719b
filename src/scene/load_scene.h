// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke {

/// What one particle needs in all: in the back end, in its neighbour list, and on its way to files, bytes.
inline constexpr double kBytesPerParticle = 260;

/// What one spring needs likewise.
inline constexpr double kBytesPerSpring = 130;

/// How a scene is read.
struct LoadOptions {
  /// "PATH=VALUE" each, as of --set: replaces (or adds) the value at a JSON path such as "time.step",
  /// "materials.water.radius" or "particles[0].block.count" before anything is checked. VALUE is JSON; what
  /// is no JSON counts as a string.
  std::vector<std::string> overrides;
  /// Lets paths inside the scene be absolute or lead out of its folder.
  bool allow_outside = false;
  /// False where the particles come from a checkpoint: sources are checked as far as they are written, not read.
  bool with_particles = true;
  /// Bytes that the particles may need in all; 0: what the machine has.
  std::uint64_t memory_limit = 0;
};

/// A file that a scene was read from beside itself, and that is needed to read it again.
struct SceneFile {
  std::string name;             ///< as the scene writes it
  std::filesystem::path path;   ///< where it is
};

/// A scene file, read, checked and resolved.
struct LoadedScene {
  Scene scene;
  ParticleSet particles;           ///< what its sources hold, ids from 1 in order of the sources, or the files' own
  std::string resolved;            ///< the scene as it was understood, overrides and defaults written out, JSON;
                                   ///< its paths still relative to the scene's folder
  std::vector<SceneFile> files;    ///< meshes; files of particles are not among them
  std::vector<Finding> warnings;   ///< e.g. CSV columns that are ignored
};

/// Reads a scene file (docs/scene.md). Every finding at once, each with its JSON path (or CSV file and line), the
/// value and what is allowed; Error::Kind::bad_input.
Expected<LoadedScene> load_scene(const std::filesystem::path& file, const LoadOptions& options = {});

/// The same for a text; `folder` is what its paths are relative to, `name` what messages call it.
Expected<LoadedScene> parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                                  const LoadOptions& options = {});

/// The JSON Schema that rules scene files: the one source of keys, defaults, units and ranges.
std::string_view scene_schema();

}  // namespace hooke
