// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace hooke::scene {

/// Bytes that this machine can give without swapping; 0 where that is unknown.
std::uint64_t available_memory();

/// "1.2 GiB", "260 bytes".
std::string in_bytes(double bytes);

}  // namespace hooke::scene
