// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "hooke/core/simulation.h"
#include "hooke/io/hdf5.h"

namespace hooke {

/// Writes how far emitters have got, whose life ends when, and the ledger of births and deaths into an HDF5 file;
/// nothing where there is nothing of that. Throws Failure.
void write_population(hid_t file, const SimulationState& state);

/// Reads them back into `state`, which stays as it is where the file has none. Throws Failure.
void read_population(hid_t file, const std::filesystem::path& path, SimulationState& state);

}  // namespace hooke
