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
    ranks.sum(left);
    left.book(run.ledger);
  };

  // 1. Velocity Verlet moves first, with half a kick by the accelerations of the last step. Its forces are those at the
  //    time of arrival; symplectic Euler's are those at the start.
  const Instant now = place_colliders(run, scene, verlet ? arrival : run.step);
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
  ranks.sum(report);
  book_step(run.ledger, report, scene.gravity, scene.time_step, scene.integrator);
  if (!verlet) finish_motion();
  if (!report.condition.good()) return report.condition;

  // 4. The step is done. Sinks take particles, lives end, emitters give birth.
  run.step = arrival;
  if (!verlet) place_colliders(run, scene, arrival);
  if (!scene.sinks.empty()) {
    RemovalSums sunk = backend.remove_sunk();
    ranks.sum(sunk);
    sunk.book_gone(run.ledger, run.ledger.population.sunk);
  }
  if (!scene.emitters.empty()) {
    Removal expired = backend.remove(run.emission.end_lives(arrival));
    ranks.sum(expired.sums);
    expired.sums.book_gone(run.ledger, run.ledger.population.expired);
    const ParticleSet& newborn =
        run.emission.give_birth(scene, arrival, run.poses, expired.was_there, backend, run.next_id);
    RemovalSums born = backend.insert(newborn);
    ranks.sum(born);
    born.book_born(run.ledger);
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

Condition start_particles(const Scene& scene, Backend& backend, Communicator& ranks, std::uint64_t first_new_id,
                          RunState& run) {
  if (scene.integrator != Integrator::velocity_verlet) return {};
  if (const Condition found = update_neighbours(backend, ranks); !found.good()) return found;
  StepReport report;
  backend.evaluate_accelerations(place_colliders(run, scene, run.step), first_new_id, report);
  ranks.sum(report);
  if (!report.condition.good()) return report.condition;
  run.ledger.last = first_rates(report, scene.gravity);
  return {};
}

}  // namespace hooke
