// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/step.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace hooke {

namespace {

Instant place_colliders(std::vector<ColliderPose>& poses, const Scene& scene, std::int64_t step) {
  const double time = static_cast<double>(step) * scene.time_step;
  poses.clear();
  for (const Collider& collider : scene.colliders) poses.push_back(pose_at(collider, time));
  return {time, poses};
}

// Symplectic Euler's forces of up to `most` steps in a row, the first at `now`. Returns how many were taken.
std::int64_t apply_forces_in_a_row(const Scene& scene, Backend& backend, const RunState& run, const Instant& now,
                                   std::int64_t most, StepReport& report) {
  std::vector<Instant> steps{now};
  std::vector<std::vector<ColliderPose>> poses(static_cast<std::size_t>(most - 1));
  for (std::vector<ColliderPose>& of_step : poses) {
    steps.push_back(place_colliders(of_step, scene, run.step + static_cast<std::int64_t>(steps.size())));
    steps.back().moved = true;
  }
  return static_cast<std::int64_t>(backend.apply_forces_in_a_row(steps, report));
}

}  // namespace

// Algorithm 3 of the thesis, with what has been added to it since: the cell list is rebuilt when it must be rather than
// in every step, velocity Verlet has a half step of its own in front, and particles come and go at the end.
Condition take_step(const Scene& scene, Backend& backend, Ranks& ranks, RunState& run, std::int64_t most) {
  const bool verlet = scene.integrator == Integrator::velocity_verlet;
  const auto finish_motion = [&](const Condition& found) {
    const Condition on_any_rank = ranks.follow_motion(backend, found);
    RemovalSums left;
    backend.remove_departed(left);
    run.ledger.book_left(left);
    return on_any_rank;
  };

  // 1. Velocity Verlet moves first, with half a kick by the accelerations of the last step. Its forces are those at the
  //    time of arrival; symplectic Euler's are those at the start.
  Instant now = place_colliders(run, scene, verlet ? run.step + 1 : run.step);
  now.moved = verlet || run.step > 0;
  if (verlet) {
    backend.half_kick_and_drift();
    (void)finish_motion({});
  }

  // 2. Cells, sorting, neighbour lists: when a pair that is on no list could touch.
  if (const Condition found = update_neighbours(backend, ranks); !found.good()) return found;

  // 3. All forces (contacts, walls, colliders, drag, gravity, springs, fields, attraction), and in the same pass the
  //    kick: Verlet's second half, or symplectic Euler's whole one and its drift.
  StepReport report;
  if (verlet || !scene.sinks.empty() || !scene.emitters.empty() || !ranks.is_serial()) most = 1;
  most = std::min(most, static_cast<std::int64_t>(backend.most_in_a_row()));
  if (most > 1) {
    run.step += apply_forces_in_a_row(scene, backend, run, now, most, report) - 1;
  } else {
    const Ranks::ForcePass timed(ranks, backend);
    backend.apply_forces(now, report);
  }
  run.ledger.book_step(report, scene);
  const Condition found = verlet ? ranks.first(report.condition) : finish_motion(report.condition);
  if (!found.good()) return found;

  // 4. The step is done. Sinks take particles, lives end, emitters give birth.
  const std::int64_t arrival = ++run.step;
  if (!verlet) place_colliders(run, scene, arrival);
  if (!scene.sinks.empty()) {
    run.ledger.book_sunk(ranks.remove_sunk(backend));
  }
  if (!scene.emitters.empty()) {
    const Removal expired = ranks.remove(backend, run.emission.end_lives(arrival));
    run.ledger.book_expired(expired.sums);
    const ParticleSet& newborn =
        run.emission.give_birth(scene, arrival, run.poses, expired.was_there, backend, ranks, run.next_id);
    run.ledger.book_born(ranks.insert(backend, scene, newborn));
  }
  return {};
}

Instant place_colliders(RunState& run, const Scene& scene, std::int64_t step) {
  return place_colliders(run.poses, scene, step);
}

Condition update_neighbours(Backend& backend, Ranks& ranks) {
  return ranks.neighbours_stale(backend) ? ranks.build_neighbours(backend) : Condition{};
}

Condition start_particles(const Scene& scene, Backend& backend, Ranks& ranks, RunState& run) {
  if (scene.integrator != Integrator::velocity_verlet) return {};
  if (const Condition found = update_neighbours(backend, ranks); !found.good()) return found;
  StepReport report;
  backend.evaluate_accelerations(place_colliders(run, scene, run.step), report);
  if (const Condition found = ranks.first(report.condition); !found.good()) return found;
  run.ledger.book_start(report, scene);
  return {};
}

}  // namespace hooke
