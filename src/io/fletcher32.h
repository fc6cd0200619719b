// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace hooke::io {

/// The Fletcher-32 checksum as HDF5 takes it: of big-endian 16-bit words, modulo 65535; a last odd byte is the high one
/// of a word. (J. G. Fletcher, "An arithmetic checksum for serial transmissions", 1982.)
std::uint32_t fletcher32(std::string_view bytes);

/// Appends the checksum as HDF5's filter stores it, little endian.
void append_fletcher32(std::string& bytes);

}  // namespace hooke::io
