// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "hooke/core/simulation.h"
#include "hooke/io/hdf5.h"

namespace hooke {

/// Writes a scene's structure and what of a state belongs to it into an HDF5 file; nothing where there is no structure.
/// Throws Failure.
void write_structure(hid_t file, const SimulationState& state);

/// Reads them back into `state`; its structure stays null where the file has none. Throws Failure.
void read_structure(hid_t file, const std::filesystem::path& path, SimulationState& state);

}  // namespace hooke
