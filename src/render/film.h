// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "hooke/base/expected.h"
#include "hooke/render/image.h"

namespace hooke::render {

/// Whether the extension of `file`, in either case, is that of a film.
bool is_film(const std::filesystem::path& file);
/// The extensions of films: ".mp4, ...".
std::string film_extensions();

struct FilmSettings {
  int width = 1280;               ///< pixels, even
  int height = 720;               ///< pixels, even
  double frames_per_second = 30;  ///< > 0
};

/// bad_input where a film can't be made: `file` has no film's extension, the sizes are odd, or there is no ffmpeg.
Expected<void> check_film(const std::filesystem::path& file, const FilmSettings& settings);

/// Writes images into a film, through a pipe to the program ffmpeg. Not thread-safe.
class FilmWriter {
 public:
  /// bad_input where check_film() says so or the file can't be written.
  static Expected<FilmWriter> create(const std::filesystem::path& file, const FilmSettings& settings);

  /// Without finish() before, closes the film after the images added so far. Without any image, removes the file.
  ~FilmWriter();
  FilmWriter(FilmWriter&&) noexcept;
  FilmWriter& operator=(FilmWriter&&) noexcept;

  /// Adds the next frame, of the film's size. io with ffmpeg's words where ffmpeg has stopped (a full disk). Whatever
  /// happens later, even if this program is killed, the file plays up to about the frames added so far.
  Expected<void> add(const Image& image);
  /// Ends the file; no frame may be added after this call. bad_input where no frame was added.
  Expected<void> finish();

  std::int64_t frames() const;  ///< added so far
  const std::filesystem::path& file() const;

 private:
  struct Impl;
  explicit FilmWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace hooke::render
