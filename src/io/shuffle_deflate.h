// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace hooke::io {

/// The output of HDF5's shuffle and deflate filters for `count` elements of `element_size` bytes, or another stream
/// that they decode to the same data. HDF5 itself spends most of its time on the low bytes of mantissas, which are
/// noise: here, bytes too evenly spread to be compressed are stored as they are. Throws Failure when memory runs out.
std::string shuffle_deflate(const void* data, std::size_t count, std::size_t element_size);

}  // namespace hooke::io
