// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "hooke/base/expected.h"
#include "hooke/core/scene.h"
#include "hooke/core/snapshot.h"
#include "hooke/render/camera.h"
#include "hooke/render/film.h"
#include "hooke/render/image.h"
#include "hooke/scene/json_reader.h"

namespace hooke::view {

/// The first of "NAME-001.png", "NAME-002.png" ... in the working folder that is not there yet, nor its scene.
std::filesystem::path next_file(const std::string& name, const std::string& extension);

/// Writes a picture, and beside it, as FILE.json, the scene that made it.
Expected<void> write_still(const std::filesystem::path& file, const render::Image& image, const scene::Json& scene);
/// Writes the text of a scene.
Expected<void> write_scene(const std::filesystem::path& file, const scene::Json& scene);

/// A picture as films show it, drawn on another thread, which may take seconds.
struct FilmLook {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const Snapshot> snapshot;
  render::Camera camera;  ///< in metres
  int width = 1280, height = 720;
};
Expected<render::Image> draw_film_look(const FilmLook& look, const ParticleSet& first);

/// Films what a window shows: a frame for each step of film time.
class WindowFilm {
 public:
  static constexpr double kFramesPerSecond = 30;

  /// Begins at `time` (s) of the simulation; `speed`: simulated seconds a second of film, > 0. The sizes are those of
  /// the window; a film's are even.
  static Expected<WindowFilm> begin(const std::filesystem::path& file, int width, int height, double time, double speed,
                                    const scene::Json& scene);
  /// Whether the state at `time` (s) is due.
  bool is_due(double time) const { return time >= next_; }
  /// How many steps of `dt` (s) there are from `time` to the next frame, at least one.
  std::int64_t steps_to_next(double time, double dt) const;
  /// Takes a picture of the window's size at the start; others are passed over.
  Expected<void> add(const render::Image& image);
  Expected<void> finish() { return writer_.finish(); }
  const std::filesystem::path& file() const { return writer_.file(); }
  std::int64_t frames() const { return writer_.frames(); }

 private:
  WindowFilm(render::FilmWriter writer, int width, int height, double time, double speed)
      : writer_(std::move(writer)),
        width_(width),
        height_(height),
        next_(time),
        interval_(speed / kFramesPerSecond) {}

  render::FilmWriter writer_;
  int width_, height_;  // pixels, even
  double next_, interval_;  // s of the simulation
};

}  // namespace hooke::view
