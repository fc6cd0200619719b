// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/emission.h"

#include <algorithm>
#include <cmath>

#include "hooke/base/assert.h"
#include "hooke/base/format.h"
#include "hooke/base/parallel.h"
#include "hooke/base/single_precision.h"
#include "hooke/core/backend.h"
#include "hooke/core/free_space.h"
#include "hooke/core/placed_colliders.h"
#include "hooke/core/ranks.h"

namespace hooke {
namespace {

constexpr std::uint64_t kMostAttempts = 32;  // to find a place for a birth, in a step

Vec3d rounded(const Vec3d& a, bool single) { return single ? to_single_precision(a) : a; }

// Adds the births that a step makes due; returns how many whole births are due.
std::uint64_t births_due(const Emitter& emitter, EmitterState& state, std::int64_t step, double dt) {
  const double time = static_cast<double>(step - 1) * dt, slack = 1e-9 * dt;  // a step that begins on the dot counts
  if (time >= emitter.start - slack && time < emitter.stop - slack) state.due += emitter.rate * dt;
  if (emitter.count) {
    const std::uint64_t given = state.births - state.reborn;
    state.due = std::min(state.due, static_cast<double>(*emitter.count - std::min(*emitter.count, given)));
  }
  return static_cast<std::uint64_t>(std::floor(state.due + 1e-9));  // ten times 0.1 is one
}

}  // namespace

std::vector<Finding> check_state(const EmissionState& state, const Scene& scene) {
  std::vector<Finding> findings;
  if (!state.emitters.empty() && state.emitters.size() != scene.emitters.size()) {
    findings.push_back({"emitters", formatted("{} in the scene, {} in the saved state", scene.emitters.size(),
                                              state.emitters.size())});
  }
  const auto known = [&](const Mortal& m) { return m.emitter < scene.emitters.size(); };
  if (!std::all_of(state.mortals.begin(), state.mortals.end(), known) ||
      !std::is_sorted(state.mortals.begin(), state.mortals.end())) {
    findings.push_back({"emitters", "the saved state's lives are not those of particles of this scene"});
  }
  return findings;
}

void Emission::configure(const Scene& scene) {
  emitters_.resize(scene.emitters.size());
  areas_.clear();
  for (const Emitter& emitter : scene.emitters) areas_.push_back(areas_of_birth(emitter.shape));
}

EmissionState Emission::state() const {
  EmissionState state;
  state.emitters = emitters_;
  for (const auto& [step, mortals] : mortals_) {
    state.mortals.insert(state.mortals.end(), mortals.begin(), mortals.end());
  }
  return state;
}

void Emission::restore(EmissionState state) {
  HOOKE_ASSERT(std::is_sorted(state.mortals.begin(), state.mortals.end()), state.mortals.size());
  emitters_ = std::move(state.emitters);
  mortals_.clear();
  for (const Mortal& m : state.mortals) mortals_[m.death].push_back(m);
}

std::span<const std::uint64_t> Emission::end_lives(std::int64_t step) {
  HOOKE_ASSERT(step > 0, step);
  ending_.clear();
  for (auto due = mortals_.begin(); due != mortals_.end() && due->first <= step; due = mortals_.erase(due)) {
    ending_.insert(ending_.end(), due->second.begin(), due->second.end());
  }
  ending_ids_.clear();
  for (const Mortal& m : ending_) ending_ids_.push_back(m.id);
  return ending_ids_;
}

const ParticleSet& Emission::give_birth(const Scene& scene, std::int64_t step, std::span<const ColliderPose> poses,
                                        std::span<const std::uint8_t> was_there, const Backend& backend, Ranks& ranks,
                                        std::uint64_t& next_id) {
  HOOKE_ASSERT(step > 0, step);
  HOOKE_ASSERT(emitters_.size() == scene.emitters.size(), emitters_.size(), scene.emitters.size());
  HOOKE_ASSERT(poses.size() == scene.colliders.size(), poses.size(), scene.colliders.size());
  HOOKE_ASSERT(was_there.size() == ending_.size(), was_there.size(), ending_.size());
  newborn_.clear();
  for (std::uint32_t i = 0; i < emitters_.size(); ++i) emit(scene, i, step, poses, backend, ranks, next_id);
  for (std::size_t k = 0; k < ending_.size(); ++k) {  // they may be born again from the next step on
    const std::uint32_t emitter = ending_[k].emitter;
    if (was_there[k] != 0 && scene.emitters[emitter].respawn) ++emitters_[emitter].to_respawn;
  }
  return newborn_;
}

void Emission::emit(const Scene& scene, std::uint32_t index, std::int64_t step, std::span<const ColliderPose> poses,
                    const Backend& backend, Ranks& ranks, std::uint64_t& next_id) {
  const Emitter& emitter = scene.emitters[index];
  EmitterState& state = emitters_[index];
  const std::uint64_t wanted = state.to_respawn + births_due(emitter, state, step, scene.time_step);
  if (wanted == 0) return;

  // What is in the way.
  const Material& material = scene.materials[emitter.material];
  const PlacedColliders<double> colliders = place_colliders<double>(scene, poses, material.radius);
  FreeSpace space(scene, emitter.material, colliders.all);
  const double time = static_cast<double>(step) * scene.time_step;
  const PlacedEmitter placed = place_emitter(emitter, index, time, space.reach(), areas_[index]);
  if (material.interacts) {
    Box3d box = placed.body.near;
    for (int axis = 0; axis < 3; ++axis) {  // a particle near across a periodic face is near
      if (scene.domain.boundary[static_cast<std::size_t>(axis)] != Boundary::periodic) continue;
      component(box.min, axis) = component(scene.domain.min, axis);
      component(box.max, axis) = component(scene.domain.max, axis);
    }
    std::vector<Occupant> occupants;
    ranks.find_inside(backend, box, occupants);
    for (const Occupant& occupant : occupants) space.add(occupant);
    for (std::size_t k = 0; k < newborn_.size(); ++k) {
      const Material& other = scene.materials[newborn_.material[k]];
      if (other.interacts) space.add({newborn_.position[k], other.radius});
    }
  }

  find_births(placed, scene, space, backend.info().precision == Precision::single_precision, wanted);
  for (const Birth& birth : births_) {
    if (birth.lifetime) mortals_[step + *birth.lifetime].push_back({step + *birth.lifetime, next_id, index});
    newborn_.id.push_back(next_id++);
    newborn_.material.push_back(static_cast<std::uint16_t>(emitter.material));
    newborn_.position.push_back(birth.position);
    newborn_.velocity.push_back(birth.velocity);
  }
  const std::uint64_t reborn = std::min<std::uint64_t>(births_.size(), state.to_respawn);
  state.births += births_.size();
  state.reborn += reborn;
  state.to_respawn -= reborn;
  state.due = std::max(0.0, state.due - static_cast<double>(births_.size() - reborn));
}

// Finds births up to the first that finds no place. That birth and all that follow wait for another step, which goes on
// with places that have not been tried.
void Emission::find_births(const PlacedEmitter& emitter, const Scene& scene, FreeSpace& space, bool single,
                           std::uint64_t wanted) {
  EmitterState& state = emitters_[emitter.index];
  const Material& material = scene.materials[emitter.emitter->material];
  const auto draw = [&](std::uint64_t k) {
    const std::uint64_t number = state.births + k, first = k == 0 ? state.attempts : 0;
    Birth birth;
    while (birth.attempts < kMostAttempts) {
      birth.position =
          rounded(draw_position(emitter, number, static_cast<std::uint32_t>(first + birth.attempts)), single);
      if (space.has_room_at(birth.position)) break;
      ++birth.attempts;
    }
    birth.velocity = rounded(draw_velocity(emitter, number, birth.position), single);
    birth.lifetime = draw_lifetime(*emitter.emitter, emitter.index, number, scene.time_step);
    return birth;
  };
  const auto failed = [](const Birth& birth) { return birth.attempts == kMostAttempts; };

  births_.clear();
  if (material.interacts) {  // each is in the way of the next
    while (births_.size() < wanted) {
      births_.push_back(draw(births_.size()));
      if (failed(births_.back())) break;
      space.add({births_.back().position, material.radius});
    }
  } else {
    births_.resize(wanted);
    parallel_ranges(wanted, 256, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) births_[k] = draw(k);
    });
  }
  const auto stuck = std::find_if(births_.begin(), births_.end(), failed);
  const bool none_placed = stuck == births_.begin();
  const std::uint64_t in_vain = stuck == births_.end() ? 0 : kMostAttempts;
  state.attempts = in_vain + (none_placed && in_vain > 0 ? state.attempts : 0);
  births_.erase(stuck, births_.end());
}

}  // namespace hooke
