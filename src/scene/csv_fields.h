// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hooke/scene/words.h"

namespace hooke::scene {

/// The fields of one line of CSV, without blanks around them but with those between quotes. A field's text lies in the
/// line, or in `unquoted` where quotes had to be removed.
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
    std::size_t kept = 0;  // bytes of the field up to its last quote, which blanks at its end don't shorten
    const auto end_field = [&] {
      while (field.size() > kept && trimmed(std::string_view(field).substr(field.size() - 1)).empty()) field.pop_back();
      unquoted.push_back(std::exchange(field, ""));
      kept = 0;
    };
    for (std::size_t i = 0; i < line.size(); ++i) {
      const bool blank = trimmed(line.substr(i, 1)).empty();
      if (line[i] == '"' && open_quote && i + 1 < line.size() && line[i + 1] == '"') {
        field += line[i++];  // a doubled quote within quotes stands for one quote
      } else if (line[i] == '"') {
        open_quote = !open_quote;
        kept = field.size();
      } else if (line[i] == ',' && !open_quote) {
        end_field();
      } else if (open_quote || !blank || !field.empty()) {
        field += line[i];
      }
    }
    end_field();
    at.assign(unquoted.begin(), unquoted.end());
  }
};

}  // namespace hooke::scene
