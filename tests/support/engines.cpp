// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "support/engines.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

#include "hooke/backends/cpu/cpu_backend.h"
#include "hooke/backends/cpu/isa.h"
#include "hooke/backends/reference/reference_backend.h"
#include "support/gpu_on_host.h"

namespace hooke::test {
namespace {

Simulation must(Expected<Simulation> simulation) {
  if (!simulation) {
    ADD_FAILURE() << simulation.error().text();
    throw std::runtime_error("no simulation");
  }
  return std::move(*simulation);
}

}  // namespace

std::string Engine::name() const {
  if (device == "reference") return device;
  return device + (precision == Precision::single_precision ? "_single" : "_double") + (isa.empty() ? "" : "_" + isa);
}

std::vector<Engine> engines_with_the_same_bits(Precision precision) {
  std::vector<Engine> engines;
  for (const Isa& isa : available_isas()) engines.push_back({"cpu", precision, 3, isa.name});
  for (const gpu::ItemOrder order : {gpu::ItemOrder::shuffled, gpu::ItemOrder::down})
    engines.push_back({"gpu", precision, 1, "", false, order});
  return engines;
}

std::unique_ptr<Backend> make_backend(const Engine& engine) {
  if (engine.device == "reference") return make_reference_backend();
  if (engine.device == "gpu") return make_gpu_on_host(engine.precision, engine.threads, engine.item_order);
  auto backend = make_cpu_backend({engine.precision, engine.threads, engine.isa, engine.check_list});
  if (!backend) {
    ADD_FAILURE() << backend.error().text();
    throw std::runtime_error("no back end");
  }
  return std::move(*backend);
}

Simulation simulate(Scene scene, const ParticleSet& particles, const Engine& engine) {
  scene.precision = engine.precision;
  return must(Simulation::create(std::move(scene), particles, make_backend(engine), {.allow_unstable_step = true}));
}

Simulation resume(Scene scene, const SimulationState& state, const Engine& engine) {
  scene.precision = engine.precision;
  return must(Simulation::resume(std::move(scene), state, make_backend(engine)));
}

bool advance(Simulation& simulation, std::int64_t steps) {
  const auto taken = simulation.step(steps);
  if (!taken) ADD_FAILURE() << taken.error().text();
  return taken.has_value();
}

Measurements measured(const Simulation& simulation) {
  const auto now = simulation.measure();
  if (!now) {
    ADD_FAILURE() << now.error().text();
    return {};
  }
  return *now;
}

double accounted_energy(const Simulation& simulation) {
  const Measurements now = measured(simulation);
  const Ledger& ledger = simulation.ledger();
  return now.kinetic_energy + now.potential_energy + now.elastic_energy + now.spring_energy + now.attraction_energy +
         ledger.dissipated() + ledger.springs.dissipated + ledger.springs.broken_energy + ledger.removed_energy +
         ledger.removed_elastic - ledger.population.born_energy - ledger.work[Cause::wall] -
         ledger.work[Cause::collider] - ledger.work[Cause::hold] - ledger.work[Cause::field] -
         ledger.work[Cause::external];
}

}  // namespace hooke::test
