// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hooke {

/// Largest resident memory of this process so far, bytes.
std::uint64_t peak_resident_bytes();

/// Processor time so far, s: of all threads of this process, of this thread.
double processor_seconds();
double thread_processor_seconds();

}  // namespace hooke
