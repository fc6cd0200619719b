// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Films that are drawn while a scene runs.

#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>

#include "hooke/render/image.h"
#include "program.h"
#include "support/environment.h"
#include "support/film_probe.h"
#include "support/similarity.h"

namespace hooke::test {
namespace {

using testing::HasSubstr;

using Words = std::vector<std::string>;

class FilmOfARun : public ProgramTest {
 protected:
  FilmOfARun() {
    use_software_gl();
    write("s.json", small_scene());
  }

  // 60 steps of 0.007 s: no frame after the first falls on a step.
  static Words run(const std::string& folder, const Words& more = {}) {
    Words words{"run", "s.json", "-o", folder, "--set", "time.step=0.007", "--steps", "60"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  static Words film(const std::string& file, const Words& more = {}) {
    Words words{"--film", file, "--size", "96x54", "--samples", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  // A line for each frame of a film, with a hash of its bytes.
  std::string frame_hashes(const std::string& file) const {
    const std::string command =
        "ffmpeg -v error -y -i '" + path(file).string() + "' -f framemd5 '" + path("hashes.txt").string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return read("hashes.txt");
  }

  render::Image frame(const std::string& file, int index) const {
    const std::string command = "ffmpeg -v error -y -i '" + path(file).string() + "' -vf 'select=eq(n\\," +
                                std::to_string(index) + ")' -frames:v 1 '" + path("frame.png").string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0);
    auto image = render::decode_png(read("frame.png"));
    return image ? std::move(*image) : render::Image();
  }
};

TEST_F(FilmOfARun, LastsAsLongAsTheRunAndChangesNothing) {
  hooke_ok(run("plain", {"--quiet"}));
  EXPECT_THAT(hooke_ok(run("filmed", film("f.mp4", {"--fps", "30"}))), HasSubstr("film of 13 frames, 0.43 s"));
  const FilmProbe probe = probe_film(path("f.mp4"));
  EXPECT_EQ(probe.problem, "");
  EXPECT_EQ(probe.frames, 13);  // at 0, 1/30, ... 12/30 s
  EXPECT_NEAR(probe.frames_per_second, 30, 1e-6);
  EXPECT_NEAR(probe.seconds, 0.42, 1.0 / 30);
  EXPECT_EQ(state_hash("filmed"), state_hash("plain"));
  EXPECT_EQ(export_all("filmed"), export_all("plain"));
}

TEST_F(FilmOfARun, MoreFramesThanStepsAndFewer) {
  hooke_ok(run("a", film("a.mp4", {"--fps", "400", "--quiet"})));
  EXPECT_EQ(probe_film(path("a.mp4")).frames, 169);  // 0.42 * 400 + 1
  hooke_ok(run("b", film("b.mp4", {"--fps", "2", "--quiet"})));
  EXPECT_EQ(probe_film(path("b.mp4")).frames, 1);
}

// With a camera of the scene's own: without, a film that is drawn afterwards knows more of what will happen.
TEST_F(FilmOfARun, ShowsWhatIsDrawnOfTheRunAfterwards) {
  hooke_ok(run("out", film("f.mp4", {"--quiet", "--set", "output.every_steps=1", "--set",
                                     R"(camera={"eye": [4, 3, 5], "target": [0.5, 0.5, 0.5]})"})));
  hooke_ok({"render", "out", "-o", "g.mp4", "--size", "96x54", "--samples", "1"});
  EXPECT_EQ(probe_film(path("g.mp4")).frames, 13);
  for (const int k : {0, 6, 12}) EXPECT_GT(similarity(frame("f.mp4", k), frame("g.mp4", k)), 0.95) << k;
  EXPECT_LT(similarity(frame("f.mp4", 0), frame("g.mp4", 12)), 0.9);
}

TEST_F(FilmOfARun, AtTheSpeedOfTheSceneIsTheFilmWithoutASpeed) {
  hooke_ok(run("a", film("a.mp4", {"--quiet"})));
  hooke_ok(run("b", film("b.mp4", {"--quiet", "--speed", "1"})));
  EXPECT_EQ(frame_hashes("b.mp4"), frame_hashes("a.mp4"));
  EXPECT_EQ(probe_film(path("a.mp4")).frames, 13);
  hooke_ok(run("c", film("c.mp4", {"--quiet", "--speed", "2"})));
  EXPECT_NE(frame_hashes("c.mp4"), frame_hashes("a.mp4"));

  const auto draw = [this](const std::string& name, const Words& more) {
    Words words{"render", "a", "-o", name + "%02d.png", "--size", "96x54", "--samples", "1"};
    words.insert(words.end(), more.begin(), more.end());
    hooke_ok(words);
  };
  draw("plain", {});
  draw("same", {"--speed", "1"});
  for (const char* number : {"00", "06", "12"}) {
    EXPECT_EQ(read("same" + std::string(number) + ".png"), read("plain" + std::string(number) + ".png")) << number;
  }
}

TEST_F(FilmOfARun, GoesOnWithTheRun) {
  hooke_ok(run("whole", {"--quiet"}));
  Words half = run("half", film("f1.mp4", {"--quiet"}));
  half[7] = "30";
  hooke_ok(half);
  EXPECT_EQ(probe_film(path("f1.mp4")).frames, 7);  // up to 0.21 s
  hooke_ok(run("half", film("f2.mp4", {"--quiet", "--resume", "half"})));
  EXPECT_EQ(probe_film(path("f2.mp4")).frames, 6);  // from 0.21 s on
  EXPECT_EQ(state_hash("half"), state_hash("whole"));
}

TEST_F(FilmOfARun, EveryColour) {
  for (const char* what : {"material", "speed", "height", "pressure", "contacts", "id"}) {
    // Periodic: between two steps, particles are drawn back across the face.
    hooke_ok(run("out", film("f.mp4", {"--quiet", "--overwrite", "--color-by", what, "--set",
                                       "domain.walls=[\"periodic\",\"spring\",\"spring\"]", "--set",
                                       "particles[0].velocity=[20,0,0]"})));
    EXPECT_EQ(probe_film(path("f.mp4")).frames, 13) << what;
  }
}

TEST_F(FilmOfARun, RefusesWhatItCanNotDraw) {
  const auto expect_refused = [&](const Words& arguments, const std::string& what) {
    const Outcome outcome = hooke(arguments);
    EXPECT_EQ(outcome.status, 2) << testing::PrintToString(arguments);
    EXPECT_THAT(outcome.err, HasSubstr(what));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(exists("out"));
    for (const char* file : {"f.avi", "f.mp4"}) EXPECT_FALSE(exists(file)) << what;
  };
  expect_refused(run("out", film("f.avi")), "known are .mp4, .mov, .mkv, .webm, .gif");
  expect_refused(run("out", film("nowhere/f.mp4")), "there is no folder nowhere");
  expect_refused(run("out", {"--film", "f.mp4", "--size", "97x54"}), "must be even; 97x54 is not");
  expect_refused(run("out", film("f.mp4", {"--resume", "missing.h5"})), "missing.h5");
  expect_refused(run("nowhere/and/f", film("f.mp4", {"--set", "time.step=-1"})), "time.step");
  {
    const EnvironmentVariable nowhere("PATH", path("").string());
    expect_refused(run("out", film("f.mp4")), "ffmpeg: is not installed");
  }
  const EnvironmentVariable no_driver("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null");
  expect_refused(run("out", film("f.mp4")), "OpenGL");
}

TEST_F(FilmOfARun, AFolderThatCanNotBeWrittenLeavesNoFilm) {
  write("file", "not a folder");
  EXPECT_EQ(hooke(run("file/out", film("f.mp4"))).status, 2);
  EXPECT_FALSE(exists("f.mp4"));
}

// Starts a long run with a film and ends it by `signal` after some frames.
class StoppedFilm : public FilmOfARun {
 protected:
  Outcome stop_by(int signal) {
    Words words = run("out", film("f.mp4"));
    words[7] = "1000000";
    Program program = start(words);
    const auto rows = [this] {
      const std::string series = exists("out/series.csv") ? read("out/series.csv") : "";
      return std::count(series.begin(), series.end(), '\n');
    };
    EXPECT_TRUE(wait_until([&] { return rows() > 20; }));  // 7 steps a row, longer than a frame
    program.send(signal);
    return program.wait();
  }
};

TEST_F(StoppedFilm, AnInterruptEndsTheFilmAndTheRun) {
  const Outcome stopped = stop_by(SIGINT);
  EXPECT_EQ(stopped.status, 130) << stopped.err;
  const FilmProbe probe = probe_film(path("f.mp4"));
  EXPECT_EQ(probe.problem, "");
  EXPECT_GT(probe.frames, 5);
  EXPECT_THAT(stopped.out, HasSubstr("film of " + std::to_string(probe.frames) + " frames"));
  EXPECT_TRUE(exists("out/checkpoint.h5"));
}

TEST_F(StoppedFilm, AKillLeavesAFilmThatPlays) {
  EXPECT_EQ(stop_by(SIGKILL).status, 128 + SIGKILL);
  FilmProbe probe;
  EXPECT_TRUE(wait_until([&] {
    probe = probe_film(path("f.mp4"));
    return probe.frames > 5 && probe.problem.empty();
  })) << probe.frames
      << probe.problem;
}

}  // namespace
}  // namespace hooke::test
