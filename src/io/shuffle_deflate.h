// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace hooke {

/// What HDF5's shuffle and deflate filters make of `count` elements of `element_size` bytes, or another stream that
/// they undo just so. HDF5 by itself spends most of its time on the low bytes of a mantissa, which are noise: bytes
/// that are too evenly spread to become smaller are stored as they are. Throws Failure when memory runs out.
std::string shuffle_deflate(const void* data, std::size_t count, std::size_t element_size);

}  // namespace hooke
