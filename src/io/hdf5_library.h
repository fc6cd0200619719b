// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <mutex>

namespace hooke::io::hdf5 {

/// Exclusive use of the HDF5 library while the lock exists; turns off the library's own error messages.
[[nodiscard]] std::unique_lock<std::recursive_mutex> lock();

/// Throws Failure, a bad_input of `file`, where HDF5 is not in this build: to be called before anything is changed.
void require(const std::filesystem::path& file);

}  // namespace hooke::io::hdf5
