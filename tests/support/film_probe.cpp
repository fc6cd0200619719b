// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "support/film_probe.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace hooke::test {
namespace {

std::string output_of(const std::string& command) {
  std::string text;
  std::FILE* const pipe = popen(command.c_str(), "r");
  std::array<char, 4096> some;
  while (const std::size_t n = std::fread(some.data(), 1, some.size(), pipe)) text.append(some.data(), n);
  pclose(pipe);
  return text;
}

}  // namespace

FilmProbe probe_film(const std::filesystem::path& file) {
  std::istringstream lines(
      output_of("ffprobe -v error -count_frames -select_streams v:0 -of default=noprint_wrappers=1 -show_entries "
                "stream=width,height,avg_frame_rate,nb_read_frames:format=duration '" +
                file.string() + "' 2>&1"));
  FilmProbe probe;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t split = line.find('=');
    const std::string key = line.substr(0, split), value = split == std::string::npos ? "" : line.substr(split + 1);
    if (key == "width") {
      probe.width = std::atoi(value.c_str());
    } else if (key == "height") {
      probe.height = std::atoi(value.c_str());
    } else if (key == "nb_read_frames") {
      probe.frames = std::atoi(value.c_str());
    } else if (key == "avg_frame_rate") {
      const std::size_t slash = value.find('/');
      probe.frames_per_second = std::atof(value.c_str()) / std::atof(value.c_str() + slash + 1);
    } else if (key == "duration") {
      probe.seconds = std::atof(value.c_str());
    } else {
      probe.problem += line + "\n";
    }
  }
  return probe;
}

}  // namespace hooke::test
