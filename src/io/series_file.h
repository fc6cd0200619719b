// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "hooke/io/output_file.h"
#include "hooke/io/series.h"

namespace hooke::io {

/// series.csv, written row by row; it always ends with a whole row. Throws Failure.
class SeriesFile {
 public:
  /// `header`: series_header() of the run.
  static SeriesFile create(const std::filesystem::path& path, const std::string& header);
  /// Opens an existing file, or creates one; cuts it before the first row of a step >= end_step.
  static SeriesFile update(const std::filesystem::path& path, const std::string& header, std::int64_t end_step);

  /// Steps must ascend; a row whose step is already there is not written again.
  void append(const SeriesRow& row);
  void sync();

 private:
  explicit SeriesFile(const std::filesystem::path& path);

  std::filesystem::path path_;
  Descriptor fd_;
  std::uint64_t size_ = 0;
  std::optional<std::int64_t> last_step_;
};

}  // namespace hooke::io
