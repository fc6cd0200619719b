// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "hooke/base/expected.h"

namespace hooke {

/// The line of a scene's text that holds the value at a JSON path.
using LineMap = std::unordered_map<std::string, int>;

/// The faults of one scene, collected until all of it has been checked.
class Findings {
 public:
  /// `document` is the name of the scene in messages about the scene as a whole.
  explicit Findings(std::string document) : document_(std::move(document)) {}

  /// Sets the lines that messages about paths of the document name.
  void set_lines(LineMap lines) { lines_ = std::move(lines); }
  /// Messages no longer name a line at or below `path`: its value does not come from the text.
  void forget_lines(std::string_view path);

  /// Adds a finding about the value at a JSON path; "" is the whole document.
  void add(const std::string& path, std::string message);
  /// Adds a finding about something else: a file, a line of a file, an option.
  void add_elsewhere(std::string where, std::string message);

  /// Whether there is a finding at, above or below `path`: then the value at `path` can't be trusted.
  bool touches(std::string_view path) const;
  /// Whether there is a finding about exactly this path.
  bool touches_at(std::string_view path) const;
  bool empty() const { return all_.empty(); }
  /// Takes all findings, sorted by line; those without a line come last.
  std::vector<Finding> take();

 private:
  std::string document_;
  // 0 where the value at `path` has no line.
  int line_of(const std::string& path) const;

  LineMap lines_;
  std::vector<std::string> without_line_;
  std::vector<std::pair<int, Finding>> all_;  // each with its line, 0 for none
  std::vector<std::string> paths_;  // of the findings about the document
};

}  // namespace hooke
