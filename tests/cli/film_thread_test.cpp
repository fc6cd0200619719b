// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The thread that draws a film while a run goes on, without OpenGL: the library's thread and the program's log with
// a renderer of the test's own, so that a build with the thread sanitizer sees everything except ffmpeg.
#include "hooke/run/film_thread.h"

#include <gmock/gmock.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "backends/busy_scenes.h"
#include "hooke/render/interpolate.h"
#include "hooke/run/gl_loader.h"
#include "log.h"
#include "support/environment.h"
#include "support/film_probe.h"

namespace hooke::run {
namespace {

using test::EnvironmentVariable;
using testing::HasSubstr;

/// What the test's renderer should do, and what it was asked to draw. Safe for several threads.
class Stage {
 public:
  // Before the film starts:
  std::optional<Error> no_device;         ///< what opening the renderer says
  std::optional<std::size_t> last_frame;  ///< after so many frames, the next gives an error
  bool no_memory = false;                 ///< or throws
  std::chrono::milliseconds takes{0};     ///< time to draw a frame

  /// From now on frames wait until open() is called.
  void close() {
    const std::lock_guard lock(mutex_);
    open_ = false;
  }
  void open() {
    const std::lock_guard lock(mutex_);
    open_ = true;
    changed_.notify_all();
  }

  /// The centres of the spheres in each frame drawn so far, m.
  std::vector<std::vector<Vec3d>> drawn() const {
    const std::lock_guard lock(mutex_);
    return drawn_;
  }

  /// For the renderer: draws a frame, or fails.
  Expected<void> draw(std::vector<Vec3d> centres) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return open_; });
    if (last_frame && drawn_.size() >= *last_frame && no_memory) throw std::bad_alloc();
    if (last_frame && drawn_.size() >= *last_frame) return fail(Error::Kind::bad_input, "renderer", "lost its device");
    drawn_.push_back(std::move(centres));
    lock.unlock();
    std::this_thread::sleep_for(takes);
    return {};
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool open_ = true;
  std::vector<std::vector<Vec3d>> drawn_;
};

/// The stage of the running test.
Stage* stage = nullptr;

class PlainRenderer : public render::Renderer {
 public:
  explicit PlainRenderer(const render::RenderSettings& settings) : settings_(settings) {}

  Expected<render::Image> render(const render::Frame& frame) override {
    std::vector<Vec3d> centres;
    for (const render::Sphere& sphere : frame.spheres)
      centres.push_back(frame.origin + Vec3d{sphere.x, sphere.y, sphere.z});
    if (auto drawn = stage->draw(std::move(centres)); !drawn) return fail(std::move(drawn).error());
    figures_.spheres_drawn = frame.spheres.size();
    figures_.total_seconds = 0.25;
    return render::Image(settings_.width, settings_.height);
  }
  Expected<render::LinearImage> render_linear(const render::Frame&) override { return render::LinearImage(); }
  render::RenderFigures figures() const override { return figures_; }
  std::string device() const override { return "none"; }

 private:
  render::RenderSettings settings_;
  render::RenderFigures figures_;
};

}  // namespace

// Replaces the function that loads hooke-gl.so.
Expected<std::unique_ptr<render::Renderer>> load_gl_renderer(const render::RenderSettings& settings) {
  if (stage->no_device) return fail(*stage->no_device);
  return std::make_unique<PlainRenderer>(settings);
}

namespace {

/// The largest distance (m) between particles at the same index of two lists.
double largest_distance(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  double largest = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    const Vec3d between = a[i] - b[i];
    largest = std::max(largest, std::sqrt(dot(between, between)));
  }
  return largest;
}

Simulation block_that_falls_apart() {
  const Scene scene =
      test::busy_scene({Boundary::spring, Integrator::symplectic_euler, Precision::single_precision, true});
  return test::simulate(scene, test::busy_particles(scene), {"cpu", Precision::single_precision, 3, ""});
}

