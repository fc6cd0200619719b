// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "hooke/base/expected.h"

namespace hooke {

/// Line of a scene's text on which the value at a JSON path stands.
using LineMap = std::unordered_map<std::string, int>;

/// What is wrong with one scene, collected until all of it has been looked at.
class Findings {
 public:
  /// `document` is what messages about the scene as a whole name.
  explicit Findings(std::string document) : document_(std::move(document)) {}

  /// Lines that are added to the messages about paths of the document itself.
  void set_lines(LineMap lines) { lines_ = std::move(lines); }
  /// No line is named any more at and below `path`: its value does not come from the text.
  void forget_lines(std::string_view path);

  /// About the value at a JSON path; "" is the whole document.
  void add(const std::string& path, std::string message);
  /// About something else: a file, a line of one, an option.
  void add_elsewhere(std::string where, std::string message);

  /// Whether there is a finding at, above or below `path`: what it holds is not to be relied on.
  bool touches(std::string_view path) const;
  /// Whether there is a finding about just this path.
  bool touches_at(std::string_view path) const;
  bool empty() const { return all_.empty(); }
  /// All of them: by line as far as they have one.
  std::vector<Finding> take();

 private:
  std::string document_;
  // 0 where the value at `path` stands on no line.
  int line_of(const std::string& path) const;

  LineMap lines_;
  std::vector<std::string> without_line_;
  std::vector<std::pair<int, Finding>> all_;  // with its line
  std::vector<std::string> paths_;  // of the findings about the document
};

}  // namespace hooke
