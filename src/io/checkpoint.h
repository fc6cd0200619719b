// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/particle_slices.h"
#include "hooke/core/simulation.h"
#include "hooke/io/snapshot.h"

namespace hooke::io {

/// A state from which a run continues with the same bits, and the run that it belongs to.
struct Checkpoint {
  RunInfo info;
  SimulationState state;
};

/// Writes a checkpoint file (HDF5): first beside `file`, synced to the disk, then renamed, so that the old or the new
/// file is there at any moment, complete. On Error::Kind::io the old file stays.
Expected<void> write_checkpoint(const std::filesystem::path& file, const SimulationState& state, const RunInfo& info);

/// The same with these particles in place of the state's.
Expected<void> write_checkpoint(const std::filesystem::path& file, const SimulationState& state,
                                const ParticleSlices& particles, const RunInfo& info);

/// Reads a checkpoint bit for bit. `file` may also be a run folder that holds one. A file that is missing, foreign,
/// damaged or of a later format is an Error::Kind::bad_input that says which.
Expected<Checkpoint> read_checkpoint(const std::filesystem::path& file);

/// The structure that ties the particles of a run, from the checkpoint in its folder: null where the run has none or
/// has not written a checkpoint yet.
Expected<std::shared_ptr<const Structure>> read_structure_of_run(const std::filesystem::path& folder);

/// Whether a file bears the mark of a checkpoint; does not check that it is intact.
Expected<bool> is_checkpoint(const std::filesystem::path& file);

}  // namespace hooke::io