class FilmThreads : public testing::Test {
 protected:
  FilmThreads() {
    std::string pattern = (std::filesystem::temp_directory_path() / "hooke_film_thread_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    stage = &stage_;
    // As the program does: both the film and the run write into the log.
    cli::start_log(true);
    EXPECT_TRUE(cli::log_to_file(path("log.txt")));
  }
  ~FilmThreads() override {
    spdlog::set_default_logger(std::make_shared<spdlog::logger>("none"));  // closes the file
    stage = nullptr;
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  std::string log() const {
    std::ifstream in(path("log.txt"));
    return {std::istreambuf_iterator<char>(in), {}};
  }

  // A film with a frame every `steps_a_frame` steps.
  std::unique_ptr<FilmThread> start(double steps_a_frame) const {
    auto film = FilmThread::start(path("f.mp4"), picture(steps_a_frame), simulation_,
                                  [](const Error& why) { spdlog::error("the film ends here: {}", why.text()); });
    EXPECT_TRUE(film) << film.error().text();
    return film ? std::move(*film) : nullptr;
  }
  PictureArguments picture(double steps_a_frame) const {
    PictureArguments arguments;
    arguments.width = 64;
    arguments.height = 48;
    arguments.samples = 1;
    arguments.frames_per_second = 1 / (steps_a_frame * simulation_.scene().time_step);
    // Cairo and fontconfig draw text, and they are not built with the sanitizer.
    arguments.legend = false;
    return arguments;
  }

  // Steps as a run with a film does, with a line in the log every step.
  void run(FilmThread& film, int steps) {
    for (int k = 0; k < steps; ++k) {
      if (film.is_due(simulation_.time())) film.show(simulation_.snapshot());
      ASSERT_TRUE(test::advance(simulation_, 1));
      spdlog::info("step {}", simulation_.step_count());
    }
    if (film.is_due(simulation_.time())) film.show(simulation_.snapshot());
  }

  void expect_frames(int frames) const {
    const test::FilmProbe probe = test::probe_film(path("f.mp4"));
    EXPECT_EQ(probe.problem, "");
    EXPECT_EQ(probe.frames, frames);
  }

  Stage stage_;
  Simulation simulation_ = block_that_falls_apart();

 private:
  std::filesystem::path folder_;
};

// Frames every few steps, at times between steps, and several frames a step.
TEST_F(FilmThreads, EachFrameShowsItsMoment) {
  for (const double steps_a_frame : {2.0, 1.6, 0.4}) {
    SCOPED_TRACE(steps_a_frame);
    Stage of_its_own;
    stage = &of_its_own;
    simulation_ = block_that_falls_apart();
    const auto film = start(steps_a_frame);
    ASSERT_TRUE(film);
    std::vector<std::vector<Vec3d>> expected;
    const double dt = simulation_.scene().time_step;
    for (int step = 0; step <= 8; ++step) {
      while (static_cast<double>(expected.size()) * steps_a_frame <= step + 1e-6) {
        const double late = (step - static_cast<double>(expected.size()) * steps_a_frame) * dt;
        expected.push_back(
            render::drawn_back(simulation_.scene(), simulation_.particles(), std::max(0.0, late)).position);
      }
      if (film->is_due(simulation_.time())) film->show(simulation_.snapshot());
      ASSERT_TRUE(test::advance(simulation_, 1));
    }
    const auto summary = film->finish();
    ASSERT_TRUE(summary) << summary.error().text();
    EXPECT_EQ(summary->frames, static_cast<std::int64_t>(expected.size()));
    EXPECT_DOUBLE_EQ(summary->seconds_a_frame, 0.25);
    expect_frames(static_cast<int>(expected.size()));
    const auto drawn = of_its_own.drawn();
    ASSERT_EQ(drawn.size(), expected.size());
    for (std::size_t k = 0; k < drawn.size(); ++k) {
      EXPECT_LT(largest_distance(drawn[k], expected[k]), 1e-5) << k;
      if (k == 0) continue;
      EXPECT_GT(largest_distance(expected[k], expected[k - 1]), 1e-4) << "frames can't be told apart";
    }
  }
}

TEST_F(FilmThreads, TheRunIsTheSameWithAFilm) {
  const auto film = start(1);
  ASSERT_TRUE(film);
  run(*film, 12);
  ASSERT_TRUE(film->finish());
  Simulation alone = block_that_falls_apart();
  ASSERT_TRUE(test::advance(alone, 12));
  EXPECT_EQ(simulation_.state_hash(), alone.state_hash());
}

// One frame is being drawn, two wait: the caller of a fourth has to wait.
TEST_F(FilmThreads, ASlowRendererMakesTheRunWait) {
  stage_.close();
  const auto film = start(1);
  ASSERT_TRUE(film);
  std::atomic<int> shown{0};
  std::thread runs([&] {
    for (int step = 0; step < 8; ++step) {
      film->show(simulation_.snapshot());
      ++shown;
      ASSERT_TRUE(test::advance(simulation_, 1));
    }
  });
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (shown < 3 && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(shown, 3);
  EXPECT_TRUE(stage_.drawn().empty());
  stage_.open();
  runs.join();
  EXPECT_EQ(film->finish()->frames, 8);
  expect_frames(8);
}

TEST_F(FilmThreads, EndsWithoutAFinish) {
  stage_.takes = std::chrono::milliseconds(20);  // so that two frames wait at the end
  {
    const auto film = start(1);
    ASSERT_TRUE(film);
    run(*film, 5);
  }
  expect_frames(6);
}

TEST_F(FilmThreads, AFilmOfNothingLeavesNoFile) {
  { const auto film = start(1); }
  const auto film = start(1);
  ASSERT_TRUE(film);
  const auto summary = film->finish();
  ASSERT_TRUE(summary) << summary.error().text();
  EXPECT_EQ(summary->frames, 0);
  EXPECT_FALSE(std::filesystem::exists(path("f.mp4")));
}

TEST_F(FilmThreads, WithoutARendererThereIsNoFilm) {
  stage_.no_device = Error{Error::Kind::bad_input, {{"OpenGL", "is nowhere"}}};
  const auto film = FilmThread::start(path("f.mp4"), picture(1), simulation_);
  ASSERT_FALSE(film);
  EXPECT_EQ(film.error().text(), "OpenGL: is nowhere");
  EXPECT_FALSE(std::filesystem::exists(path("f.mp4")));
}

TEST_F(FilmThreads, WithoutMemoryTheFilmEndsNotTheRun) {
  stage_.last_frame = 2;
  stage_.no_memory = true;
  const auto film = start(1);
  ASSERT_TRUE(film);
  run(*film, 12);
  const auto summary = film->finish();
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().text(), path("f.mp4").string() + ": there is not enough memory for it");
}

TEST_F(FilmThreads, AFrameThatCanNotBeDrawnEndsTheFilmNotTheRun) {
  stage_.last_frame = 4;
  const auto film = start(1);
  ASSERT_TRUE(film);
  run(*film, 12);
  EXPECT_EQ(simulation_.step_count(), 12);
  for (int tries = 0; tries < 2; ++tries) {
    const auto summary = film->finish();
    ASSERT_FALSE(summary);
    EXPECT_EQ(summary.error().text(), "renderer: lost its device");
  }
  expect_frames(4);
  EXPECT_THAT(log(), HasSubstr("error: the film ends here: renderer: lost its device\n"));
  EXPECT_THAT(log(), HasSubstr("info: step 12\n"));
}

TEST_F(FilmThreads, AMissingFfmpegEndsTheFilmNotTheRun) {
  const EnvironmentVariable nowhere("PATH", path("").string());
  const auto film = start(1);
  ASSERT_TRUE(film);
  run(*film, 10);
  EXPECT_EQ(simulation_.step_count(), 10);
  const auto summary = film->finish();
  ASSERT_FALSE(summary);
  EXPECT_THAT(summary.error().text(), HasSubstr("ffmpeg: is not installed"));
  EXPECT_THAT(log(), HasSubstr("the film ends here: ffmpeg: is not installed"));
  EXPECT_FALSE(std::filesystem::exists(path("f.mp4")));
}

TEST_F(FilmThreads, AnFfmpegThatDiesEndsTheFilmNotTheRun) {
  // Reads three and a half frames, then fails.
  std::ofstream(path("ffmpeg")) << "#!/bin/sh\ncase \"$*\" in *-version*) exit 0;; esac\n"
                                   "head -c 43008 >/dev/null\necho 'out of ink' >&2\nexit 1\n";
  std::filesystem::permissions(path("ffmpeg"), std::filesystem::perms::owner_all);
  const EnvironmentVariable first(
      "PATH", path("").string() + ":" + (std::getenv("PATH") == nullptr ? "" : std::getenv("PATH")));
  const auto film = start(1);
  ASSERT_TRUE(film);
  run(*film, 30);
  EXPECT_EQ(simulation_.step_count(), 30);
  const auto summary = film->finish();
  ASSERT_FALSE(summary);
  EXPECT_THAT(summary.error().text(), HasSubstr("ffmpeg stopped: out of ink"));
  EXPECT_THAT(log(), HasSubstr("the film ends here: " + summary.error().text()));
}

}  // namespace
}  // namespace hooke::run
