// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hooke/core/springs.h"

namespace hooke {

/// Appends a structure as bytes, for the message that starts other ranks; the names of its groups are left out.
void append_structure(std::vector<std::byte>& to, const Structure& structure);

/// Reads one back; what follows it is left in `from`.
Structure take_structure(std::span<const std::byte>& from);

}  // namespace hooke
