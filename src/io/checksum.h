// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "hooke/core/scene.h"
#include "hooke/core/snapshot.h"

namespace hooke::io {

// Checksums of what a file is to give back, for data whose way through the HDF5 library crosses tables that bear no
// checksums of their own.

/// Of a snapshot's step, time and particles, without their accelerations, as a file of this precision stores them.
std::uint64_t checksum(const Snapshot& snapshot, Precision precision);

/// Of a text.
std::uint64_t checksum(std::string_view text);

}  // namespace hooke::io
