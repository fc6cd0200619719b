// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

#include "hooke/base/assert.h"
#include "hooke/io/failure.h"

namespace hooke {

namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 20U;

template <class T>
void append_shortest(std::string& text, T value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value);
  text.append(digits, end.ptr);
}

}  // namespace

Descriptor::~Descriptor() {
  if (fd_ >= 0) ::close(fd_);
}
Descriptor::Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

std::string system_message(int error_number) { return std::generic_category().message(error_number); }

int write_at(int fd, const void* data, std::size_t size, std::uint64_t offset) {
  const char* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = ::pwrite(fd, bytes, size, static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return n < 0 ? errno : ENOSPC;
    bytes += n;
    size -= static_cast<std::size_t>(n);
    offset += static_cast<std::uint64_t>(n);
  }
  return 0;
}

int read_at(int fd, void* data, std::size_t size, std::uint64_t offset) {
  char* bytes = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t n = ::pread(fd, bytes, size, static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    if (n == 0) {
      std::memset(bytes, 0, size);
      return 0;
    }
    bytes += n;
    size -= static_cast<std::size_t>(n);
    offset += static_cast<std::uint64_t>(n);
  }
  return 0;
}

std::uint64_t size_of(int fd, const std::filesystem::path& path) {
  struct stat status{};
  if (::fstat(fd, &status) != 0) throw Failure(Error::Kind::io, path, "can't be read: " + system_message(errno));
  return static_cast<std::uint64_t>(status.st_size);
}

std::filesystem::path unfinished_name(const std::filesystem::path& file) {
  std::filesystem::path name = file;
  name += ".unfinished";
  return name;
}

void publish(const std::filesystem::path& file) {
  const std::filesystem::path unfinished = unfinished_name(file);
  const auto give_up = [&](int error_number) {
    ::unlink(unfinished.c_str());
    throw Failure(Error::Kind::io, file, "can't be written: " + system_message(error_number));
  };
  const Descriptor written(::open(unfinished.c_str(), O_RDONLY | O_CLOEXEC));
  if (!written || ::fsync(written.get()) != 0) give_up(errno);
  if (::rename(unfinished.c_str(), file.c_str()) != 0) give_up(errno);
  // The new name is on the disk only when its folder is synced; file systems that can't sync a folder do it themselves.
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const Descriptor parent(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (parent) ::fsync(parent.get());
}

OutputFile::OutputFile(const std::filesystem::path& file)
    : file_(file),
      fd_(::open(unfinished_name(file).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (!fd_) throw Failure(Error::Kind::io, file_, "can't be written: " + system_message(errno));
  buffer_.reserve(kBufferBytes);
}

OutputFile::~OutputFile() {
  if (fd_) ::unlink(unfinished_name(file_).c_str());
}

void OutputFile::flush() {
  if (const int error = write_at(fd_.get(), buffer_.data(), buffer_.size(), written_)) {
    throw Failure(Error::Kind::io, file_, "can't be written: " + system_message(error));
  }
  written_ += buffer_.size();
  buffer_.clear();
}

void OutputFile::write(std::string_view bytes) {
  HOOKE_ASSERT(fd_, file_.string());
  buffer_ += bytes;
  if (buffer_.size() >= kBufferBytes) flush();
}

void OutputFile::finish() {
  HOOKE_ASSERT(fd_, file_.string());
  flush();
  publish(file_);
  fd_ = Descriptor();
}

void append_number(std::string& text, float value) { append_shortest(text, value); }
void append_number(std::string& text, double value) { append_shortest(text, value); }
void append_number(std::string& text, std::int64_t value) { append_shortest(text, value); }
void append_number(std::string& text, std::uint64_t value) { append_shortest(text, value); }

}  // namespace hooke
