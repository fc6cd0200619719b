// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// ffprobe reads films back.

#include "hooke/render/film.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "support/environment.h"
#include "support/film_probe.h"

namespace hooke {
namespace {

using testing::HasSubstr;

constexpr render::FilmSettings kSettings{64, 48, 25};

render::Image picture(int k) {
  render::Image image(kSettings.width, kSettings.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      image.at(x, y)[0] = static_cast<std::uint8_t>(x < k % image.width ? 230 : 20);
      image.at(x, y)[1] = static_cast<std::uint8_t>(4 * y);
      image.at(x, y)[2] = 90;
    }
  }
  return image;
}

class Film : public testing::Test {
 protected:
  Film() {
    std::string pattern = (std::filesystem::temp_directory_path() / "hooke_film_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~Film() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) names.push_back(entry.path().filename());
    return names;
  }

  static void add(render::FilmWriter& film, int count) {
    for (int k = 0; k < count; ++k) {
      const auto added = film.add(picture(k));
      ASSERT_TRUE(added) << added.error().text();
    }
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(Film, HoldsEveryFrameForAsLongAsItLasts) {
  for (const char* extension : {".mp4", ".mov", ".mkv", ".webm", ".gif", ".MP4"}) {
    SCOPED_TRACE(extension);
    const auto file = path(std::string("f") + extension);
    auto film = render::FilmWriter::create(file, kSettings);
    ASSERT_TRUE(film) << film.error().text();
    add(*film, 35);
    EXPECT_EQ(film->frames(), 35);
    const auto finished = film->finish();
    ASSERT_TRUE(finished) << finished.error().text();
    const test::FilmProbe probe = test::probe_film(file);
    EXPECT_EQ(probe.problem, "");
    EXPECT_EQ(probe.frames, 35);
    EXPECT_EQ(probe.width, kSettings.width);
    EXPECT_EQ(probe.height, kSettings.height);
    EXPECT_NEAR(probe.frames_per_second, 25, 0.01);
    EXPECT_NEAR(probe.seconds, 35 / 25.0, 1 / 25.0);
    EXPECT_EQ(files().size(), 1u) << testing::PrintToString(files());
    std::filesystem::remove(file);
  }
}

TEST_F(Film, AnyFrameRate) {
  for (const double rate : {0.5, 23.976, 60.0, 1000.0}) {
    auto film = render::FilmWriter::create(path("f.mp4"), {64, 48, rate});
    ASSERT_TRUE(film) << film.error().text();
    add(*film, 5);
    ASSERT_TRUE(film->finish());
    const test::FilmProbe probe = test::probe_film(path("f.mp4"));
    EXPECT_EQ(probe.frames, 5) << rate;
    EXPECT_NEAR(probe.frames_per_second, rate, 1e-3 * rate);
  }
}

TEST_F(Film, RefusesWhatIsNoFilm) {
  const auto refused = [&](const std::string& name, const render::FilmSettings& settings) {
    const auto checked = render::check_film(path(name), settings);
    EXPECT_FALSE(checked);
    const auto film = render::FilmWriter::create(path(name), settings);
    EXPECT_FALSE(film);
    EXPECT_EQ(film.error().kind, Error::Kind::bad_input);
    EXPECT_EQ(film.error().text(), checked.error().text());
    return film.error().text();
  };
  EXPECT_THAT(refused("f.avi", kSettings), HasSubstr("known are .mp4, .mov, .mkv, .webm, .gif"));
  EXPECT_THAT(refused("mp4", kSettings), HasSubstr("no extension of a film"));
  EXPECT_THAT(refused("f.mp4", {63, 48, 25}), HasSubstr("63x48 is not"));
  EXPECT_THAT(refused("f.mp4", {64, 47, 25}), HasSubstr("even"));
  EXPECT_TRUE(files().empty());
}

TEST_F(Film, SaysThatTheFileCanNotBeWritten) {
  const auto film = render::FilmWriter::create(path("nowhere/f.mp4"), kSettings);
  ASSERT_FALSE(film);
  EXPECT_EQ(film.error().kind, Error::Kind::bad_input);
  EXPECT_THAT(film.error().text(), HasSubstr("can't be written: No such file or directory"));
}

TEST_F(Film, SaysThatFfmpegIsMissing) {
  const test::EnvironmentVariable nowhere("PATH", path("").string());
  const auto film = render::FilmWriter::create(path("f.mp4"), kSettings);
  ASSERT_FALSE(film);
  EXPECT_EQ(film.error().kind, Error::Kind::bad_input);
  EXPECT_THAT(film.error().text(), HasSubstr("ffmpeg: is not installed"));
  EXPECT_TRUE(files().empty());
}

TEST_F(Film, AnImageOfAnotherSizeIsRefused) {
  auto film = render::FilmWriter::create(path("f.mp4"), kSettings);
  ASSERT_TRUE(film);
  add(*film, 3);
  EXPECT_FALSE(film->add(render::Image(64, 50)));
  EXPECT_EQ(film->frames(), 3);
  ASSERT_TRUE(film->finish());
  EXPECT_EQ(test::probe_film(path("f.mp4")).frames, 3);
}

TEST_F(Film, WithoutAFinishItPlaysToo) {
  {
    auto film = render::FilmWriter::create(path("f.mp4"), kSettings);
    ASSERT_TRUE(film);
    add(*film, 12);
  }
  EXPECT_EQ(test::probe_film(path("f.mp4")).frames, 12);
}

TEST_F(Film, WithoutAFrameThereIsNoFile) {
  {
    const auto film = render::FilmWriter::create(path("f.mp4"), kSettings);
    ASSERT_TRUE(film);
  }
  EXPECT_TRUE(files().empty());
  {
    auto film = render::FilmWriter::create(path("g.mp4"), kSettings);
    ASSERT_TRUE(film);
    const auto finished = film->finish();
    ASSERT_FALSE(finished);
    EXPECT_EQ(finished.error().kind, Error::Kind::bad_input);
    EXPECT_THAT(finished.error().text(), HasSubstr("no frame"));
  }
  EXPECT_TRUE(files().empty());
}

TEST_F(Film, AFullDiskIsAnError) {
  // /dev/full: every write fails as on a full disk.
  std::filesystem::create_symlink("/dev/full", path("f.mkv"));
  auto film = render::FilmWriter::create(path("f.mkv"), kSettings);
  ASSERT_TRUE(film) << film.error().text();
  Expected<void> good;
  for (int k = 0; k < 100 && good; ++k) good = film->add(picture(k));
  if (good) good = film->finish();
  ASSERT_FALSE(good);
  EXPECT_EQ(good.error().kind, Error::Kind::io);
  EXPECT_THAT(good.error().text(), HasSubstr("ffmpeg stopped: "));
  EXPECT_THAT(good.error().text(), HasSubstr("No space left on device"));
  EXPECT_THAT(good.error().text(), testing::Not(HasSubstr("\n")));
}

TEST_F(Film, AKillLeavesTheFramesAddedBefore) {
  constexpr int kFrames = 70;
  for (const char* name : {"f.mp4", "f.mov", "f.mkv"}) {
    const pid_t child = fork();
    if (child == 0) {
      auto film = render::FilmWriter::create(path(name), kSettings);
      for (int k = 0; film && k < kFrames; ++k) {
        if (!film->add(picture(k))) _exit(1);
      }
      raise(SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    // ffmpeg goes on writing for a moment.
    test::FilmProbe probe;
    for (int i = 0; i < 100 && probe.frames < kFrames; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      probe = test::probe_film(path(name));
    }
    EXPECT_EQ(probe.frames, kFrames) << name;
    EXPECT_EQ(probe.problem, "");
  }
}

TEST_F(Film, AMovedWriterGoesOn) {
  auto film = render::FilmWriter::create(path("f.mp4"), kSettings);
  ASSERT_TRUE(film);
  add(*film, 2);
  render::FilmWriter other = std::move(*film);
  add(other, 2);
  ASSERT_TRUE(other.finish());
  EXPECT_EQ(test::probe_film(path("f.mp4")).frames, 4);
}

}  // namespace
}  // namespace hooke
