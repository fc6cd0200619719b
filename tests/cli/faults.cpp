// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// A library to be loaded before the others, by LD_PRELOAD: lets one call of the operating system fail.
//   HOOKE_FAULT=CALL:N:ERRNO   the N-th call, from 1 on, fails with this errno and does nothing
//   HOOKE_FAULT_COUNT=FILE     at exit, the number of calls of each kind is written there, a line a kind
// CALL is one of the names below. The C library has two names for some of them: both count as one.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

enum Call : std::size_t { kPread, kPwrite, kFsync, kRename, kUnlink, kTruncate, kCalls };
constexpr std::array<const char*, kCalls> kNames{"pread", "pwrite", "fsync", "rename", "unlink", "ftruncate"};

struct Faults {
  std::size_t call = kCalls;  // none
  long at = 0;
  int error = 0;
  std::array<std::atomic<long>, kCalls> count{};

  Faults() {
    char name[32] = "";
    const char* text = std::getenv("HOOKE_FAULT");
    if (text == nullptr || std::sscanf(text, "%31[a-z]:%ld:%d", name, &at, &error) != 3) return;
    for (std::size_t k = 0; k < kCalls; ++k) {
      if (std::strcmp(name, kNames[k]) == 0) call = k;
    }
  }
  ~Faults() {
    const char* file = std::getenv("HOOKE_FAULT_COUNT");
    std::FILE* out = file != nullptr ? std::fopen(file, "w") : nullptr;
    if (out == nullptr) return;
    for (std::size_t k = 0; k < kCalls; ++k) std::fprintf(out, "%s %ld\n", kNames[k], count[k].load());
    std::fclose(out);
  }

  /// Whether this call is to fail; then errno is set.
  bool hit(Call which) {
    if (++count[which] != at || which != call) return false;
    errno = error;
    return true;
  }
};

Faults& faults() {
  static Faults all;
  return all;
}

/// The C library's own function of this name.
template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

#pragma GCC visibility push(default)
extern "C" {

ssize_t pread64(int fd, void* data, size_t size, off64_t offset) {
  static auto* const next = real<ssize_t(int, void*, size_t, off64_t)>("pread64");
  return faults().hit(kPread) ? -1 : next(fd, data, size, offset);
}
ssize_t pread(int fd, void* data, size_t size, off_t offset) { return pread64(fd, data, size, offset); }

ssize_t pwrite64(int fd, const void* data, size_t size, off64_t offset) {
  static auto* const next = real<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
  return faults().hit(kPwrite) ? -1 : next(fd, data, size, offset);
}
ssize_t pwrite(int fd, const void* data, size_t size, off_t offset) { return pwrite64(fd, data, size, offset); }

int fsync(int fd) {
  static auto* const next = real<int(int)>("fsync");
  return faults().hit(kFsync) ? -1 : next(fd);
}

int rename(const char* from, const char* to) noexcept {
  static auto* const next = real<int(const char*, const char*)>("rename");
  return faults().hit(kRename) ? -1 : next(from, to);
}

int unlink(const char* file) noexcept {
  static auto* const next = real<int(const char*)>("unlink");
  return faults().hit(kUnlink) ? -1 : next(file);
}

int ftruncate64(int fd, off64_t size) noexcept {
  static auto* const next = real<int(int, off64_t)>("ftruncate64");
  return faults().hit(kTruncate) ? -1 : next(fd, size);
}
int ftruncate(int fd, off_t size) noexcept { return ftruncate64(fd, size); }

}  // extern "C"
#pragma GCC visibility pop
