// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// How a simulation starts with particles that come in slices, or from a saved state.

#include <utility>

#include "hooke/base/ascending.h"
#include "hooke/base/floating_point.h"
#include "hooke/base/format.h"
#include "hooke/core/particle_checks.h"
#include "hooke/core/simulation_impl.h"

namespace hooke {
namespace {

bool is_several(const std::shared_ptr<Communicator>& communicator) {
  return communicator != nullptr && communicator->size() > 1;
}

}  // namespace

Expected<Simulation> Simulation::Impl::begin(std::unique_ptr<Impl> started) {
  Simulation simulation(std::move(started));
  const auto now = simulation.measure();
  if (!now) return fail(now.error());
  const double elastic = now->elastic_energy + now->spring_energy;
  simulation.impl_->initial_elastic = elastic;
  simulation.impl_->initial_energy = now->kinetic_energy + now->potential_energy + elastic + now->attraction_energy;
  simulation.impl_->initial_momentum = now->momentum;
  return simulation;
}

Expected<Simulation> Simulation::create_in_slices(Scene scene, std::shared_ptr<const ParticleSlices> particles,
                                                  std::unique_ptr<Backend> backend, const CreateOptions& options) {
  // Springs tie particles anywhere.
  if (!is_several(options.communicator) || scene.structure) {
    auto all = collected(*particles);
    if (!all) {
      const Impl ends_the_others(options.communicator);
      return fail(std::move(all).error());
    }
    particles = nullptr;
    return create(std::move(scene), std::move(*all), std::move(backend), options);
  }
  auto impl = std::make_unique<Impl>(options.communicator);
  if (backend == nullptr) return no_backend();
  const FloatingPointGuard guard;
  std::uint64_t largest_id = 0;
  std::vector<Finding> findings = validate(scene);
  if (findings.empty()) {
    auto of_particles = check_particles(scene, *particles, false, largest_id);
    if (!of_particles) return fail(std::move(of_particles).error());
    findings = std::move(*of_particles);
  }
  if (findings.empty() && !options.allow_unstable_step) {
    std::string unstable = unstable_step(scene, stable_step(scene));
    if (!unstable.empty()) findings.push_back({"time.step", std::move(unstable)});
  }
  if (!findings.empty()) return fail(Error{Error::Kind::bad_input, std::move(findings)});
  impl->scene = std::move(scene);
  impl->backend = std::move(backend);
  impl->run.next_id = largest_id + 1;
  if (auto started = impl->start(*particles, true, {}); !started) return fail(started.error());
  particles = nullptr;  // measuring may need the room
  return Impl::begin(std::move(impl));
}

Expected<Simulation> Simulation::resume_in_slices(Scene scene, SimulationState state,
                                                  std::shared_ptr<const ParticleSlices> particles,
                                                  std::unique_ptr<Backend> backend,
                                                  std::shared_ptr<Communicator> communicator) {
  auto impl = std::make_unique<Impl>(std::move(communicator));
  if (backend == nullptr) return no_backend();
  const FloatingPointGuard guard;
  std::vector<Finding> findings = validate(scene);
  if (!findings.empty()) return fail(Error{Error::Kind::bad_input, std::move(findings)});
  std::uint64_t largest_id = 0;
  auto of_particles = check_particles(scene, *particles, true, largest_id);
  if (!of_particles) return fail(std::move(of_particles).error());
  impl->scene = std::move(scene);
  impl->backend = std::move(backend);
  auto restored = impl->restore(state, *particles, std::move(*of_particles), largest_id);
  if (!restored) return fail(std::move(restored).error());
  return Simulation(std::move(impl));
}

Expected<void> Simulation::Impl::restore(SimulationState& state, const ParticleSlices& particles,
                                         std::vector<Finding> findings, std::uint64_t largest_id) {
  if (state.step < 0) findings.push_back({"step", formatted("{} must be 0 or more", state.step)});
  if (particles.size() > 0 && largest_id >= state.next_id) {
    findings.push_back({"next_id", formatted("{} is not above the largest id {}", state.next_id, largest_id)});
  }
  const auto& tied = scene.structure ? scene.structure : state.structure;
  if (tied && findings.empty()) findings = validate(*tied, single());
  const std::size_t springs = tied ? tied->springs.size() : 0;
  if (!is_ascending(state.broken_springs)) {
    findings.push_back({"broken_springs", "indices must be unique and ascending"});
  } else if (!state.broken_springs.empty() && state.broken_springs.back() >= springs) {
    findings.push_back(
        {"broken_springs", formatted("{} is no spring; there are {}", state.broken_springs.back(), springs)});
  }
  for (Finding& finding : check_state(state.emission, scene)) findings.push_back(std::move(finding));
  if (!findings.empty()) return fail(Error{Error::Kind::bad_input, std::move(findings)});
  scene.structure = tied;
  run.emission.restore(std::move(state.emission));
  run.step = state.step;
  run.next_id = state.next_id;
  run.ledger = state.ledger;
  initial_energy = state.initial_energy;
  initial_elastic = state.initial_elastic;
  initial_momentum = state.initial_momentum;
  failed = false;
  return start(particles, false, state.broken_springs);
}

}  // namespace hooke
