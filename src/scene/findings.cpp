// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/findings.h"

#include <algorithm>
#include <limits>

#include "hooke/base/printable.h"
#include "hooke/scene/json_lines.h"

namespace hooke::scene {

namespace {

constexpr std::size_t kLongestPlace = 400;  // bytes: a key may be as long as the file

}  // namespace

void Findings::add(const std::string& path, std::string message) {
  if (all_.size() < kMost) paths_.insert(path);
  const bool in_text = !without_line_.contains_at_or_above(path);
  keep({{path.empty() ? document_ : path, std::move(message)}, path, in_text});
}

void Findings::add_elsewhere(std::string where, std::string message) {
  keep({{std::move(where), std::move(message)}, "", false});
}

void Findings::keep(Entry entry) {
  if (all_.size() < kMost) {
    // Messages quote what they are about; whatever it is, they stay one line that a terminal can show.
    entry.finding.where = printable(entry.finding.where, std::string::npos);
    entry.finding.message = printable(entry.finding.message, std::string::npos);
    all_.push_back(std::move(entry));
  } else {
    left_out_ = true;
  }
}

bool Findings::touches(std::string_view path) const {
  return left_out_ || paths_.contains_at_or_above(path) || paths_.contains_at_or_below(path);
}

void Findings::find_lines() {
  std::vector<std::string> paths;
  for (const Entry& entry : all_) {
    if (entry.in_text) paths.push_back(entry.path);
  }
  if (text_.empty() || paths.empty()) return;
  const std::vector<int> lines = lines_of(text_, paths);
  auto line = lines.begin();
  for (Entry& entry : all_) {
    if (entry.in_text) entry.line = *line++;
    if (entry.line > 0) entry.finding.message += " (line " + std::to_string(entry.line) + ")";
  }
}

std::vector<Finding> Findings::take() {
  find_lines();
  const auto rank = [](const Entry& entry) { return entry.line > 0 ? entry.line : std::numeric_limits<int>::max(); };
  std::stable_sort(all_.begin(), all_.end(), [rank](const Entry& a, const Entry& b) { return rank(a) < rank(b); });
  std::vector<Finding> taken;
  taken.reserve(all_.size() + 1);
  for (Entry& entry : all_) {
    taken.push_back({printable(entry.finding.where, kLongestPlace), std::move(entry.finding.message)});
  }
  if (left_out_) taken.push_back({document_, "has more findings, which are left out here"});
  all_.clear();
  left_out_ = false;
  return taken;
}

}  // namespace hooke::scene
