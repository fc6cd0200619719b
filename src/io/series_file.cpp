// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/series_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <string>
#include <string_view>

#include "hooke/base/assert.h"
#include "hooke/io/failure.h"

namespace hooke::io {

namespace {

void write_whole(const std::filesystem::path& path, std::string_view text) {
  OutputFile out(path);
  out.write(text);
  out.finish();
}

std::string read_whole(const std::filesystem::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  const auto give_up = [&](int error) {
    throw Failure(Error::Kind::io, path, "can't be read: " + system_message(error));
  };
  if (!file) give_up(errno);
  std::string text(size_of(file.get(), path), '\0');
  if (const int error = read_at(file.get(), text.data(), text.size(), 0)) give_up(error);
  return text;
}

}  // namespace

SeriesFile::SeriesFile(const std::filesystem::path& path)
    : path_(path),
      fd_(::open(path.c_str(), O_WRONLY | O_CLOEXEC)) {
  if (!fd_) throw Failure(Error::Kind::io, path, "can't be opened: " + system_message(errno));
  size_ = std::filesystem::file_size(path);
}

SeriesFile SeriesFile::create(const std::filesystem::path& path, const std::string& header) {
  write_whole(path, header + '\n');
  return SeriesFile(path);
}

SeriesFile SeriesFile::update(const std::filesystem::path& path, const std::string& header, std::int64_t end_step) {
  if (!is_there(path)) return create(path, header);
  const std::string text = read_whole(path);
  if (!text.starts_with(header + '\n')) {
    throw Failure(Error::Kind::bad_input, path, "can't be continued: it has not the columns of a series");
  }
  std::optional<std::int64_t> last_step;
  std::size_t end = header.size() + 1;
  for (;;) {
    const std::size_t line_end = text.find('\n', end);
    std::int64_t step = 0;
    if (line_end == std::string::npos ||
        std::from_chars(text.data() + end, text.data() + line_end, step).ec != std::errc() || step >= end_step) {
      break;
    }
    last_step = step;
    end = line_end + 1;
  }
  if (end != text.size()) write_whole(path, std::string_view(text).substr(0, end));
  SeriesFile file(path);
  file.last_step_ = last_step;
  return file;
}

void SeriesFile::append(const SeriesRow& row) {
  HOOKE_ASSERT(!last_step_ || row.step >= *last_step_, row.step, *last_step_);
  if (last_step_ && row.step == *last_step_) return;
  const std::string line = to_csv(row) + '\n';
  if (const int error = write_at(fd_.get(), line.data(), line.size(), size_)) {
    // Removes the part of a row that may have been written.
    [[maybe_unused]] const int ignored = ::ftruncate(fd_.get(), static_cast<off_t>(size_));
    throw Failure(Error::Kind::io, path_, "can't be written: " + system_message(error));
  }
  size_ += line.size();
  last_step_ = row.step;
}

void SeriesFile::sync() {
  if (::fsync(fd_.get()) != 0) throw Failure(Error::Kind::io, path_, "can't be written: " + system_message(errno));
}

}  // namespace hooke::io
