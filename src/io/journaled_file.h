// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "hooke/io/output_file.h"

namespace hooke {

/// A file that changes by whole commits only, whatever moment its writer is killed at.
///
/// What is written behind the committed end goes straight to the file, where nobody looks for it yet. Changes before
/// that end are kept in memory, by pages, until commit() has put them into a journal beside the file; only then
/// are they made in place, and the journal removed. Whoever opens the file with a whole journal beside it sees the
/// journal's pages; an unfinished journal counts as none. A failed write (a full disk) changes nothing either.
class JournaledFile {
 public:
  enum class Mode {
    read,    ///< sees the last commit; holds off the writer's next one until it is closed
    update,  ///< makes the last commit whole first where its writer was killed in it
    create,  ///< a new file; nothing is committed
  };

  /// Throws Failure.
  JournaledFile(const std::filesystem::path& file, Mode mode);

  const std::filesystem::path& path() const { return file_; }
  /// Tells it that the file, and its journal from now on, has another name.
  void set_path(const std::filesystem::path& file) { file_ = file; }

  bool writable() const { return mode_ != Mode::read; }
  std::uint64_t size() const;  ///< bytes in the file, committed or not

  /// Past the end there are zeros. 0, or errno.
  int read(std::uint64_t offset, void* data, std::size_t size);
  /// Of a file that is writable(), like commit(). The first error stays: from then on writes do nothing, and commit()
  /// fails.
  void write(std::uint64_t offset, const void* data, std::size_t size);
  int write_error() const { return error_; }

  /// Bytes in use, of which the next commit will be.
  void set_end(std::uint64_t end) { end_ = end; }
  std::uint64_t end() const { return end_; }

  /// All or nothing. Throws Failure.
  void commit();
  /// Cuts off what lies behind the committed end.
  void trim();
  /// What is committed survives a power failure too. Throws Failure.
  void sync();

 private:
  static constexpr std::size_t kPageBytes = 4096;
  using Page = std::array<std::byte, kPageBytes>;

  std::filesystem::path journal_path() const;
  bool load_journal();  // into pages_; false where there is none that is whole
  int write_journal() const;
  int apply_pages() const;
  Page& page(std::uint64_t index);

  std::filesystem::path file_;
  Mode mode_;
  Descriptor fd_;
  std::map<std::uint64_t, std::unique_ptr<Page>> pages_;  // by index: changes before the committed end
  std::uint64_t committed_pages_ = 0;
  std::uint64_t committed_end_ = 0;
  std::uint64_t end_ = 0;
  int error_ = 0;
};

}  // namespace hooke
