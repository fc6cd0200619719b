// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <chrono>
#include <cmath>
#include <system_error>

#include "stills.h"
#include "viewer.h"

namespace hooke::view {

std::string Viewer::output_name() const { return session_.options().scene.file.stem().string(); }

void Viewer::save_still() { still_wanted_ = next_file(output_name(), ".png"); }

// What belongs to a picture just drawn, before the panels cover it.
void Viewer::capture() {
  if (!still_wanted_ && !film_) return;
  if (!still_wanted_ && film_ && !(frame_ && film_->is_due(frame_->time - 1e-9 * scene_->time_step))) return;
  const render::Image image = render::LiveRenderer::read_window(window_.width(), window_.height());
  if (still_wanted_) {
    const auto written = write_still(*still_wanted_, image, session_.text_to_save());
    show_message(written ? "saved " + still_wanted_->string() + ", and its scene" : written.error().text());
    still_wanted_.reset();
  }
  if (film_ && frame_ && film_->is_due(frame_->time - 1e-9 * scene_->time_step)) {
    if (const auto added = film_->add(image); !added) {
      show_message(added.error().text());
      end_film();
    }
  }
}

void Viewer::toggle_film() {
  if (film_) return end_film();
  const double speed = std::isfinite(session_.speed()) ? session_.speed() : 1;
  auto film = WindowFilm::begin(next_file(output_name(), ".mp4"), window_.width(), window_.height(),
                                session_.readings().time, speed, session_.text_to_save());
  if (!film) return show_message(film.error().text());
  film_.emplace(std::move(*film));
  film_runs_ = session_.runs();
  session_.run(false);
  show_message("filming " + film_->file().string() + ": one second of it is " +
               (speed == 1 ? "one second of the scene" : std::to_string(speed) + " s of the scene"));
}

// While a film is made the engine waits for its pictures, so that none is missing.
void Viewer::step_film() {
  if (!film_) return;
  if (session_.runs()) {  // the space bar
    film_runs_ = !film_runs_;
    session_.run(false);
  }
  const Readings now = session_.readings();
  if (!now.failure.empty()) film_runs_ = false;
  if (!film_runs_ || !session_.is_idle() || !frame_ || frame_->steps != now.steps) return;
  if (film_->is_due(now.time - 1e-9 * now.time_step)) return;  // its picture comes first
  session_.step(film_->steps_to_next(now.time, now.time_step));
}

void Viewer::end_film() {
  const std::string file = film_->file().string();
  const std::int64_t frames = film_->frames();
  const auto finished = film_->finish();
  film_.reset();
  show_message(finished ? "saved " + file + " with " + std::to_string(frames) + " frames, and its scene"
                        : finished.error().text());
  session_.run(film_runs_);
}

void Viewer::save_film_still() {
  if (film_still_.valid()) return show_message("a picture is still being drawn");
  FilmLook look{scene_, session_.snapshot(), camera_->camera(), window_.width(), window_.height()};
  film_still_ = std::async(std::launch::async, [look = std::move(look), &first = session_.first_particles()] {
    return draw_film_look(look, first);
  });
  show_message("drawing with the look of films");
}

void Viewer::finish_film_still() {
  using namespace std::chrono_literals;
  if (!film_still_.valid() || film_still_.wait_for(0s) != std::future_status::ready) return;
  const Expected<render::Image> image = film_still_.get();
  if (!image) return show_message(image.error().text());
  const std::filesystem::path file = next_file(output_name(), ".png");
  const auto written = write_still(file, *image, session_.text_to_save());
  show_message(written ? "saved " + file.string() + ", and its scene" : written.error().text());
}

std::filesystem::path Viewer::next_checkpoint() const { return next_file(output_name(), ".h5"); }

void Viewer::load_checkpoint(const std::filesystem::path& file) {
  if (file.empty()) return show_message("type the name of a checkpoint first");
  std::error_code ignored;
  session_.act(LoadCheckpoint{std::filesystem::absolute(file, ignored).string()});
}

void Viewer::save_scene() {
  const std::filesystem::path file = next_file(output_name() + "-scene", ".json");
  const auto written = write_scene(file, session_.text_to_save());
  show_message(written ? "saved " + file.string() : written.error().text());
}

}  // namespace hooke::view
