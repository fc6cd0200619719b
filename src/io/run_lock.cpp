// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/run_lock.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <string>

#include "hooke/io/failure.h"
#include "hooke/io/run_folder.h"

namespace hooke::io {

namespace {

namespace fs = std::filesystem;

/// Calls fcntl() for a lock on all of a file. Such a lock belongs to the opened file, not to the process, so that two
/// writers in one process exclude each other too.
int lock_call(int fd, int command, struct flock& lock) {
  lock = {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  return ::fcntl(fd, command, &lock);
}

[[noreturn]] void refuse(int fd, const fs::path& folder) {
  std::string process(32, '\0');
  if (read_at(fd, process.data(), process.size(), 0) != 0) process.clear();
  const auto digits_end =
      std::find_if_not(process.begin(), process.end(), [](unsigned char c) { return std::isdigit(c); });
  process.erase(digits_end, process.end());
  throw Failure(Error::Kind::bad_input, folder,
                "is being written by " + (process.empty() ? "another process" : "process " + process) +
                    ": wait for its end, or name another folder");
}

/// Whether `name` still is the open file: the last writer removes its file when it ends.
bool is_same_file(int fd, const fs::path& name) {
  struct stat opened{}, named{};
  return ::fstat(fd, &opened) == 0 && ::stat(name.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

}  // namespace

RunLock::RunLock(const fs::path& folder) : file_(folder / kLockFile) {
  constexpr int kMostTries = 100;  // each try but the last finds a file that its writer has just removed
  for (int tries = 0; tries == 0 || (tries < kMostTries && !is_same_file(fd_.get(), file_)); ++tries) {
    fd_ = Descriptor(::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (!fd_) throw Failure(Error::Kind::io, file_, "can't be written: " + system_message(errno));
    struct flock lock{};
    if (lock_call(fd_.get(), F_OFD_SETLK, lock) != 0 && (errno == EAGAIN || errno == EACCES)) refuse(fd_.get(), folder);
  }
  // What the file says is only for the message of another process.
  const std::string process = std::to_string(::getpid()) + '\n';
  [[maybe_unused]] const bool named =
      ::ftruncate(fd_.get(), 0) == 0 && write_at(fd_.get(), process.data(), process.size(), 0) == 0;
}

RunLock::~RunLock() {
  if (fd_) ::unlink(file_.c_str());  // before the lock ends: then no other process has the file
}

void refuse_if_written(const fs::path& folder) {
  const Descriptor file(::open((folder / kLockFile).c_str(), O_RDONLY | O_CLOEXEC));
  struct flock lock{};
  if (file && lock_call(file.get(), F_OFD_GETLK, lock) == 0 && lock.l_type != F_UNLCK) refuse(file.get(), folder);
}

}  // namespace hooke::io
