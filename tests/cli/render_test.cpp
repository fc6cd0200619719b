// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "hooke/render/image.h"
#include "hooke/render/linear_image.h"
#include "program.h"
#include "support/environment.h"
#include "support/film_probe.h"

namespace hooke::test {
namespace {

using testing::HasSubstr;

using Words = std::vector<std::string>;

// Pictures of a run of 60 steps of 0.005 s, with a snapshot every 7 steps.
class RenderCommand : public ProgramTest {
 protected:
  RenderCommand() {
    use_software_gl();
    write("s.json", small_scene());
    hooke_ok({"run", "s.json", "--quiet"});
  }

  static Words with(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  static Words render(const std::string& output, const Words& more = {}) {
    return with({"render", "s", "-o", output, "--samples", "1", "--size", "96x54"}, more);
  }

  render::Image picture(const std::string& file) const {
    auto image = render::decode_png(read(file));
    EXPECT_TRUE(image) << file;
    return image ? std::move(*image) : render::Image();
  }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path(""))) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with("call") && name != "s" && name != "s.json") names.push_back(name);
    }
    return names;
  }

  // Expects status 2, one line that says `what`, and no file written.
  void expect_refused(const Words& arguments, const std::string& what) {
    const Outcome outcome = hooke(arguments);
    EXPECT_EQ(outcome.status, 2) << testing::PrintToString(arguments);
    EXPECT_THAT(outcome.err, HasSubstr(what)) << testing::PrintToString(arguments);
    EXPECT_LE(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 2) << outcome.err;  // CLI11 points to --help
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(files(), testing::IsEmpty());
  }
};

TEST_F(RenderCommand, ShowsTheLastSnapshot) {
  EXPECT_THAT(hooke_ok(render("p.png")), HasSubstr("216 particles at 0.3 s in p.png"));
  hooke_ok(render("q.png", {"--time", "0.3"}));
  EXPECT_EQ(read("p.png"), read("q.png"));
  const render::Image image = picture("p.png");
  EXPECT_EQ(image.width, 96);
  EXPECT_EQ(image.height, 54);
  // Balls without a colour of their own are blue.
  int blue = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) blue += image.pixels[i + 2] > 2 * image.pixels[i] + 30;
  EXPECT_GT(blue, 96 * 54 / 40);
}

TEST_F(RenderCommand, ShowsAnyTimeOfTheRun) {
  std::map<std::string, std::string> by_picture;
  for (const char* time : {"0", "0.02", "0.035", "0.0501", "0.299"}) {
    EXPECT_THAT(hooke_ok(render("p.png", {"--time", time, "--no-legend"})), HasSubstr(" s in p.png"));
    EXPECT_EQ(by_picture.emplace(read("p.png"), time).second, true) << time << " looks like another time";
  }
}

TEST_F(RenderCommand, ColoursByEverything) {
  std::map<std::string, std::string> by_picture;
  for (const char* what : {"material", "speed", "height", "pressure", "contacts", "id"}) {
    hooke_ok(render("p.png", {"--color-by", what, "--no-legend"}));
    EXPECT_TRUE(by_picture.emplace(read("p.png"), what).second) << what << " looks like another quantity";
  }
  hooke_ok(render("p.png", {"--color-by", "height", "--color-range", "0", "100", "--no-legend"}));
  EXPECT_TRUE(by_picture.emplace(read("p.png"), "range").second);
  hooke_ok(render("p.png", {"--color-by", "height"}));
  EXPECT_TRUE(by_picture.emplace(read("p.png"), "legend").second);
}

TEST_F(RenderCommand, TheScenesCameraCanBeReplaced) {
  hooke_ok(render("p.png"));
  hooke_ok(render("q.png", {"--set", "camera.orbit=90"}));
  EXPECT_NE(read("p.png"), read("q.png"));
}

TEST_F(RenderCommand, NumberedPicturesAreTheFramesOfAFilm) {
  std::filesystem::create_directory(path("f"));
  EXPECT_THAT(hooke_ok(render("f/p_%03d.png", {"--fps", "20"})),
              HasSubstr("7 pictures, the first of them f/p_000.png"));
  EXPECT_FALSE(exists("f/p_007.png"));
  for (const auto& [frame, time] : {std::pair{"f/p_000.png", "0"}, {"f/p_002.png", "0.1"}, {"f/p_006.png", "0.3"}}) {
    hooke_ok(render("still.png", {"--time", time}));
    EXPECT_EQ(read(frame), read("still.png")) << frame;
  }
}

