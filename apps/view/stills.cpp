// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "stills.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <system_error>

#include "hooke/render/frame.h"
#include "hooke/render/gl/gl_renderer.h"

namespace hooke::view {
namespace {

Expected<void> write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) return fail(Error::Kind::io, file.string(), "can't be written");
  return {};
}

std::filesystem::path beside(std::filesystem::path file) { return file.replace_extension(".json"); }

}  // namespace

std::filesystem::path next_file(const std::string& name, const std::string& extension) {
  std::error_code ignored;
  for (int number = 1;; ++number) {
    const std::filesystem::path file = fmt::format("{}-{:03}{}", name, number, extension);
    if (!std::filesystem::exists(file, ignored) && !std::filesystem::exists(beside(file), ignored)) return file;
  }
}

Expected<void> write_scene(const std::filesystem::path& file, const scene::Json& scene) {
  return write_text(file, scene::pretty(scene) + "\n");
}

Expected<void> write_still(const std::filesystem::path& file, const render::Image& image, const scene::Json& scene) {
  const auto png = render::encode_png(image);
  if (!png) return fail(png.error());
  if (auto written = write_text(file, *png); !written) return written;
  return write_scene(beside(file), scene);
}

Expected<render::Image> draw_film_look(const FilmLook& look, const ParticleSet& first) {
  auto renderer = render::make_gl_renderer({look.width, look.height, 2});
  if (!renderer) return fail(std::move(renderer).error());
  Scene scene = *look.scene;
  scene.camera.eye = look.camera.eye;
  scene.camera.target = look.camera.target;
  scene.camera.field_of_view = look.camera.field_of_view;
  scene.camera.orbit = 0;
  const double aspect = static_cast<double>(look.width) / look.height;
  const render::Frame frame = render::make_frame(scene, look.snapshot->particles, look.snapshot->time,
                                                 render::make_look(scene, first, render::ColorBy::material), aspect);
  return (*renderer)->render(frame);
}

Expected<WindowFilm> WindowFilm::begin(const std::filesystem::path& file, int width, int height, double time,
                                       double speed, const scene::Json& scene) {
  const int even_width = std::max(width & ~1, 2), even_height = std::max(height & ~1, 2);
  auto writer = render::FilmWriter::create(file, {even_width, even_height, kFramesPerSecond});
  if (!writer) return fail(std::move(writer).error());
  if (auto written = write_scene(beside(file), scene); !written) return fail(written.error());
  return WindowFilm(std::move(*writer), even_width, even_height, time, speed);
}

std::int64_t WindowFilm::steps_to_next(double time, double dt) const {
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil((next_ - time) / dt - 1e-9)));
}

Expected<void> WindowFilm::add(const render::Image& image) {
  next_ += interval_;
  if (image.width < width_ || image.height < height_) return {};
  render::Image cropped(width_, height_);
  for (int y = 0; y < height_; ++y) {
    std::copy_n(image.at(0, y), render::Image::kChannels * static_cast<std::size_t>(width_), cropped.at(0, y));
  }
  return writer_.add(cropped);
}

}  // namespace hooke::view
