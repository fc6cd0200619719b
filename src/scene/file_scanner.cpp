// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/file_scanner.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "hooke/base/assert.h"
#include "hooke/scene/words.h"

namespace hooke::scene {

FileScanner::FileScanner(const std::filesystem::path& file)
    : buffer_(std::make_unique_for_overwrite<char[]>(kBufferSize)) {
  std::error_code fault;
  if (std::filesystem::is_directory(file, fault)) throw FileFault(0, "can't be read: it is a folder");
  file_.reset(std::fopen(file.c_str(), "rb"));
  if (!file_) throw FileFault(0, std::string("can't be opened: ") + std::strerror(errno));
  // buffer_ is the only buffer: a second one would only add a copy.
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  const auto size = std::filesystem::file_size(file, fault);
  if (!fault) size_ = size;
  pass_byte_order_mark();
}

bool FileScanner::fetch(std::size_t count) {
  if (at_hand() >= count) return true;
  std::memmove(buffer_.get(), buffer_.get() + begin_, at_hand());
  end_ -= begin_;
  begin_ = 0;
  end_ += std::fread(buffer_.get() + end_, 1, kBufferSize - end_, file_.get());
  if (std::ferror(file_.get()) != 0) throw FileFault(0, std::string("can't be read: ") + std::strerror(errno));
  return at_hand() >= count;
}

void FileScanner::pass(std::size_t count) {
  begin_ += count;
  place_.offset += count;
}

void FileScanner::pass_byte_order_mark() {
  constexpr std::size_t kMark = 3;  // bytes
  fetch(kMark);
  const std::string_view start(buffer_.get(), std::min(at_hand(), kMark));
  pass(start.size() - without_byte_order_mark(start).size());
  const std::string_view two = start.substr(0, 2);
  if (two == "\xff\xfe" || two == "\xfe\xff") throw FileFault(0, "is a text in UTF-16; must be in UTF-8");
}

const char* FileScanner::find_line_end(std::size_t from) const {
  const char* const start = buffer_.get() + begin_ + from;
  const std::size_t size = at_hand() - from;
  const auto* const lf = static_cast<const char*>(std::memchr(start, '\n', size));
  const std::size_t before = lf == nullptr ? size : static_cast<std::size_t>(lf - start);
  const auto* const cr = static_cast<const char*>(std::memchr(start, '\r', before));
  return cr == nullptr ? lf : cr;
}

std::size_t FileScanner::size_of_line_end(const char* end) {
  if (*end == '\n') return 1;
  const bool lf_follows = end + 1 < buffer_.get() + end_ && end[1] == '\n';
  if (!lone_cr_) lone_cr_ = !lf_follows;
  return lf_follows && !*lone_cr_ ? 2 : 1;
}

std::optional<std::string_view> FileScanner::line() {
  const char* end = find_line_end(0);
  // What follows a CR must be at hand, too.
  if (end == nullptr || end + 1 == buffer_.get() + end_) {
    const std::size_t looked_at = end == nullptr ? at_hand() : static_cast<std::size_t>(end - buffer_.get()) - begin_;
    if (!fetch(kBufferSize) && at_hand() == 0) return std::nullopt;
    end = find_line_end(looked_at);
  }
  ++place_.line;
  const char* const start = buffer_.get() + begin_;
  const std::size_t length = end == nullptr ? at_hand() : static_cast<std::size_t>(end - start);
  if (length > kLongestLine) {
    throw FileFault(place_.line, "is longer than " + std::to_string(kLongestLine) + " bytes: no line of particles");
  }
  const std::size_t end_size = end == nullptr ? 0 : size_of_line_end(end);
  if (!lone_cr_) lone_cr_ = false;
  pass(length + end_size);
  return std::string_view(start, length);
}

bool FileScanner::skip_lines(std::uint64_t count) {
  for (; count > 0; --count) {
    if (!line()) return false;
  }
  return true;
}

const char* FileScanner::bytes(std::size_t count) {
  HOOKE_ASSERT(count <= kLongestLine, count);
  if (!fetch(count)) return nullptr;
  const char* start = buffer_.get() + begin_;
  pass(count);
  return start;
}

bool FileScanner::skip_bytes(std::uint64_t count) {
  while (count > at_hand()) {
    count -= at_hand();
    pass(at_hand());
    if (!fetch(1)) return false;
  }
  pass(static_cast<std::size_t>(count));
  return true;
}

void FileScanner::go_back(const Place& place) {
  if (::fseeko(file_.get(), static_cast<off_t>(place.offset), SEEK_SET) != 0) {
    throw FileFault(0, std::string("can't be read: ") + std::strerror(errno));
  }
  begin_ = end_ = 0;
  place_ = place;
}

}  // namespace hooke::scene
