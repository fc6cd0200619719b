// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "hooke/io/checkpoint.h"
#include "hooke/io/hdf5.h"

// What reads a checkpoint, whole or in slices. All functions throw Failure.
namespace hooke::io {

inline constexpr const char* kTablesDiffer = "is a damaged checkpoint: its tables don't fit together";

/// All but the particles. Callers hold hdf5::lock().
Checkpoint read_all_but_particles(const hdf5::File& file, const std::filesystem::path& path);

}  // namespace hooke::io
