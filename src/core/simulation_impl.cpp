// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// What a simulation does on every rank: starts, steps, and says what went wrong.

#include <cmath>
#include <new>
#include <utility>

#include "hooke/base/format.h"
#include "hooke/base/printable.h"
#include "hooke/core/simulation_impl.h"
#include "hooke/core/step.h"

namespace hooke {

const std::shared_ptr<const Snapshot>& Simulation::Impl::snapshot() {
  if (host) return host;
  const std::shared_ptr<Snapshot> now = pool.take();
  now->step = run.step;
  now->time = static_cast<double>(run.step) * scene.time_step;
  gather(now->particles);
  return host = now;
}

Unexpected Simulation::Impl::out_of_memory() {
  failed = true;
  failure = Error{Error::Kind::run_failed, {{formatted("step {}", run.step), "out of memory"}}};
  if (!ranks.is_serial()) ranks.communicator().abort(failure.text());
  return fail(failure);
}

Unexpected Simulation::Impl::device_failed(const DeviceFailure& of_device) {
  failed = true;
  failure = Error{Error::Kind::run_failed, {{backend->info().device, of_device.what()}}};
  return fail(failure);
}

Expected<ParticleAt> Simulation::Impl::find(std::uint64_t id) const {
  if (const auto found = backend->find(id)) return *found;
  return fail(Error::Kind::bad_input, formatted("particle {}", id), "there is none of this id");
}

void Simulation::Impl::edit(const ParticleAt& before, const ParticleAt& after) {
  forget_copies();
  backend->edit({&after, 1});
  const auto stored = backend->find(after.id);  // in the back end's precision
  initial_momentum += mass_of(before.material) * (stored->velocity - before.velocity);
}

Expected<void> Simulation::Impl::check(const Condition& condition) {
  if (condition.good()) return {};
  failed = true;
  failure = Error{Error::Kind::run_failed,
                  {{formatted("step {} (t = {:.6g} s)", run.step, static_cast<double>(run.step) * scene.time_step),
                    describe(condition)}}};
  return fail(failure);
}

std::string Simulation::Impl::describe(const Condition& condition) {
  const double speed = std::abs(condition.speed), moved = speed * scene.time_step;
  const bool part = condition.speed < 0;
  switch (condition.kind) {
    case Condition::Kind::good:
      break;
    case Condition::Kind::not_finite:
      return formatted("particle {} is no longer at a finite position; {}", condition.particle, likely_cause());
    case Condition::Kind::grid_overflow:
      return formatted("particle {} is too far away for the cell grid; {}", condition.particle, likely_cause());
    case Condition::Kind::pair_too_fast:
      return formatted("particles {} and {} {} at {:.6g} m/s, {:.3g} m in one step: {}; {}", condition.particle,
                       condition.partner, part ? "part" : "approach", speed, moved,
                       part ? "they have passed through each other" : "more than the smaller radius", likely_cause());
    case Condition::Kind::wall_too_fast:
      return formatted("particle {} approaches a wall at {:.6g} m/s, {:.3g} m in one step: more than its radius; {}",
                       condition.particle, speed, moved, likely_cause());
    case Condition::Kind::collider_too_fast:
      return formatted("particle {} and collider \"{}\" {} at {:.6g} m/s, {:.3g} m in one step: {}; {}",
                       condition.particle, printable(scene.colliders[condition.partner].name),
                       part ? "part" : "approach", speed, moved,
                       part ? "it has passed through" : "more than the particle's radius", likely_cause());
  }
  return {};
}

std::string Simulation::Impl::likely_cause() {
  ParticleSet now;
  if (scene.structure) {
    download(*backend, scene.integrator, now);
    ranks.gather(now);  // all ranks have found the same condition
  }
  if (!ranks.leads()) return {};
  const StableStep stable = stable_step(scene, now);
  if (std::string unstable = unstable_step(scene, stable); !unstable.empty()) return "time.step " + unstable;
  return formatted(
      "time.step {:.6g} s is below the stable step {:.6g} s, so look at the start (overlaps, speeds) or "
      "take a smaller step",
      scene.time_step, stable.seconds);
}

Expected<void> Simulation::Impl::check_precision() const {
  if (scene.precision == Precision::single_precision || backend->info().precision == scene.precision) return {};
  return fail(Error::Kind::bad_input, "precision",
              "the scene asks for double, the back end computes in single precision");
}

Expected<void> Simulation::Impl::start(const ParticleSlices& particles, bool are_new,
                                       const std::vector<std::uint64_t>& broken_springs) {
  if (auto right = check_precision(); !right) return right;
  if (auto can = check_ranks(); !can) return can;
  const bool take_accelerations = particles.size() > 0 && are_new;
  lead_start(take_accelerations, broken_springs);
  return start_here(particles, take_accelerations, broken_springs);
}

Expected<void> Simulation::Impl::start_here(const ParticleSlices& particles, bool take_accelerations,
                                            const std::vector<std::uint64_t>& broken_springs) {
  forget_copies();
  try {
    backend->configure(scene);
    run.emission.configure(scene);
    backend->break_springs(broken_springs);
    place_colliders(run, scene, run.step);
    if (auto assigned = ranks.assign(*backend, scene, particles); !assigned) {
      failed = true;
      failure = assigned.error();
      return assigned;
    }
    if (!take_accelerations) return {};
    return check(start_particles(scene, *backend, ranks, run));
  } catch (const std::bad_alloc& memory) {
    const std::string why = memory.what();  // a GPU says how much it lacks
    failed = true;
    failure = Error{Error::Kind::bad_input,
                    {{"particles", formatted("{} particles do not fit into memory{}", particles.size(),
                                             why == std::bad_alloc().what() ? "" : " (" + why + ")")}}};
    if (!ranks.is_serial()) ranks.communicator().abort(failure.text());
    return fail(failure);
  } catch (const DeviceFailure& of_device) {
    return device_failed(of_device);
  }
}

Expected<void> Simulation::Impl::take_steps(std::int64_t count) {
  lead(Order::step, count);
  return guarded([&]() -> Expected<void> {
    if (count == 0) return {};
    forget_copies();
    for (const std::int64_t last = run.step + count; run.step < last;) {
      if (auto taken = check(take_step(scene, *backend, ranks, run, last - run.step)); !taken) return taken;
    }
    // Particles that the last step has lost are reported before the state can be saved.
    return check(update_neighbours(*backend, ranks));
  });
}

}  // namespace hooke
