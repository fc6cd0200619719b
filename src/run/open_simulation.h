// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/backend.h"
#include "hooke/core/simulation.h"
#include "hooke/run/launched_ranks.h"
#include "hooke/scene/load_scene.h"

namespace hooke::run {

/// The scene, and how it is read.
struct SceneArguments {
  std::filesystem::path file;
  std::vector<std::string> overrides;  ///< PATH=VALUE
  bool allow_outside = false;
};

/// The back end.
struct DeviceArguments {
  std::string device = "cpu";  ///< or "cuda", "auto": a GPU where it can be used, else the CPU; "reference"
  int threads = 0;  ///< of each rank; 0: as many as the machine has cores, or as the rank has
};

/// A scene that is ready to step.
struct OpenedSimulation {
  Simulation simulation;
  std::string resolved;           ///< the scene as it was understood, JSON
  std::vector<scene::SceneFile> files;   ///< the other files that it needs
  std::vector<Finding> warnings;  ///< of the loader
  scene::FieldMemory fields;
  /// The step up to which the folder of the checkpoint that it goes on from holds its output.
  std::int64_t kept_step = 0;
  int ranks = 1;    ///< that compute it together
  int threads = 1;  ///< of all ranks
};

/// The back end that is asked for, for so many particles of a scene; HOOKE_ISA in the environment picks the CPU's
/// instruction set. bad_input where the device can't be used, does not have what the scene needs, or has no room for
/// the particles. Where "auto" takes the CPU, why is added to `findings`.
Expected<std::unique_ptr<Backend>> make_backend(const DeviceArguments& arguments, const Scene& scene,
                                                std::size_t particles, std::vector<Finding>& findings);

/// Loads the scene and puts its particles, or those of the checkpoint `resume`, into a back end. On rank 0 of several
/// into the back ends of all: each reads the scene by itself, and must find the same.
Expected<OpenedSimulation> open_simulation(const SceneArguments& scene, const DeviceArguments& device,
                                           const std::filesystem::path& resume, const LaunchedRanks& ranks = {});

/// The same, in this process alone, for a scene that has been read: without its particles where there is a checkpoint.
Expected<OpenedSimulation> open_simulation(scene::LoadedScene loaded, const DeviceArguments& device,
                                           const std::filesystem::path& resume);

}  // namespace hooke::run
