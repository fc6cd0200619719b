// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "hooke/core/simulation.h"
#include "hooke/io/hdf5.h"

namespace hooke::io {

/// Writes a scene's structure and its part of the state into an HDF5 file; nothing without a structure. Throws Failure.
void write_structure(hid_t file, const SimulationState& state);

/// Reads these tables into `state`, whose next_id is read already; its structure stays null where the file has none.
/// Throws Failure, also where an index is out of range.
void read_structure(hid_t file, const std::filesystem::path& path, SimulationState& state);

}  // namespace hooke::io
