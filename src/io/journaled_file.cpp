// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/journaled_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/base/hash.h"
#include "hooke/io/failure.h"

namespace hooke::io {

namespace {

constexpr std::uint64_t kJournalMagic = 0x314c4e524a4b4f48;  // "HOKJRNL1", little endian

std::uint64_t checksum(const std::vector<std::uint64_t>& words, std::size_t count) {
  std::uint64_t hash = kJournalMagic;
  for (std::size_t i = 0; i < count; ++i) hash = combine64(hash, words[i]);
  return hash;
}

// A commit waits with its changes while a reader holds the file, but not for ever: a stopped reader must not stop a
// run. On file systems without locks it does not wait.
void lock_against_readers(int fd) {
  for (int tries = 0; tries < 100; ++tries) {
    if (::flock(fd, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

int open_flags(JournaledFile::Mode mode) {
  switch (mode) {
    case JournaledFile::Mode::read:
      return O_RDONLY;
    case JournaledFile::Mode::update:
      return O_RDWR;
    case JournaledFile::Mode::create:
      break;
  }
  return O_RDWR | O_CREAT | O_TRUNC;
}

}  // namespace

JournaledFile::JournaledFile(const std::filesystem::path& file, Mode mode)
    : file_(file),
      mode_(mode),
      fd_(::open(file.c_str(), open_flags(mode) | O_CLOEXEC, 0666)) {
  if (!fd_) {
    throw Failure(errno == ENOENT && mode == Mode::read ? Error::Kind::bad_input : Error::Kind::io, file,
                  "can't be opened: " + system_message(errno));
  }
  if (mode == Mode::create) return;
  if (mode == Mode::read) {
    ::flock(fd_.get(), LOCK_SH);
    load_journal();
  } else {
    lock_against_readers(fd_.get());
    const bool interrupted = load_journal();
    const int error = interrupted ? apply_pages() : remove_journal();
    if (error) throw Failure(Error::Kind::io, file, "can't be written: " + system_message(error));
    pages_.clear();
    ::flock(fd_.get(), LOCK_UN);
  }
  end_ = size();
  set_committed();
}

std::filesystem::path JournaledFile::journal_path() const {
  std::filesystem::path name = file_;
  name += ".journal";
  return name;
}

std::uint64_t JournaledFile::size() const {
  struct stat status{};
  std::uint64_t bytes = ::fstat(fd_.get(), &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
  if (!pages_.empty()) bytes = std::max(bytes, (pages_.rbegin()->first + 1) * kPageBytes);
  return bytes;
}

// A journal consists of words: magic, number of pages, each page's index and content, then the checksum of all these.
bool JournaledFile::load_journal() {
  const auto give_up = [&](int error_number) {
    throw Failure(Error::Kind::io, journal_path(), "can't be read: " + system_message(error_number));
  };
  const Descriptor journal(::open(journal_path().c_str(), O_RDONLY | O_CLOEXEC));
  if (!journal && errno == ENOENT) return false;
  if (!journal) give_up(errno);
  const auto bytes = static_cast<std::size_t>(size_of(journal.get(), journal_path()));
  constexpr std::size_t kEntryWords = 1 + kPageBytes / sizeof(std::uint64_t);
  constexpr std::size_t kOtherWords = 3;
  if (bytes < kOtherWords * sizeof(std::uint64_t) || bytes % sizeof(std::uint64_t) != 0) return false;
  std::vector<std::uint64_t> words(bytes / sizeof(std::uint64_t));
  if (const int error = read_at(journal.get(), words.data(), bytes, 0)) give_up(error);
  if (words[0] != kJournalMagic || (words.size() - kOtherWords) % kEntryWords != 0 ||
      words[1] != (words.size() - kOtherWords) / kEntryWords || words.back() != checksum(words, words.size() - 1)) {
    return false;
  }
  const std::uint64_t file_pages = size_of(fd_.get(), file_) / kPageBytes + 1;
  for (std::size_t i = 2; i + 1 < words.size(); i += kEntryWords) {
    if (words[i] >= file_pages)
      throw Failure(Error::Kind::bad_input, file_, "is cut short: its journal reaches beyond it");
    auto content = std::make_unique<Page>();
    std::memcpy(content->data(), &words[i + 1], kPageBytes);
    pages_[words[i]] = std::move(content);
  }
  return true;
}

int JournaledFile::write_journal() const {
  std::vector<std::uint64_t> words{kJournalMagic, pages_.size()};
  for (const auto& [index, content] : pages_) {
    words.push_back(index);
    const std::size_t at = words.size();
    words.resize(at + kPageBytes / sizeof(std::uint64_t));
    std::memcpy(&words[at], content->data(), kPageBytes);
  }
  words.push_back(checksum(words, words.size()));
  const Descriptor journal(::open(journal_path().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (!journal) return errno;
  return write_at(journal.get(), words.data(), words.size() * sizeof(std::uint64_t), 0);
}

int JournaledFile::apply_pages() const {
  for (const auto& [index, content] : pages_) {
    if (const int error = write_at(fd_.get(), content->data(), kPageBytes, index * kPageBytes)) return error;
  }
  return remove_journal();
}

// A journal of old pages must not stay, or it would be applied once more; an empty one is none.
int JournaledFile::remove_journal() const {
  if (::unlink(journal_path().c_str()) == 0 || errno == ENOENT) return 0;
  const int error = errno;
  return ::truncate(journal_path().c_str(), 0) == 0 ? 0 : error;
}

void JournaledFile::set_committed() {
  committed_end_ = end_;
  committed_pages_ = (end_ + kPageBytes - 1) / kPageBytes;
}

JournaledFile::Page& JournaledFile::page(std::uint64_t index) {
  std::unique_ptr<Page>& slot = pages_[index];
  if (!slot) {
    slot = std::make_unique<Page>();
    if (const int error = read_at(fd_.get(), slot->data(), kPageBytes, index * kPageBytes)) error_ = error;
  }
  return *slot;
}

int JournaledFile::read(std::uint64_t offset, void* data, std::size_t size) {
  if (const int error = read_at(fd_.get(), data, size, offset)) {
    if (read_error_ == 0) read_error_ = error;
    return error;
  }
  auto* out = static_cast<std::byte*>(data);
  for (auto it = pages_.lower_bound(offset / kPageBytes); it != pages_.end(); ++it) {
    const std::uint64_t begin = std::max(offset, it->first * kPageBytes);
    const std::uint64_t end = std::min(offset + size, (it->first + 1) * kPageBytes);
    if (begin >= end) break;
    std::memcpy(out + (begin - offset), it->second->data() + begin % kPageBytes, end - begin);
  }
  return 0;
}

void JournaledFile::write(std::uint64_t offset, const void* data, std::size_t size) {
  HOOKE_ASSERT(writable(), file_.string());
  const auto* in = static_cast<const std::byte*>(data);
  const std::uint64_t border = committed_pages_ * kPageBytes;
  while (size > 0 && error_ == 0 && offset < border) {
    const std::size_t n = std::min<std::size_t>(size, kPageBytes - offset % kPageBytes);
    std::memcpy(page(offset / kPageBytes).data() + offset % kPageBytes, in, n);
    in += n;
    offset += n;
    size -= n;
  }
  if (size > 0 && error_ == 0) error_ = write_at(fd_.get(), in, size, offset);
}

void JournaledFile::commit() {
  HOOKE_ASSERT(writable(), file_.string());
  const auto give_up = [&](int error_number) {
    error_ = error_number;
    throw Failure(Error::Kind::io, file_, "can't be written: " + system_message(error_number));
  };
  if (error_) give_up(error_);
  // Bytes allocated but not yet written must exist too: readers consider a shorter file damaged.
  if (size() < end_ && ::ftruncate(fd_.get(), static_cast<off_t>(end_)) != 0) give_up(errno);
  if (!pages_.empty()) {
    if (const int error = write_journal()) {
      remove_journal();
      give_up(error);
    }
  }
  set_committed();  // from here on the journal is what counts, even if its pages can't be applied now
  if (!pages_.empty()) {
    lock_against_readers(fd_.get());
    const int error = apply_pages();
    ::flock(fd_.get(), LOCK_UN);
    if (error) give_up(error);
    pages_.clear();
  }
}

void JournaledFile::trim() {
  // Best effort: leftover bytes only take space.
  if (writable()) [[maybe_unused]]
    const int ignored = ::ftruncate(fd_.get(), static_cast<off_t>(committed_end_));
}

void JournaledFile::sync() {
  if (::fsync(fd_.get()) != 0) {
    throw Failure(Error::Kind::io, file_, "can't be written: " + system_message(errno));
  }
}

}  // namespace hooke::io
