// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "hooke/base/expected.h"
#include "hooke/core/scene.h"
#include "hooke/core/snapshot.h"
#include "hooke/io/run_folder.h"

namespace hooke::run {

/// The particles of a run at any time between its first snapshot and its last. `run`, of at least one snapshot, and
/// `scene` must outlive it.
class Playback {
 public:
  Playback(const io::RunReader& run, const Scene& scene) : run_(run), scene_(scene) {}

  /// `time` in [first, last], s, preferably ascending from call to call: keeps the two snapshots around it.
  Expected<ParticleSet> at(double time);

 private:
  Expected<void> load(std::optional<Snapshot>& slot, std::size_t index);

  const io::RunReader& run_;
  const Scene& scene_;
  std::optional<Snapshot> before_, after_;
};

/// Snapshots spread over the run, at most five, its first and last among them: what its camera has to see.
Expected<std::vector<ParticleSet>> moments_of(const io::RunReader& run);

}  // namespace hooke::run
