// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "hooke/scene/json_reader.h"

namespace hooke::view {

/// A file of one line of JSON that tells what a window shows, replaced with every frame: for tests and for programs
/// that watch.
class StatusFile {
 public:
  /// Empty: nothing is written.
  explicit StatusFile(std::filesystem::path file) : file_(std::move(file)) {}
  /// A reader finds the old or the new line. A file that can't be written is passed over.
  void write(const scene::Json& line) const;
  bool is_wanted() const { return !file_.empty(); }

 private:
  std::filesystem::path file_;
};

}  // namespace hooke::view
