// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/particle_slices.h"
#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke::scene {

/// Bytes that one particle needs in all: in the back end, in its neighbour list, and while it is written to files.
inline constexpr double kBytesPerParticle = 260;

/// Bytes that one spring needs, likewise.
inline constexpr double kBytesPerSpring = 130;

/// Options for reading a scene.
struct LoadOptions {
  /// "PATH=VALUE" each, as for --set: replaces (or adds) the value at a JSON path such as "time.step",
  /// "materials.water.radius" or "particles[0].block.count" before anything is checked. VALUE is JSON; a VALUE that is
  /// not JSON counts as a string.
  std::vector<std::string> overrides;
  /// Lets paths inside the scene be absolute or lead out of its folder.
  bool allow_outside = false;
  /// False where the particles come from a checkpoint: the text of the sources is checked, but they are not read.
  bool with_particles = true;
  /// Bytes that the particles may need in all; 0: the memory that the machine has available.
  std::uint64_t memory_limit = 0;
  /// The part of the particles that this machine will hold: below 1 where several machines share them out.
  double share_here = 1;
  /// Gives LoadedScene::slices in place of `particles` where it can. The findings are the same.
  bool in_slices = false;
};

/// A file that the scene refers to and that is needed to read the scene again.
struct SceneFile {
  std::string name;  ///< as the scene writes it
  std::filesystem::path path;  ///< where it is
};

/// What the distance fields of a scene's meshes take of memory, bytes.
struct FieldMemory {
  double kept = 0;  ///< as long as the scene lives
  double most = 0;  ///< at a time while they are made
};

/// A scene file, read, checked and resolved.
struct LoadedScene {
  Scene scene;
  ParticleSet particles;  ///< of its sources; ids from 1 in order of the sources, or the files' own
  /// The same particles, made a slice at a time as they are visited: a lattice without holding it, every other source
  /// as a whole when its turn comes. An error where a file has changed since. Null but for LoadOptions::in_slices; and
  /// where the scene has cloths, bodies or springs, or ids that don't ascend from source to source.
  std::shared_ptr<const ParticleSlices> slices;
  std::string resolved;  ///< the scene as it was understood, with overrides and defaults written out, JSON;
                         ///< its paths are still relative to the scene's folder
  std::vector<SceneFile> files;  ///< meshes; particle files are not listed
  FieldMemory fields;
  std::vector<Finding> warnings;  ///< e.g. CSV columns that are ignored
};

/// Reads a scene file (docs/scene.md). Reports all findings at once, each with its JSON path (or CSV file and line),
/// the value and what is allowed; Error::Kind::bad_input.
Expected<LoadedScene> load_scene(const std::filesystem::path& file, const LoadOptions& options = {});

/// The same for a text; its paths are relative to `folder`, and messages call it `name`.
Expected<LoadedScene> parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                                  const LoadOptions& options = {});

/// The JSON Schema of scene files: the one source of keys, defaults, units and ranges.
std::string_view scene_schema();

}  // namespace hooke::scene
