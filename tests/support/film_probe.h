// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace hooke::test {

/// What ffprobe finds in a film when it decodes all of it.
struct FilmProbe {
  int frames = 0;
  int width = 0, height = 0;      ///< pixels
  double frames_per_second = 0;
  double seconds = 0;             ///< 0 where the file does not say
  std::string problem;            ///< ffprobe's complaints; empty for a sound file
};
FilmProbe probe_film(const std::filesystem::path& file);

}  // namespace hooke::test
