// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/material_words.h"

#include <charconv>

namespace hooke {

std::string as_word(std::string_view name) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string word;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > ' ' && byte < 0x7f && c != '"' && c != '#' && c != '%') {
      word += c;
    } else {
      word += {'%', kDigits[byte / 16], kDigits[byte % 16]};
    }
  }
  return word;
}

std::array<std::uint8_t, 3> rgb_bytes(std::string_view color) {
  std::array<std::uint8_t, 3> rgb{200, 200, 200};
  if (color.size() != 7) return rgb;
  for (std::size_t i = 0; i < 3; ++i) {
    const char* digits = color.data() + 1 + 2 * i;
    std::from_chars(digits, digits + 2, rgb[i], 16);
  }
  return rgb;
}

}  // namespace hooke
