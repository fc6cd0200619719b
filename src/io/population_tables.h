// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "hooke/core/simulation.h"
#include "hooke/io/hdf5.h"

namespace hooke {

/// Writes the progress of emitters, the ends of lives, and the ledger of births and deaths into an HDF5 file; nothing
/// where a state has none of these. Throws Failure.
void write_population(hid_t file, const SimulationState& state);

/// Reads these tables into `state`, which stays as it is where the file has none. Throws Failure.
void read_population(hid_t file, const std::filesystem::path& path, SimulationState& state);

}  // namespace hooke
