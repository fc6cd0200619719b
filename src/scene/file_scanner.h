// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "hooke/base/printable.h"

namespace hooke::scene {

/// A fault that ends the reading of a file. Never leaves the library: the reader's caller makes a finding of it.
class FileFault : public std::runtime_error {
 public:
  /// `place`: line, or byte of a binary file; 0 for the file as a whole.
  FileFault(std::uint64_t place, const std::string& message)
      : std::runtime_error(printable(message, std::string::npos)),
        place_(place) {}
  std::uint64_t place() const { return place_; }

 private:
  std::uint64_t place_;
};

/// Reads a file once, from front to back, in lines or in bytes. Holds a piece of the file in memory, never all of it.
/// Throws FileFault where the file can't be opened or read, and at a line longer than kLongestLine.
class FileScanner {
 public:
  static constexpr std::size_t kLongestLine = std::size_t{1} << 20U;  ///< bytes

  explicit FileScanner(const std::filesystem::path& file);

  /// The next line without its end (LF, CRLF or CR), or nothing at the end. Valid until the next call. A byte order
  /// mark is no part of the first line. Where CR alone ends the first line, an LF belongs to what follows: binary data
  /// may begin with it.
  std::optional<std::string_view> line();
  /// Skips `count` lines. False where the file has fewer.
  bool skip_lines(std::uint64_t count);
  /// The next `count` bytes, at most kLongestLine; null where fewer are left. Valid until the next call.
  const char* bytes(std::size_t count);
  /// Skips `count` bytes. False where the file has fewer.
  bool skip_bytes(std::uint64_t count);

  /// Number of the line that was read last; the first line is 1.
  std::uint64_t line_number() const { return place_.line; }
  /// Offset of the next byte, from 0.
  std::uint64_t offset() const { return place_.offset; }
  /// Bytes from here to the end.
  std::uint64_t remaining() const { return place_.offset < size_ ? size_ - place_.offset : 0; }

  /// A position in the file to go back to.
  struct Place {
    std::uint64_t offset = 0;
    std::uint64_t line = 0;
  };
  Place place() const { return place_; }
  void go_back(const Place& place);

 private:
  static constexpr std::size_t kBufferSize = kLongestLine + 2;  // with the line's end

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void pass_byte_order_mark();
  // The first end of a line among the unread bytes from `from` on, or null.
  const char* find_line_end(std::size_t from) const;
  // The bytes that the line end at `end` takes.
  std::size_t size_of_line_end(const char* end);
  // Reads until the buffer holds `count` unread bytes. False at the end of the file.
  bool fetch(std::size_t count);
  std::size_t at_hand() const { return end_ - begin_; }
  void pass(std::size_t count);

  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t size_ = 0;
  std::unique_ptr<char[]> buffer_;  // kBufferSize bytes
  std::size_t begin_ = 0;  // unread bytes: [begin_, end_) of the buffer
  std::size_t end_ = 0;
  std::optional<bool> lone_cr_;  // whether CR alone ends the first line
  Place place_;
};

}  // namespace hooke::scene
