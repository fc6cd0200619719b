// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

#include "hooke/base/expected.h"
#include "hooke/core/simulation.h"
#include "hooke/run/picture_arguments.h"

namespace hooke::run {

/// Draws a film of a run in its own thread while the run continues: a frame at every multiple of
/// PictureArguments::seconds_a_frame() of simulated time. A frame shows the first step at or after its time, drawn back
/// by the difference. To be used by one thread at a time.
class FilmThread {
 public:
  struct Summary {
    std::int64_t frames = 0;
    double seconds_a_frame = 0;  ///< average time to draw a frame
  };

  /// Called once, by the film's thread, where the film can't go on: the run does without it.
  using OnFailure = std::function<void(const Error&)>;

  /// bad_input where pictures can't be drawn; check_film() and check_output_file() have been called before. Camera and
  /// colours follow from the present state of `simulation`, which is not used again.
  static Expected<std::unique_ptr<FilmThread>> start(const std::filesystem::path& file, const PictureArguments& picture,
                                                     const Simulation& simulation, OnFailure on_failure = {});

  /// Without finish(), ends the film after the frames shown so far.
  ~FilmThread();

  /// Whether a frame is due at `time` (s).
  bool is_due(double time) const;
  /// To be called before finish(). Takes the frames due from the state `now`; waits while two are still to be drawn.
  void show(const std::shared_ptr<const Snapshot>& now);
  /// Draws the waiting frames and ends the film; returns the error that occurred since the start, if any.
  Expected<Summary> finish();

 private:
  struct Impl;
  explicit FilmThread(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace hooke::run
