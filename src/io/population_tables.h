// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "hooke/core/simulation.h"
#include "hooke/io/hdf5.h"

namespace hooke::io {

/// Writes how far emitters have got and when lives end into an HDF5 file; nothing for a scene without emitters. Throws
/// Failure.
void write_population(hid_t file, const SimulationState& state);

/// Reads these tables into `state`, which stays as it is where the file has none. Throws Failure.
void read_population(hid_t file, const std::filesystem::path& path, SimulationState& state);

}  // namespace hooke::io
