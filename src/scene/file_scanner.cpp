// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/file_scanner.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "hooke/base/assert.h"

namespace hooke {

FileScanner::FileScanner(const std::filesystem::path& file) : buffer_(kLongestLine + 2) {
  std::error_code fault;
  if (std::filesystem::is_directory(file, fault)) throw FileFault(0, "can't be read: it is a folder");
  file_.reset(std::fopen(file.c_str(), "rb"));
  if (!file_) throw FileFault(0, std::string("can't be opened: ") + std::strerror(errno));
  // buffer_ is the only buffer: a second one would only add a copy.
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  const auto size = std::filesystem::file_size(file, fault);
  if (!fault) size_ = size;
}

bool FileScanner::fetch(std::size_t count) {
  if (at_hand() >= count) return true;
  std::memmove(buffer_.data(), buffer_.data() + begin_, at_hand());
  end_ -= begin_;
  begin_ = 0;
  end_ += std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, file_.get());
  if (std::ferror(file_.get()) != 0) throw FileFault(0, std::string("can't be read: ") + std::strerror(errno));
  return at_hand() >= count;
}

void FileScanner::pass(std::size_t count) {
  begin_ += count;
  place_.offset += count;
}

std::optional<std::string_view> FileScanner::line() {
  const auto find_end = [this](std::size_t from) {
    return static_cast<const char*>(std::memchr(buffer_.data() + begin_ + from, '\n', at_hand() - from));
  };
  const char* end = find_end(0);
  if (end == nullptr) {
    const std::size_t looked_at = at_hand();
    if (!fetch(buffer_.size()) && at_hand() == 0) return std::nullopt;
    end = find_end(looked_at);
  }
  ++place_.line;
  const char* start = buffer_.data() + begin_;
  const std::size_t length = end == nullptr ? at_hand() : static_cast<std::size_t>(end - start);
  if (length > kLongestLine) {
    throw FileFault(place_.line, "is longer than " + std::to_string(kLongestLine) + " bytes: no line of particles");
  }
  pass(length + (end == nullptr ? 0 : 1));
  std::string_view line(start, length);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
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
  const char* start = buffer_.data() + begin_;
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

}  // namespace hooke
