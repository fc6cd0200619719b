// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/particle_format.h"

#include <fmt/format.h>

namespace hooke::scene {

void go_to_frame(FileScanner& in, std::uint64_t frame, const std::function<bool()>& skip) {
  FileScanner::Place found = in.place();
  std::uint64_t frames = 0;
  while (frame == kLastFrame || frames <= frame) {
    const FileScanner::Place here = in.place();
    if (!skip()) break;
    found = here;
    ++frames;
  }
  if (frames == 0) throw FileFault(0, "is empty");
  if (frame != kLastFrame && frames <= frame) {
    throw FileFault(0, fmt::format("has no snapshot {}, counted from 0; it holds {}", frame, frames));
  }
  in.go_back(found);
}

void skip_rows(FileScanner& in, std::uint64_t count) {
  const std::uint64_t before = in.line_number();
  if (!in.skip_lines(count)) throw ends_early(in, in.line_number() - before, count);
}

FileFault ends_early(const FileScanner& in, std::uint64_t rows, std::uint64_t count) {
  return {in.line_number(), fmt::format("ends here, after {} of {} particles", rows, count)};
}

}  // namespace hooke::scene
