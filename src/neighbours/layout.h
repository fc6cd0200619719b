// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace hooke {

// How consecutive particles in cell order are taken together. Only constants: this header is compiled with the flags of
// every instruction set.

/// A slice: 16 consecutive particles in memory, one per lane of the neighbour list's rows. Whole packs at every width.
inline constexpr std::size_t kSliceLanes = 16;

/// A window: 64 consecutive particles in cell order. Within the window, their order in memory may differ.
inline constexpr std::size_t kWindow = 64;

/// A tile: the 1024 particles that a thread takes at a time.
inline constexpr std::size_t kTile = 1024;

static_assert(kTile % kWindow == 0 && kWindow % kSliceLanes == 0);

}  // namespace hooke
