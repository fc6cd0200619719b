// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/findings.h"

#include <algorithm>
#include <limits>

#include "hooke/scene/json_path.h"

namespace hooke {

void Findings::forget_lines(std::string_view path) { without_line_.emplace_back(path); }

void Findings::add(const std::string& path, std::string message) {
  const int line = line_of(path);
  if (line > 0) message += " (line " + std::to_string(line) + ")";
  paths_.push_back(path);
  all_.emplace_back(line, Finding{path.empty() ? document_ : path, std::move(message)});
}

void Findings::add_elsewhere(std::string where, std::string message) {
  all_.emplace_back(0, Finding{std::move(where), std::move(message)});
}

std::vector<Finding> Findings::take() {
  const auto rank = [](const auto& entry) { return entry.first > 0 ? entry.first : std::numeric_limits<int>::max(); };
  std::stable_sort(all_.begin(), all_.end(), [rank](const auto& a, const auto& b) { return rank(a) < rank(b); });
  std::vector<Finding> taken;
  taken.reserve(all_.size());
  for (auto& entry : all_) taken.push_back(std::move(entry.second));
  all_.clear();
  return taken;
}

int Findings::line_of(const std::string& path) const {
  for (const std::string& overridden : without_line_) {
    if (is_at_or_below(path, overridden)) return 0;
  }
  // A missing value has no line of its own; use the line of the object that lacks it.
  auto line = lines_.find(path);
  if (line == lines_.end()) {
    const auto last = path.find_last_of(".[");
    line = lines_.find(last == std::string::npos ? "" : path.substr(0, last));
  }
  return line == lines_.end() ? 0 : line->second;
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
