// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <variant>
#include <vector>

#include "action.h"
#include "hooke/base/expected.h"

namespace hooke::view {

/// Which scene a record is of, and how it was opened.
struct RecordHead {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  ///< PATH=VALUE
  bool allow_outside = false;
  std::string device = "cpu";
};

/// An action, or a hash that the state had, after so many steps since the record began.
struct RecordEntry {
  std::int64_t steps = 0;
  std::variant<Action, std::uint64_t> what;
};

/// A record as it is read: the actions and hashes that hold. What was taken back by a step back is left out.
struct Record {
  RecordHead head;
  std::vector<RecordEntry> entries;
};

/// Writes a record while a simulation is used: a line of JSON each, flushed at once, so that it holds whatever happens.
class RecordWriter {
 public:
  /// io where the file can't be written. The path of the scene is written relative to the record's folder.
  static Expected<RecordWriter> create(const std::filesystem::path& file, const RecordHead& head);

  void add(std::int64_t steps, const Action& action);
  void add_hash(std::int64_t steps, std::uint64_t hash);
  /// The state is again that after `steps` steps and the first `actions` actions.
  void go_back(std::int64_t steps, std::size_t actions);
  /// Whether all has been written so far.
  bool is_good() const { return file_.good(); }

 private:
  explicit RecordWriter(std::ofstream file) : file_(std::move(file)) {}
  void write(const scene::Json& line);
  std::ofstream file_;
};

/// bad_input, with the line, where the file is no record.
Expected<Record> read_record(const std::filesystem::path& file);

}  // namespace hooke::view
