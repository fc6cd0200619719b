// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/output_file.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include "hooke/base/assert.h"
#include "hooke/io/failure.h"

namespace hooke::io {

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

namespace {

/// Keeps the signal of a broken pipe from the calling thread while it exists: a library must not end its process.
class NoBrokenPipeSignal {
 public:
  NoBrokenPipeSignal() {
    ::sigemptyset(&pipe_);
    ::sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    ::sigpending(&pending);
    was_pending_ = ::sigismember(&pending, SIGPIPE) == 1;
    ::pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoBrokenPipeSignal() {
    const timespec at_once{};
    if (!was_pending_) ::sigtimedwait(&pipe_, nullptr, &at_once);
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoBrokenPipeSignal(const NoBrokenPipeSignal&) = delete;
  NoBrokenPipeSignal& operator=(const NoBrokenPipeSignal&) = delete;

 private:
  sigset_t pipe_{}, before_{};
  bool was_pending_ = false;
};

/// Writes all bytes where the file stands; 0 or errno.
int write_on(int fd, const char* bytes, std::size_t size) {
  const NoBrokenPipeSignal guard;
  while (size > 0) {
    const ssize_t n = ::write(fd, bytes, size);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EAGAIN) {  // an open file of another program's making
      pollfd ready{fd, POLLOUT, 0};
      ::poll(&ready, 1, -1);
      continue;
    }
    if (n <= 0) return n < 0 ? errno : ENOSPC;
    bytes += n;
    size -= static_cast<std::size_t>(n);
  }
  return 0;
}

/// The number of the open file that a name like /dev/stdout or /dev/fd/3 stands for; -1 for other names.
int open_file_number(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::canonical(file.parent_path(), error);
  if (error || folder != std::filesystem::canonical("/proc/self/fd", error) || error) return -1;
  const std::string name = file.filename().string();
  int number = -1;
  const auto read = std::from_chars(name.data(), name.data() + name.size(), number);
  return read.ec == std::errc() && read.ptr == name.data() + name.size() ? number : -1;
}

}  // namespace

Expected<OutputTarget> output_target(const std::filesystem::path& file) {
  constexpr int kMostLinks = 40;  // as Linux has it
  const auto give_up = [&](const std::error_code& error) {
    return fail(Error::Kind::io, file.string(), "can't be written: " + error.message());
  };
  std::filesystem::path target = file;
  for (int links = 0; links < kMostLinks; ++links) {
    if (open_file_number(target) >= 0) return OutputTarget{target, true};
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::symlink_status(target, error);
    if (!std::filesystem::status_known(status)) return give_up(error);
    if (!std::filesystem::is_symlink(status)) return OutputTarget{target, std::filesystem::is_other(status)};
    const std::filesystem::path next = std::filesystem::read_symlink(target, error);
    if (error) return give_up(error);
    target = target.parent_path() / next;
  }
  return give_up(std::make_error_code(std::errc::too_many_symbolic_link_levels));
}

std::filesystem::path output_file_of(const std::filesystem::path& file) {
  OutputTarget target = take(output_target(file));
  if (target.is_stream) throw Failure(Error::Kind::io, file, "is a device or a pipe; only a file can hold this");
  return std::move(target.file);
}

Descriptor open_stream(const std::filesystem::path& stream) {
  const int number = open_file_number(stream);
  // A copy goes on where the open file stands; opened anew it would start at its beginning.
  if (number >= 0) {
    Descriptor copy(::fcntl(number, F_DUPFD_CLOEXEC, 0));
    if (!copy) throw Failure(Error::Kind::io, stream, "can't be written: " + system_message(errno));
    return copy;
  }
  constexpr int kMostTries = 1000;
  for (int tries = 1;; ++tries) {
    Descriptor opened(::open(stream.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    if (opened) {
      ::fcntl(opened.get(), F_SETFL, ::fcntl(opened.get(), F_GETFL) & ~O_NONBLOCK);
      return opened;
    }
    const int error = errno;
    std::error_code ignored;
    if (error != ENXIO || !std::filesystem::is_fifo(stream, ignored)) {
      throw Failure(Error::Kind::io, stream, "can't be written: " + system_message(error));
    }
    if (tries == kMostTries) throw Failure(Error::Kind::io, stream, "can't be written: no process reads from it");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
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

bool is_there(const std::filesystem::path& path) {
  std::error_code error;
  const bool found = std::filesystem::exists(path, error);
  if (error) throw Failure(Error::Kind::io, path, "can't be read: " + error.message());
  return found;
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

OutputFile::OutputFile(const std::filesystem::path& file) : file_(file), target_(take(output_target(file))) {
  if (target_.is_stream) {
    fd_ = open_stream(target_.file);
  } else {
    fd_ = Descriptor(::open(unfinished_name(target_.file).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (!fd_) throw Failure(Error::Kind::io, file_, "can't be written: " + system_message(errno));
  }
  buffer_.reserve(kBufferBytes);
}

OutputFile::~OutputFile() {
  if (fd_ && !target_.is_stream) ::unlink(unfinished_name(target_.file).c_str());
}

void OutputFile::put(std::string_view bytes) {
  const int error = target_.is_stream ? write_on(fd_.get(), bytes.data(), bytes.size())
                                      : write_at(fd_.get(), bytes.data(), bytes.size(), written_);
  if (error) throw Failure(Error::Kind::io, file_, "can't be written: " + system_message(error));
  written_ += bytes.size();
}

void OutputFile::flush() {
  put(buffer_);
  buffer_.clear();
}

void OutputFile::write(std::string_view bytes) {
  HOOKE_ASSERT(fd_, file_.string());
  if (buffer_.size() + bytes.size() >= kBufferBytes) flush();
  if (bytes.size() >= kBufferBytes) {
    put(bytes);
  } else {
    buffer_ += bytes;
  }
}

void OutputFile::finish() {
  HOOKE_ASSERT(fd_, file_.string());
  flush();
  if (!target_.is_stream) publish(target_.file);
  fd_ = Descriptor();
}

void append_number(std::string& text, float value) { append_shortest(text, value); }
void append_number(std::string& text, double value) { append_shortest(text, value); }
void append_number(std::string& text, std::int64_t value) { append_shortest(text, value); }
void append_number(std::string& text, std::uint64_t value) { append_shortest(text, value); }

}  // namespace hooke::io
