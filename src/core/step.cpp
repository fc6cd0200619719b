// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/step.h"

namespace hooke {

// Algorithm 3 of the thesis, with what has been added to it since: the cell list is rebuilt when it must be rather than
// in every step, velocity Verlet has a half step of its own in front, and particles come and go at the end.
Condition take_step(const Scene& scene, Backend& backend, Communicator& ranks, RunState& run) {
  const bool verlet = scene.integrator == Integrator::velocity_verlet;
  const std::int64_t arrival = run.step + 1;
  const auto finish_motion = [&] {
    ranks.update(backend);
    RemovalSums left;
    backend.finish_motion(left);
    run.ledger.book_left(left);
  };

  // 1. Velocity Verlet moves first, with half a kick by the accelerations of the last step. Its forces are those at the
  //    time of arrival; symplectic Euler's are those at the start.
  Instant now = place_colliders(run, scene, verlet ? arrival : run.step);
  now.moved = verlet || run.step > 0;
  if (verlet) {
    backend.half_kick_and_drift();
    finish_motion();
  }

  // 2. Cells, sorting, neighbour lists: when a pair that is on no list could touch.
  if (const Condition found = update_neighbours(backend, ranks); !found.good()) return found;

  // 3. All forces (contacts, walls, colliders, drag, gravity, springs, fields, attraction), and in the same pass the
  //    kick: Verlet's second half, or symplectic Euler's whole one and its drift.
  StepReport report;
  backend.apply_forces(now, report);
  run.ledger.book_step(report, scene);
  if (!verlet) finish_motion();
  if (const Condition found = ranks.first(report.condition); !found.good()) return found;

  // 4. The step is done. Sinks take particles, lives end, emitters give birth.
  run.step = arrival;
  if (!verlet) place_colliders(run, scene, arrival);
  if (!scene.sinks.empty()) {
    run.ledger.book_sunk(backend.remove_sunk());
  }
  if (!scene.emitters.empty()) {
    const Removal expired = backend.remove(run.emission.end_lives(arrival));
    run.ledger.book_expired(expired.sums);
    const ParticleSet& newborn =
        run.emission.give_birth(scene, arrival, run.poses, expired.was_there, backend, run.next_id);
    run.ledger.book_born(backend.insert(newborn));
  }
  return {};
}

Instant place_colliders(RunState& run, const Scene& scene, std::int64_t step) {
  const double time = static_cast<double>(step) * scene.time_step;
  run.poses.clear();
  for (const Collider& collider : scene.colliders) run.poses.push_back(pose_at(collider, time));
  return {time, run.poses};
}

Condition update_neighbours(Backend& backend, Communicator& ranks) {
  if (!ranks.any(backend.neighbours_stale())) return {};
  ranks.migrate(backend);
  return ranks.first(backend.build_neighbours());
}

Condition start_particles(const Scene& scene, Backend& backend, Communicator& ranks, RunState& run) {
  if (scene.integrator != Integrator::velocity_verlet) return {};
  if (const Condition found = update_neighbours(backend, ranks); !found.good()) return found;
  StepReport report;
  backend.evaluate_accelerations(place_colliders(run, scene, run.step), report);
  if (const Condition found = ranks.first(report.condition); !found.good()) return found;
  run.ledger.book_start(report, scene);
  return {};
}

}  // namespace hooke