TEST_F(RenderCommand, FilmsLastAsLongAsTheRun) {
  for (const char* file : {"f.mp4", "f.mov", "f.mkv", "f.webm", "f.gif"}) {
    EXPECT_THAT(hooke_ok(render(file, {"--fps", "50"})), HasSubstr("16 frames, 0.32 s, in"));
    const FilmProbe probe = probe_film(path(file));
    EXPECT_EQ(probe.problem, "") << file;
    EXPECT_EQ(probe.frames, 16) << file;
    EXPECT_EQ(probe.width, 96) << file;
    EXPECT_NEAR(probe.seconds, 0.3, 0.021) << file;
  }
  EXPECT_EQ(files().size(), 5u);
}

TEST_F(RenderCommand, FilmsShowPartsOfTheRunAtAnySpeed) {
  EXPECT_THAT(hooke_ok(render("f.mp4", {"--fps", "50", "--from", "0.1", "--to", "0.2"})), HasSubstr("6 frames"));
  EXPECT_THAT(hooke_ok(render("f.mp4", {"--fps", "50", "--speed", "0.5"})), HasSubstr("31 frames, 0.62 s"));
  EXPECT_THAT(hooke_ok(render("f.mp4", {"--fps", "50", "--every", "2"})), HasSubstr("5 frames"));
  std::filesystem::create_directory(path("f"));
  hooke_ok(render("f/p_%d.png", {"--fps", "10", "--speed", "0.5", "--from", "0.1"}));
  hooke_ok(render("still.png", {"--time", "0.15"}));
  EXPECT_EQ(read("f/p_1.png"), read("still.png"));
  hooke_ok({"run", "s.json", "-o", "t", "--quiet", "--film", "r.mp4", "--size", "96x54", "--samples", "1", "--fps",
            "50", "--speed", "0.5"});
  EXPECT_EQ(probe_film(path("r.mp4")).frames, 31);
}

TEST_F(RenderCommand, PicturesMayHaveAlpha) {
  hooke_ok(render("p.png", {"--alpha"}));
  const render::Image image = picture("p.png");
  EXPECT_EQ(image.at(1, 1)[3], 0);
  int solid = 0;
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) solid += image.pixels[i] == 255;
  EXPECT_GT(solid, 96 * 54 / 40);
}

TEST_F(RenderCommand, PicturesMayBeInLinearLight) {
  if (!render::has_openexr()) {
    expect_refused(render("p.exr"), "needs OpenEXR, which is not in this build");
    return;
  }
  const std::string magic("\x76\x2f\x31\x01", 4);
  EXPECT_THAT(hooke_ok(render("p.exr", {"--alpha"})), HasSubstr("in p.exr"));
  EXPECT_EQ(read("p.exr").substr(0, 4), magic);
  EXPECT_THAT(hooke_ok(render("p_%d.exr", {"--fps", "10"})), HasSubstr("4 pictures, the first of them p_0.exr"));
  EXPECT_EQ(read("p_3.exr").substr(0, 4), magic);
}

TEST_F(RenderCommand, RefusesWhatItCanNotDraw) {
  expect_refused(render("f.avi"), "known are .png, .exr, .mp4, .mov, .mkv, .webm, .gif");
  expect_refused(render("f"), "known are");
  expect_refused(render("nowhere/f.mp4"), "there is no folder nowhere");
  expect_refused(render("nowhere/f.png"), "there is no folder nowhere");
  expect_refused(render("p.png", {"--time", "0.31"}), "goes from 0 s to 0.3 s");
  expect_refused(render("p.png", {"--time", "-0.1"}), "--time: -0.1 s is outside of the run");
  expect_refused(render("p.png", {"--time", "nan"}), "--time");
  expect_refused(render("f.mp4", {"--time", "0.1"}), "of a single picture");
  expect_refused(render("p.png", {"--from", "0.1"}), "--from: is of a film");
  expect_refused(render("p.png", {"--every", "2"}), "--every: is of a film");
  expect_refused(render("f.mp4", {"--to", "0.4"}), "--to: 0.4 s is outside of the run");
  expect_refused(render("f.mp4", {"--from", "0.2", "--to", "0.1"}), "must not be before --from");
  expect_refused(render("f.mp4", {"--every", "2", "--speed", "2"}), "--speed");
  expect_refused(render("f.mp4", {"--speed", "0"}), "--speed");
  expect_refused(render("f.mp4", {"--alpha"}), "films have no alpha");
  expect_refused({"render", "s", "-o", "f.mp4", "--size", "95x54"}, "must be even; 95x54 is not");
  expect_refused({"render", "missing", "-o", "p.png"}, "missing");
  expect_refused({"render", "s.json", "-o", "p.png"}, "s.json");
  expect_refused(render("p.png", {"--set", "camera.orbits=3"}), "orbit");
  expect_refused(render("p.png", {"--color-by", "mass"}), "mass");
}

