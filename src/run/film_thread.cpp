// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/film_thread.h"

#include <cmath>
#include <condition_variable>
#include <deque>
#include <exception>
#include <future>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <utility>

#include "hooke/base/assert.h"
#include "hooke/render/film.h"
#include "hooke/render/interpolate.h"
#include "hooke/run/studio.h"

namespace hooke::run {

struct FilmThread::Impl {
  struct Shot {
    std::shared_ptr<const Snapshot> state;
    double late = 0;  // s after the frame's time
    double time = 0;  // of the frame, s
  };
  static constexpr std::size_t kMostWaiting = 2;

  std::filesystem::path file;
  PictureArguments picture;
  OnFailure on_failure;
  Scene scene;
  std::int64_t next_frame = 0;  // its time is next_frame * seconds_a_frame()

  std::mutex mutex;
  std::condition_variable changed;
  std::deque<Shot> waiting;
  bool ending = false;
  std::optional<Error> error;  // if set, nothing more is drawn
  Summary summary;
  std::thread thread;

  double time_of(std::int64_t frame) const { return static_cast<double>(frame) * picture.seconds_a_frame(); }

  // Runs in the film's own thread: OpenGL belongs to the thread that opened it.
  void run(std::shared_ptr<const Snapshot> first, std::promise<Expected<void>> started) {
    std::optional<Studio> studio;
    try {
      auto opened = Studio::open(picture);
      if (!opened) return started.set_value(fail(std::move(opened).error()));
      studio = std::move(*opened);
      studio->set_scene(scene, first->particles);
      first.reset();
    } catch (const std::exception& fault) {
      return started.set_value(fail(error_of(fault)));
    }
    started.set_value({});
    try {
      draw(*studio);
    } catch (const std::exception& fault) {
      give_up(error_of(fault));
    }
  }

  Error error_of(const std::exception& fault) const {
    const bool no_memory = dynamic_cast<const std::bad_alloc*>(&fault) != nullptr;
    return {Error::Kind::io, {{file.string(), no_memory ? "there is not enough memory for it" : fault.what()}}};
  }

  void draw(Studio& studio) {
    // The first frame opens the file, so that a run that fails to start leaves an older film alone.
    std::optional<render::FilmWriter> film;
    double seconds = 0;
    while (std::optional<Shot> shot = take()) {
      if (!film) {
        auto opened = render::FilmWriter::create(file, {picture.width, picture.height, picture.frames_per_second});
        if (!opened) return give_up(std::move(opened).error());
        film = std::move(*opened);
      }
      const ParticleSet& particles = shot->state->particles;
      auto image = shot->late > 0 ? studio.picture(render::drawn_back(scene, particles, shot->late), shot->time)
                                  : studio.picture(particles, shot->time);
      seconds += studio.figures().total_seconds;
      auto added = image ? film->add(*image) : Expected<void>(fail(std::move(image).error()));
      if (!added) return give_up(std::move(added).error());
    }
    if (!film) return;
    if (auto finished = film->finish(); !finished) return give_up(std::move(finished).error());
    const std::lock_guard lock(mutex);
    summary = {film->frames(), seconds / static_cast<double>(film->frames())};
  }

  // The next shot; empty when the film is to end.
  std::optional<Shot> take() {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return ending || !waiting.empty(); });
    if (waiting.empty()) return {};
    Shot shot = std::move(waiting.front());
    waiting.pop_front();
    changed.notify_all();
    return shot;
  }

  void give_up(Error why) {
    if (on_failure) on_failure(why);
    const std::lock_guard lock(mutex);
    error = std::move(why);
    waiting.clear();
    changed.notify_all();
  }

  void end() {
    {
      const std::lock_guard lock(mutex);
      ending = true;
      changed.notify_all();
    }
    if (thread.joinable()) thread.join();
  }
};

Expected<std::unique_ptr<FilmThread>> FilmThread::start(const std::filesystem::path& file,
                                                        const PictureArguments& picture, const Simulation& simulation,
                                                        OnFailure on_failure) {
  HOOKE_ASSERT(picture.frames_per_second > 0, picture.frames_per_second);
  auto impl = std::make_unique<Impl>();
  impl->file = file;
  impl->picture = picture;
  impl->on_failure = std::move(on_failure);
  impl->scene = simulation.scene();
  impl->next_frame = static_cast<std::int64_t>(std::ceil(simulation.time() / picture.seconds_a_frame() - 1e-6));
  std::promise<Expected<void>> started;
  auto outcome = started.get_future();
  impl->thread = std::thread([&impl = *impl, first = simulation.snapshot(), started = std::move(started)]() mutable {
    impl.run(std::move(first), std::move(started));
  });
  if (auto good = outcome.get(); !good) {
    impl->thread.join();
    return fail(std::move(good).error());
  }
  return std::unique_ptr<FilmThread>(new FilmThread(std::move(impl)));
}

FilmThread::FilmThread(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

FilmThread::~FilmThread() { impl_->end(); }

bool FilmThread::is_due(double time) const { return impl_->time_of(impl_->next_frame) <= time + 1e-9; }

void FilmThread::show(const std::shared_ptr<const Snapshot>& now) {
  HOOKE_ASSERT(!impl_->ending);
  for (const double time = now->time; is_due(time); ++impl_->next_frame) {
    const double frame_time = impl_->time_of(impl_->next_frame);
    std::unique_lock lock(impl_->mutex);
    impl_->changed.wait(lock, [&] { return impl_->error || impl_->waiting.size() < Impl::kMostWaiting; });
    if (impl_->error) continue;  // the film has failed; the run does not wait for its frames
    impl_->waiting.push_back({now, std::max(0.0, time - frame_time), frame_time});
    impl_->changed.notify_all();
  }
}

Expected<FilmThread::Summary> FilmThread::finish() {
  impl_->end();
  if (impl_->error) return fail(*impl_->error);
  return impl_->summary;
}

}  // namespace hooke::run
