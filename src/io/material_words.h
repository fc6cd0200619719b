// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace hooke {

/// A name as one word of visible ASCII, for columns and comments: spaces, control characters, ", #, % and bytes beyond
/// ASCII become %XX with two hexadecimal digits, as in web addresses; the rest stays.
std::string as_word(std::string_view name);

/// Red, green, blue of a material's "#rrggbb", sRGB; light grey where the material has no colour.
std::array<std::uint8_t, 3> rgb_bytes(std::string_view color);

}  // namespace hooke
