// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/scene/json_path.h"

namespace hooke::scene {

/// The faults of one scene, collected until all of it has been checked, or until there are so many that they would bury
/// each other.
class Findings {
 public:
  static constexpr std::size_t kMost = 200;  ///< findings that are kept

  /// `document` is the name of the scene in messages about the scene as a whole.
  explicit Findings(std::string document) : document_(std::move(document)) {}

  /// Sets the text whose lines messages about paths of the document name. It must live until take().
  void set_text(std::string_view text) { text_ = text; }
  /// Messages no longer name a line at or below `path`: its value does not come from the text.
  void forget_lines(std::string_view path) { without_line_.insert(path); }

  /// Adds a finding about the value at a JSON path; "" is the whole document.
  void add(const std::string& path, std::string message);
  /// Adds a finding about something else: a file, a line of a file, an option.
  void add_elsewhere(std::string where, std::string message);

  /// Whether there is a finding at, above or below `path`: then the value at `path` can't be trusted.
  bool touches(std::string_view path) const;
  /// Whether there is a finding about exactly this path.
  bool touches_at(std::string_view path) const { return paths_.contains(path); }
  bool empty() const { return all_.empty(); }
  /// Whether findings had to be left out: what they are about is not known, so that no value can be trusted.
  bool overflows() const { return left_out_; }
  /// Takes all findings, sorted by line; those without a line come last.
  std::vector<Finding> take();

 private:
  struct Entry {
    Finding finding;
    std::string path;
    bool in_text = false;  // its path has a line
    int line = 0;  // 0 where there is none
  };

  void keep(Entry entry);
  void find_lines();

  std::string document_;
  std::string_view text_;
  PathSet without_line_;
  std::vector<Entry> all_;
  PathSet paths_;  // of the findings about the document
  bool left_out_ = false;
};

}  // namespace hooke::scene
