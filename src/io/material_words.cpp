// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/material_words.h"

#include <fmt/format.h>

#include <charconv>

#include "hooke/base/printable.h"
#include "hooke/io/failure.h"
#include "hooke/io/write_rows.h"

namespace hooke::io {

namespace {

constexpr std::size_t kLongestField = 65536;  // bytes, far below the longest line that Hooke reads

Failure unwritable(const std::filesystem::path& file, const std::string& name, const std::string& why) {
  return {Error::Kind::bad_input, file,
          fmt::format("can't hold the name of material \"{}\": {}", printable(name, 60), why)};
}

}  // namespace

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

std::vector<std::string> material_words(const std::vector<MaterialInfo>& materials, std::size_t most,
                                        const std::filesystem::path& file) {
  std::vector<std::string> words;
  for (const MaterialInfo& m : materials) {
    const std::string& word = words.emplace_back(as_word(m.name));
    if (word.size() > most) {
      throw unwritable(file, m.name,
                       fmt::format("written as one word it takes {} bytes; at most {} fit into a line of "
                                   "this format",
                                   word.size(), most));
    }
  }
  return words;
}

std::vector<std::string> material_fields(const std::vector<MaterialInfo>& materials,
                                         const std::filesystem::path& file) {
  std::vector<std::string> fields;
  for (const MaterialInfo& m : materials) {
    if (m.name.find_first_of("\r\n") != std::string::npos) {
      throw unwritable(file, m.name, "it holds the end of a line, and each particle takes one line of this format");
    }
    if (m.name.size() > kLongestField) {
      throw unwritable(
          file, m.name,
          fmt::format("it takes {} bytes; at most {} fit into a line of this format", m.name.size(), kLongestField));
    }
    fields.push_back(csv_field(m.name));
  }
  return fields;
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

}  // namespace hooke::io
