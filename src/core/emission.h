// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/births.h"
#include "hooke/core/colliders.h"
#include "hooke/core/emitters.h"
#include "hooke/core/particles.h"

namespace hooke {

class Backend;
class FreeSpace;
class Ranks;
struct Scene;

/// The progress of an emitter.
struct EmitterState {
  double due = 0;  ///< births owed by its rate, the fraction of one included
  std::uint64_t births = 0;  ///< so far: the number of the next one
  std::uint64_t reborn = 0;  ///< of them, in place of an ended life
  std::uint64_t to_respawn = 0;  ///< lives that have ended and wait to be born again
  std::uint64_t attempts = 0;  ///< places that were tried in vain for the next birth

  friend bool operator==(const EmitterState&, const EmitterState&) = default;
};

/// A particle whose life ends: at the end of step `death`, counted from the start of the run.
struct Mortal {
  std::int64_t death = 0;
  std::uint64_t id = 0;
  std::uint32_t emitter = 0;  ///< index into the scene's

  friend auto operator<=>(const Mortal&, const Mortal&) = default;
};

/// What a checkpoint stores of future births and deaths.
struct EmissionState {
  std::vector<EmitterState> emitters;  ///< as many as the scene has, or none at the start
  std::vector<Mortal> mortals;  ///< ascending; some may have left early

  friend bool operator==(const EmissionState&, const EmissionState&) = default;
};

/// Why a saved state does not fit `scene`; empty where it does.
std::vector<Finding> check_state(const EmissionState& state, const Scene& scene);

/// Births and deaths at the end of each step, the same for all back ends: which particles go, which come, where and how
/// fast.
class Emission {
 public:
  /// Takes the emitters of a scene, before anything else and after restore().
  void configure(const Scene& scene);

  /// The ids of the particles whose lives end with step `step` (> 0), each once. give_birth() of the same step is to
  /// follow.
  std::span<const std::uint64_t> end_lives(std::int64_t step);

  /// The particles born with step `step` (> 0) of the configured scene, whose colliders are in these poses. They get
  /// the ids from `next_id` on, which advances. The ranks' back ends are only asked what is in the way, and all draw
  /// the same births. `was_there` says for each life that ended whether its particle still existed. Valid until the
  /// next call.
  const ParticleSet& give_birth(const Scene& scene, std::int64_t step, std::span<const ColliderPose> poses,
                                std::span<const std::uint8_t> was_there, const Backend& backend, Ranks& ranks,
                                std::uint64_t& next_id);

  EmissionState state() const;
  /// Goes on from a state that check_state() finds nothing wrong with.
  void restore(EmissionState state);

 private:
  // A coming birth.
  struct Birth {
    Vec3d position, velocity;
    std::optional<std::int64_t> lifetime;  // steps
    std::uint64_t attempts = 0;  // failed ones; fewer than allowed where a place was found
  };

  void emit(const Scene& scene, std::uint32_t index, std::int64_t step, std::span<const ColliderPose> poses,
            const Backend& backend, Ranks& ranks, std::uint64_t& next_id);
  void find_births(const PlacedEmitter& emitter, const Scene& scene, FreeSpace& space, bool single,
                   std::uint64_t wanted);

  std::vector<EmitterState> emitters_;
  std::vector<std::vector<double>> areas_;  // areas_of_birth() of each
  std::map<std::int64_t, std::vector<Mortal>> mortals_;  // by the step of their death
  std::vector<Mortal> ending_;  // in the current step
  std::vector<std::uint64_t> ending_ids_;
  ParticleSet newborn_;  // of the current step
  std::vector<Birth> births_;  // of the current emitter
};

}  // namespace hooke
