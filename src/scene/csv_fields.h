// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hooke/scene/words.h"

namespace hooke {

/// The fields of one line of CSV, without blanks around them. A field's text lies in the line, or in `unquoted` where
/// quotes had to be removed.
struct CsvFields {
  std::vector<std::string_view> at;
  std::vector<std::string> unquoted;
  bool open_quote = false;

  void split(std::string_view line) {
    at.clear();
    unquoted.clear();
    open_quote = false;
    if (line.find('"') != std::string_view::npos) return split_quoted(line);
    while (true) {
      const auto comma = line.find(',');
      at.push_back(trimmed(line.substr(0, comma)));
      if (comma == std::string_view::npos) return;
      line.remove_prefix(comma + 1);
    }
  }

 private:
  void split_quoted(std::string_view line) {
    std::string field;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '"' && open_quote && i + 1 < line.size() && line[i + 1] == '"') {
        field += line[i++];  // a doubled quote within quotes stands for one quote
      } else if (line[i] == '"') {
        open_quote = !open_quote;
      } else if (line[i] == ',' && !open_quote) {
        unquoted.push_back(std::exchange(field, ""));
      } else {
        field += line[i];
      }
    }
    unquoted.push_back(std::move(field));
    for (const std::string& text : unquoted) at.push_back(trimmed(text));
  }
};

/// `line` without the byte order mark that some programs put before a header.
inline std::string_view without_byte_order_mark(std::string_view line) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (line.substr(0, kByteOrderMark.size()) == kByteOrderMark) line.remove_prefix(kByteOrderMark.size());
  return line;
}

}  // namespace hooke
