// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "commands.h"
#include "hooke/base/expected.h"
#include "hooke/core/simulation.h"

namespace hooke::cli {

/// Draws a film of a run while it runs, on a thread of its own: a frame at every multiple of 1 / frames_per_second of
/// simulated time, of the state of the first step at or after it, drawn back by what it is late. Used by one thread at
/// a time.
class FilmThread {
 public:
  struct Summary {
    std::int64_t frames = 0;
    double seconds_a_frame = 0;  ///< that drawing one took, on the average
  };

  /// bad_input where pictures can't be drawn; what check_film() and check_output_file() say has been asked before.
  /// Camera and colours follow from the state of `simulation` now; it is not asked again.
  static Expected<std::unique_ptr<FilmThread>> start(const std::filesystem::path& file, const PictureArguments& picture,
                                                     const Simulation& simulation);

  /// Without finish() before, ends the film after what has been shown.
  ~FilmThread();

  /// Whether a frame is due at `time` (s).
  bool is_due(double time) const;
  /// Before finish(). Takes the frames that are due from the state `now`; waits where two are still to be drawn.
  void show(const std::shared_ptr<const Snapshot>& now);
  /// Draws what is waiting and ends the film; what went wrong since the start.
  Expected<Summary> finish();

 private:
  struct Impl;
  explicit FilmThread(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace hooke::cli
