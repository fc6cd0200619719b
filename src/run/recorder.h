// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "hooke/base/expected.h"
#include "hooke/core/simulation.h"
#include "hooke/io/run_folder.h"
#include "hooke/run/film_thread.h"
#include "hooke/run/open_simulation.h"
#include "hooke/run/picture_arguments.h"

namespace hooke::run {

/// What a run writes, and where.
struct RecordArguments {
  std::filesystem::path output;            ///< the run folder
  bool overwrite = false;                  ///< replaces the run that it holds
  std::filesystem::path resume;            ///< the checkpoint that the simulation goes on from, unchanged, or empty
  std::optional<double> checkpoint_every;  ///< simulated seconds; without, ten checkpoints a run
  std::filesystem::path film;              ///< empty: none
  PictureArguments picture;                ///< of the film
};

/// What can be refused before the scene is read: a folder that holds a run or is being written, a film that can't be
/// made. `how_to_overwrite`: the end of the sentence about such a folder, e.g. "--overwrite replaces it".
Expected<void> check_record(const RecordArguments& arguments, const std::string& how_to_overwrite);

/// What happens during a run, for a log.
struct RecordEvents {
  FilmThread::OnFailure film_failed;
  std::function<void(std::int64_t step)> checkpoint;  ///< one of this step will be written
};

/// Steps a simulation to the end of its scene, and meanwhile writes its run folder and its film.
class Recorder {
 public:
  /// Called several times a second with the steps done and the number of particles; false ends the run.
  using Watch = std::function<bool(std::int64_t step, std::uint64_t particles)>;

  /// Creates the folder and begins the film; check_record() has been called before. `opened` must outlive the recorder.
  /// bad_input where the checkpoint is of a step after the end of the run, and where the simulation has been stepped
  /// since the run in this folder; nor may it have been changed otherwise.
  static Expected<Recorder> start(OpenedSimulation& opened, const RecordArguments& arguments, RecordEvents events = {});

  ~Recorder();
  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;

  /// True if the run reached its end, false if `watch` ended it; either way a snapshot and a checkpoint of the last
  /// step exist. To be called once.
  Expected<bool> to_the_end(const Watch& watch);

  /// Ends the film, after to_the_end(); empty without one. The run's files don't depend on it.
  Expected<std::optional<FilmThread::Summary>> finish_film();

  /// The report of the run, which is also written; then closes the folder.
  Expected<io::RunReport> finish();

  io::RunWriter& writer();

 private:
  struct Impl;
  explicit Recorder(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace hooke::run
