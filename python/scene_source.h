// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "arrays.h"
#include "hooke/core/particles.h"
#include "hooke/run/open_simulation.h"

namespace hooke::python {

/// Options of reading a scene as Python calls them.
struct SceneOptions {
  py::dict set;  ///< path: value
  bool allow_outside = false;
  std::optional<std::filesystem::path> resume;  ///< a checkpoint
};

/// Particles in arrays, beside those of a scene.
struct ParticleArrays {
  py::object positions;   ///< m
  py::object velocities;  ///< m/s, or None
  py::object material;    ///< a name, names or indices, or None
  py::object ids;         ///< or None
};

/// Reads a scene from a file; SceneError with every finding.
scene::LoadedScene read_scene(const std::filesystem::path& file, const SceneOptions& options);
/// The same from a dict like a scene's JSON. Paths in it are relative to `folder`.
scene::LoadedScene read_scene(const py::dict& scene, const std::filesystem::path& folder, const SceneOptions& options);

/// Adds particles to those of a scene that has been read.
void add_particles(scene::LoadedScene& scene, const ParticleArrays& arrays);

std::vector<std::string> material_names(const Scene& scene);

/// The index of a material for each of `count` particles: from a name or an index for all, or from `count` of them, in
/// a sequence or an array. `names`: those of the scene. InputError.
std::vector<std::size_t> to_materials(const py::object& material, std::size_t count,
                                      const std::vector<std::string>& names);

/// The Python object that JSON stands for.
py::object parse_json(const std::string& text);

}  // namespace hooke::python