TEST_F(RenderCommand, RefusesNumbersThatMakeNoSense) {
  for (const char* size :
       {"0x10", "10x0", "-5x5", "640", "640x", "x480", "axb", "1e3x10", "640x480x3", "99999x2", ""}) {
    expect_refused({"render", "s", "-o", "p.png", "--size", size}, "--size");
  }
  for (const char* fps : {"0", "-1", "nan", "inf", "1e9", "fast"})
    expect_refused(render("f.mp4", {"--fps", fps}), "--fps");
  for (const char* samples : {"0", "5", "1.5"}) {
    expect_refused({"render", "s", "-o", "p.png", "--samples", samples}, "--samples");
  }
  for (const Words& range : {Words{"5", "5"}, {"5", "1"}, {"nan", "1"}, {"0", "inf"}, {"1", "x"}}) {
    expect_refused(render("p.png", with({"--color-by", "speed", "--color-range"}, range)), "--color-range");
  }
  hooke_ok(render("p_%099999999999d.png"));  // no valid number of digits: a name like any other
  EXPECT_EQ(files(), (Words{"p_%099999999999d.png"}));
}

TEST_F(RenderCommand, DrawsAnySizeThereIs) {
  for (const char* size : {"1x1", "1x2000", "16384x1", "3x7"}) {
    hooke_ok({"render", "s", "-o", "p.png", "--size", size, "--samples", "1", "--color-by", "speed"});
    const render::Image image = picture("p.png");
    EXPECT_EQ(std::to_string(image.width) + "x" + std::to_string(image.height), size);
  }
  for (const char* size : {"2x2", "4096x2"}) {
    hooke_ok({"render", "s", "-o", "f.mp4", "--size", size, "--samples", "1", "--fps", "5"});
    EXPECT_EQ(probe_film(path("f.mp4")).frames, 2) << size;
  }
}

TEST_F(RenderCommand, SaysThatFfmpegIsMissingAndDrawsPicturesAllTheSame) {
  const EnvironmentVariable nowhere("PATH", path("").string());
  expect_refused(render("f.mp4"), "ffmpeg: is not installed");
  hooke_ok(render("p.png"));
}

TEST_F(RenderCommand, SaysThatThereIsNoOpenGl) {
  const EnvironmentVariable no_driver("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null");
  expect_refused(render("p.png"), "OpenGL");
  expect_refused(render("f.mp4"), "OpenGL");
  hooke_ok({"export", "s", "-o", "p.csv"});
  hooke_ok({"run", "s.json", "-o", "t", "--steps", "3", "--quiet"});
}

TEST_F(RenderCommand, OnlyPicturesNeedTheGlModule) {
  // The program alone, without the files beside it.
  std::filesystem::copy_file(program_file(), path("hooke"));
  const auto call = [&](const std::string& arguments) {
    const std::string command = "cd '" + path("").string() + "' && ./hooke " + arguments + " >call.out 2>call.err";
    return WEXITSTATUS(std::system(command.c_str()));
  };
  EXPECT_EQ(call("check s.json"), 0) << read("call.err");
  EXPECT_EQ(call("render s -o p.png"), 2);
  EXPECT_THAT(read("call.err"), HasSubstr("OpenGL: pictures need it: "));
  EXPECT_FALSE(exists("p.png"));
}

TEST_F(RenderCommand, TheProgramItselfIsLinkedWithNoGl) {
  const std::string command = "readelf -d '" + program_file() + "' > '" + path("needed").string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_THAT(read("needed"), HasSubstr("libtbb"));
  EXPECT_THAT(read("needed"), testing::Not(testing::ContainsRegex("libE?GL|libepoxy|libOpenGL")));
}

}  // namespace
}  // namespace hooke::test
