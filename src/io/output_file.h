// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "hooke/base/expected.h"

namespace hooke::io {

/// A file descriptor that closes itself; -1 if none.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;

  int get() const { return fd_; }
  explicit operator bool() const { return fd_ >= 0; }

 private:
  int fd_ = -1;
};

/// The text for an errno value.
std::string system_message(int error_number);

/// Writes or reads all bytes at `offset`, in as many calls as needed; 0 or errno. A read past the end gives zeros.
int write_at(int fd, const void* data, std::size_t size, std::uint64_t offset);
int read_at(int fd, void* data, std::size_t size, std::uint64_t offset);

/// The size of an open file in bytes, even if its name now belongs to another file. Throws Failure.
std::uint64_t size_of(int fd, const std::filesystem::path& path);

/// Whether there is a file or folder of this name. Throws Failure where that can't be told.
bool is_there(const std::filesystem::path& path);

/// Where the bytes of an output go.
struct OutputTarget {
  std::filesystem::path file;  ///< what a symbolic link leads to, or the output itself
  bool is_stream = false;      ///< a device, a pipe or an open file: written to as it is, never replaced
};

/// The target of an output of this name; io where that can't be told.
Expected<OutputTarget> output_target(const std::filesystem::path& file);
/// The same for an output that must be a file. Throws Failure where it is none.
std::filesystem::path output_file_of(const std::filesystem::path& file);

/// Opens a stream for writing. A pipe that no process reads is an error after some seconds. Throws Failure.
Descriptor open_stream(const std::filesystem::path& stream);

/// The name of a file while it is being written, beside `file`.
std::filesystem::path unfinished_name(const std::filesystem::path& file);

/// Syncs a finished file, so far called unfinished_name(file), to the disk and renames it to `file`. On failure removes
/// it and throws Failure.
void publish(const std::filesystem::path& file);

/// A text or binary file that appears under its name only when complete. A symbolic link stays, and its target is
/// written; a device or a pipe gets the bytes as they come. Throws Failure.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& file);
  ~OutputFile();  ///< without finish(), removes the unfinished file
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);
  void finish();  ///< no writes after this

 private:
  void put(std::string_view bytes);
  void flush();

  std::filesystem::path file_;  // as the caller names it
  OutputTarget target_;
  Descriptor fd_;
  std::string buffer_;
  std::uint64_t written_ = 0;
};

/// Appends the shortest digits that read back to the same number of that type.
void append_number(std::string& text, float value);
void append_number(std::string& text, double value);
void append_number(std::string& text, std::int64_t value);
void append_number(std::string& text, std::uint64_t value);

}  // namespace hooke::io
