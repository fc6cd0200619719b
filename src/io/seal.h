// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace hooke::io {

// The last bytes of a checkpoint; HDF5 reads nothing behind its own end. The seal shows, before HDF5 reads the file,
// whether it was cut short or changed; HDF5 would not notice a changed bit in an array. It is the sum of the hashes of
// the file's blocks, so that any thread may look at any of them. All functions throw Failure.

/// Appends the seal of what the file holds so far.
void append_seal(const std::filesystem::path& file);

/// bad_input where the file bears no seal, that of an earlier format, or one that is not of its bytes.
void check_seal(const std::filesystem::path& file);

/// Whether the file bears a seal; it may be wrong.
bool has_seal(const std::filesystem::path& file);

}  // namespace hooke::io
