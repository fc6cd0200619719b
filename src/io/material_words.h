// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hooke/io/snapshot.h"

namespace hooke::io {

/// A name as one word of visible ASCII, for columns and comments: spaces, control characters, ", #, % and bytes beyond
/// ASCII become %XX with two hexadecimal digits, as in web addresses; the rest stays.
std::string as_word(std::string_view name);

/// The names of materials as words for `file`, by material. Throws Failure where one is longer than `most` bytes: it
/// would not come back.
std::vector<std::string> material_words(const std::vector<MaterialInfo>& materials, std::size_t most,
                                        const std::filesystem::path& file);

/// The same as fields of a table, in quotes where need be, for rows that readers take line by line. Throws Failure
/// where a name holds the end of a line.
std::vector<std::string> material_fields(const std::vector<MaterialInfo>& materials, const std::filesystem::path& file);

/// Red, green, blue of a material's "#rrggbb", sRGB; light grey where the material has no colour.
std::array<std::uint8_t, 3> rgb_bytes(std::string_view color);

}  // namespace hooke::io
