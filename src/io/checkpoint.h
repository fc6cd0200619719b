// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/simulation.h"
#include "hooke/io/snapshot.h"

namespace hooke {

/// A state from which a run goes on with the same bits, and the run that it belongs to.
struct Checkpoint {
  RunInfo info;
  SimulationState state;
};

/// Writes a checkpoint file (HDF5): beside `file` first, synced to the disk, then renamed, so that at any moment
/// the old or the new one is there, whole. Error::Kind::io otherwise, and the old file stays.
Expected<void> write_checkpoint(const std::filesystem::path& file, const SimulationState& state, const RunInfo& info);

/// Reads one back, bit for bit. `file` may also be a run folder that holds one. A file that is missing, foreign,
/// damaged or of a later format is one Error::Kind::bad_input that says which.
Expected<Checkpoint> read_checkpoint(const std::filesystem::path& file);

/// What ties the particles of a run, from the checkpoint in its folder: null where the run has nothing that does, or
/// has written no checkpoint yet.
Expected<std::shared_ptr<const Structure>> read_structure_of_run(const std::filesystem::path& folder);

/// Whether a file bears the mark of a checkpoint; says nothing about its state.
bool is_checkpoint(const std::filesystem::path& file);

/// Why a run of `scene` can't go on from a checkpoint of `checkpoint` with the same bits: time step, integrator,
/// precision, names and order of the materials. Empty where it can; coefficients may differ.
std::vector<Finding> check_resumable(const RunInfo& checkpoint, const RunInfo& scene);

}  // namespace hooke
