// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/findings.h"

#include <algorithm>

#include "hooke/scene/json_path.h"

namespace hooke {

void Findings::forget_lines(std::string_view path) {
  std::erase_if(lines_, [path](const auto& entry) { return is_at_or_below(entry.first, path); });
}

void Findings::add(const std::string& path, std::string message) {
  // What is missing has no line of its own; that of the object that lacks it helps.
  auto line = lines_.find(path);
  if (line == lines_.end()) {
    const auto last = path.find_last_of(".[");
    line = lines_.find(last == std::string::npos ? "" : path.substr(0, last));
  }
  if (line != lines_.end()) message += " (line " + std::to_string(line->second) + ")";
  paths_.push_back(path);
  all_.push_back({path.empty() ? document_ : path, std::move(message)});
}

void Findings::add_elsewhere(std::string where, std::string message) {
  all_.push_back({std::move(where), std::move(message)});
}

bool Findings::touches(std::string_view path) const {
  return std::any_of(paths_.begin(), paths_.end(), [path](const std::string& found) {
    return is_at_or_below(found, path) || is_at_or_below(path, found);
  });
}

bool Findings::touches_at(std::string_view path) const {
  return std::find(paths_.begin(), paths_.end(), path) != paths_.end();
}

}  // namespace hooke
