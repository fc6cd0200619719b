// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace hooke {

/// A name as one word of visible ASCII, for columns and comments: as it is, but for spaces, control characters, ", #,
/// % and bytes beyond ASCII, which become %XX of two hexadecimal digits, as in addresses of the web.
std::string as_word(std::string_view name);

/// Red, green, blue of a material's "#rrggbb", sRGB; light grey where there is none.
std::array<std::uint8_t, 3> rgb_bytes(std::string_view color);

}  // namespace hooke
