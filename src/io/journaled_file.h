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

namespace hooke::io {

/// A file that changes by whole commits only, no matter when its writer is killed.
///
/// Writes behind the committed end go straight to the file, where no reader looks yet. Changes before that end stay in
/// memory, as pages, until commit() has written them to a journal beside the file; only then does it apply them in
/// place and remove the journal. A reader that finds a complete journal beside the file sees the journal's pages; an
/// incomplete journal is ignored. A failed write (a full disk) changes nothing either.
class JournaledFile {
 public:
  enum class Mode {
    read,    ///< sees the last commit; while open, delays the writer's next one (about 1 s at most)
    update,  ///< first completes a commit in which a writer was killed
    create,  ///< a new file; nothing is committed
  };

  /// Throws Failure.
  JournaledFile(const std::filesystem::path& file, Mode mode);

  const std::filesystem::path& path() const { return file_; }
  /// Sets the new name of a renamed file; its journal uses that name from now on.
  void set_path(const std::filesystem::path& file) { file_ = file; }

  bool writable() const { return mode_ != Mode::read; }
  std::uint64_t size() const;  ///< bytes in the file, committed or not

  /// Bytes past the end read as zeros. Returns 0 or errno; the first error stays for read_error().
  int read(std::uint64_t offset, void* data, std::size_t size);
  int read_error() const { return read_error_; }
  /// Like commit(), only for a file that is writable(). The first error stays: later writes do nothing, and commit()
  /// fails.
  void write(std::uint64_t offset, const void* data, std::size_t size);
  int write_error() const { return error_; }

  /// Whether bytes behind size() may be taken into use: of a new file, and of one to update from allow_growth() on.
  bool may_grow() const { return may_grow_; }
  void allow_growth() { may_grow_ = writable(); }
  /// The number of bytes in use; the next commit commits these.
  void set_end(std::uint64_t end) { end_ = end; }
  std::uint64_t end() const { return end_; }

  /// Commits all changes or none. Throws Failure: then nothing is committed, unless the journal was complete; it stays,
  /// readers see its pages, and the next writer applies them.
  void commit();
  /// Cuts off the bytes behind the committed end.
  void trim();
  /// Makes the committed state survive a power failure too. Throws Failure.
  void sync();

 private:
  static constexpr std::size_t kPageBytes = 4096;
  using Page = std::array<std::byte, kPageBytes>;

  std::filesystem::path journal_path() const;
  bool load_journal();  // into pages_; false without a complete journal; throws Failure where it can't be read
  int write_journal() const;
  int apply_pages() const;  // and removes the journal
  int remove_journal() const;
  void set_committed();
  Page& page(std::uint64_t index);

  std::filesystem::path file_;
  Mode mode_;
  bool may_grow_ = mode_ == Mode::create;
  Descriptor fd_;
  std::map<std::uint64_t, std::unique_ptr<Page>> pages_;  // changed pages before the committed end, by index
  std::uint64_t committed_pages_ = 0;
  std::uint64_t committed_end_ = 0;
  std::uint64_t end_ = 0;
  int error_ = 0;  // of the first write that failed
  int read_error_ = 0;  // of the first read that failed
};

}  // namespace hooke::io
