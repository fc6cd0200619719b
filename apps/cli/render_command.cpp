// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>
#include <utility>
#include <vector>

#include "commands.h"
#include "hooke/io/report.h"
#include "hooke/io/run_folder.h"
#include "hooke/render/film.h"
#include "hooke/run/kept_scene.h"
#include "hooke/run/numbers.h"
#include "hooke/run/output_check.h"
#include "hooke/run/playback.h"
#include "hooke/run/studio.h"
#include "hooke/scene/load_scene.h"
#include "interrupt.h"
#include "log.h"
#include "progress.h"
#include "run_argument.h"

namespace hooke::cli {
namespace {

bool is_png(const std::filesystem::path& file) { return file.extension() == ".png" || file.extension() == ".PNG"; }
bool is_exr(const std::filesystem::path& file) { return file.extension() == ".exr" || file.extension() == ".EXR"; }
bool is_picture(const std::filesystem::path& file) { return is_png(file) || is_exr(file); }

// "frames/%04d.png": the position of the number and its minimum number of digits.
std::optional<std::string> numbered_name(const std::filesystem::path& pattern, std::size_t number) {
  static const std::regex kNumber("%0?([0-9]{0,2})d");
  std::smatch match;
  const std::string name = pattern.filename().string();
  if (!std::regex_search(name, match, kNumber)) return {};
  const int digits = match[1].length() > 0 ? std::stoi(match[1].str()) : 1;
  return match.prefix().str() + fmt::format("{:0{}}", number, digits) + match.suffix().str();
}

Expected<std::string> encode(const Expected<render::Image>& image, bool alpha) {
  return image ? render::encode_png(*image, alpha) : fail(image.error());
}
Expected<std::string> encode(const Expected<render::LinearImage>& image) {
  return image ? render::encode_exr(*image) : fail(image.error());
}

// Draws a picture into a file, by its extension.
Expected<void> draw_picture(run::Studio& studio, const ParticleSet& particles, double time, bool alpha,
                            const std::filesystem::path& file) {
  const auto bytes =
      is_exr(file) ? encode(studio.linear_picture(particles, time)) : encode(studio.picture(particles, time), alpha);
  if (!bytes) return fail(bytes.error());
  return io::write_text_file(file, *bytes);
}

Expected<void> check_time(const char* option, std::optional<double> time, const io::RunReader& run) {
  if (!time) return {};
  const double first = run.times().front(), last = run.times().back();
  const double rounding = 1e-9 * std::max(1.0, std::abs(last));
  if (*time >= first - rounding && *time <= last + rounding) return {};
  return fail(Error::Kind::bad_input, option,
              fmt::format("{} s is outside of the run, which goes from {} s to {} s", *time, first, last));
}

// What is wrong with the options, for a picture or a film.
Expected<void> check_options(const RenderArguments& arguments, bool still) {
  const auto wrong = [](const char* option, const char* why) { return fail(Error::Kind::bad_input, option, why); };
  if (!still && arguments.time)
    return wrong("--time", "is of a single picture (.png, .exr); a film has --from and --to");
  if (still && (arguments.from || arguments.to)) return wrong(arguments.from ? "--from" : "--to", "is of a film");
  if (still && arguments.every) return wrong("--every", "is of a film");
  if (arguments.from && arguments.to && !(*arguments.from <= *arguments.to)) {
    return wrong("--to", "must not be before --from");
  }
  if (arguments.picture.alpha && render::is_film(arguments.output)) {
    return wrong("--alpha", "is of pictures (.png, .exr), which may be numbered; films have no alpha");
  }
  return {};
}

// The times of a film's frames, s.
std::vector<double> frame_times(const RenderArguments& arguments, const io::RunReader& run) {
  const double first = std::max(arguments.from.value_or(run.times().front()), run.times().front());
  const double last = std::min(arguments.to.value_or(run.times().back()), run.times().back());
  std::vector<double> times;
  if (arguments.every) {
    std::int64_t number = 0;
    for (const double time : run.times()) {
      if (time >= first && time <= last && number++ % *arguments.every == 0) times.push_back(time);
    }
    return times;
  }
  const double step = arguments.picture.seconds_a_frame();
  const auto count = static_cast<std::int64_t>(std::floor((last - first) / step + 1e-6)) + 1;
  for (std::int64_t frame = 0; frame < count; ++frame) {
    times.push_back(std::min(first + static_cast<double>(frame) * step, last));
  }
  return times;
}

// Frames what the run does, where the scene leaves that to the camera.
Expected<void> frame_action(const io::RunReader& run, const Scene& scene, run::Studio& studio) {
  if (scene.camera.eye && scene.camera.target) return {};
  const auto moments = run::moments_of(run);
  if (!moments) return fail(moments.error());
  studio.frame_action(*moments);
  return {};
}

Expected<void> render_still(const RenderArguments& arguments, const io::RunReader& run, run::Playback& playback,
                            run::Studio& studio) {
  const double last = run.times().back();
  const double time = std::clamp(arguments.time.value_or(last), run.times().front(), last);
  const auto particles = playback.at(time);
  if (!particles) return fail(particles.error());
  if (auto drawn = draw_picture(studio, *particles, time, arguments.picture.alpha, arguments.output); !drawn) {
    return drawn;
  }
  fmt::print("{} particles at {:.6g} s in {}\n", run::with_commas(particles->size()), time, arguments.output.string());
  return {};
}

// Gives the particles of each frame, its time and its number to `take`; returns their number and whether it was all of
// them, or a signal came first.
template <class Take>
Expected<std::pair<std::int64_t, bool>> render_frames(const RenderArguments& arguments, const io::RunReader& run,
                                                      run::Playback& playback, const Take& take) {
  const std::vector<double> times = frame_times(arguments, run);
  const auto count = static_cast<std::int64_t>(times.size());
  const Interrupt interrupt;
  FrameProgress progress(count);
  std::int64_t frame = 0;
  for (; frame < count && !interrupt.requested(); ++frame) {
    const double time = times[static_cast<std::size_t>(frame)];
    const auto particles = playback.at(time);
    if (!particles) return fail(particles.error());
    if (auto taken = take(*particles, time, frame); !taken) return fail(std::move(taken).error());
    progress.update(frame + 1);
  }
  return std::pair{frame, frame == count};
}

Expected<ExitStatus> render_film(const RenderArguments& arguments, const io::RunReader& run, run::Playback& playback,
                                 run::Studio& studio) {
  const PictureArguments& picture = arguments.picture;
  auto film = render::FilmWriter::create(arguments.output, {picture.width, picture.height, picture.frames_per_second});
  if (!film) return fail(std::move(film).error());
  const auto done =
      render_frames(arguments, run, playback, [&](const ParticleSet& particles, double time, std::int64_t) {
        const auto image = studio.picture(particles, time);
        return image ? film->add(*image) : fail(image.error());
      });
  if (!done) return fail(done.error());
  if (auto finished = film->finish(); !finished) return fail(std::move(finished).error());
  fmt::print("{} frames, {:.2f} s, in {}{}\n", done->first,
             static_cast<double>(done->first) / picture.frames_per_second, arguments.output.string(),
             done->second ? "" : ", interrupted");
  return done->second ? kDone : kInterrupted;
}

Expected<ExitStatus> render_sequence(const RenderArguments& arguments, const io::RunReader& run,
                                     run::Playback& playback, run::Studio& studio) {
  const std::filesystem::path folder = arguments.output.parent_path();
  const auto draw = [&](const ParticleSet& particles, double time, std::int64_t frame) {
    return draw_picture(studio, particles, time, arguments.picture.alpha,
                        folder / *numbered_name(arguments.output, static_cast<std::size_t>(frame)));
  };
  const auto done = render_frames(arguments, run, playback, draw);
  if (!done) return fail(done.error());
  fmt::print("{} pictures, the first of them {}{}\n", done->first,
             (folder / *numbered_name(arguments.output, 0)).string(), done->second ? "" : ", interrupted");
  return done->second ? kDone : kInterrupted;
}

Expected<ExitStatus> render(const RenderArguments& arguments) {
  const bool still = is_picture(arguments.output) && !numbered_name(arguments.output, 0);
  if (!is_picture(arguments.output) && !render::is_film(arguments.output)) {
    return fail(Error::Kind::bad_input, arguments.output.string(),
                "has no extension of a picture or a film; known are .png, .exr, " + render::film_extensions());
  }
  if (is_exr(arguments.output) && !render::has_openexr()) {
    return fail(Error::Kind::bad_input, arguments.output.string(),
                "needs OpenEXR, which is not in this build (HOOKE_WITH_OPENEXR)");
  }
  if (auto good = check_options(arguments, still); !good) return fail(std::move(good).error());
  if (auto writable = run::check_output_file(arguments.output, "--output"); !writable) return fail(writable.error());
  if (render::is_film(arguments.output)) {
    const PictureArguments& p = arguments.picture;
    if (auto possible = render::check_film(arguments.output, {p.width, p.height, p.frames_per_second}); !possible) {
      return fail(possible.error());
    }
  }
  if (auto right = check_run_argument(arguments.run, "render"); !right) return fail(right.error());
  const auto run = io::RunReader::open(arguments.run);
  if (!run) return fail(run.error());
  if (run->size() == 0) return fail(Error::Kind::bad_input, arguments.run.string(), "holds no snapshot yet");
  for (const auto& [option, time] :
       {std::pair{"--time", arguments.time}, {"--from", arguments.from}, {"--to", arguments.to}}) {
    if (auto inside = check_time(option, time, *run); !inside) return fail(inside.error());
  }
  const std::filesystem::path folder =
      std::filesystem::is_directory(arguments.run) ? arguments.run : arguments.run.parent_path();
  const auto loaded = run::load_kept_scene(folder, arguments.overrides);
  if (!loaded) return fail(loaded.error());
  if (auto right = run::check_materials(*run, loaded->scene); !right) return fail(std::move(right).error());
  auto studio = run::Studio::open(arguments.picture, is_exr(arguments.output));
  if (!studio) return fail(std::move(studio).error());
  const auto first = run->read(0);
  if (!first) return fail(first.error());
  studio->set_scene(loaded->scene, first->particles);
  if (auto framed = frame_action(*run, loaded->scene, *studio); !framed) return fail(std::move(framed).error());

  run::Playback playback(*run, loaded->scene);
  if (render::is_film(arguments.output)) return render_film(arguments, *run, playback, *studio);
  if (!still) return render_sequence(arguments, *run, playback, *studio);
  if (auto done = render_still(arguments, *run, playback, *studio); !done) return fail(done.error());
  return kDone;
}

}  // namespace

ExitStatus render_command(const RenderArguments& arguments) {
  const auto status = render(arguments);
  return status ? *status : report_error(status.error());
}

}  // namespace hooke::cli
