// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Speed of particles that touch no others, in whole steps: sparks that rise, fall, bounce off a ball and a floor, die
// and are born again. A wrong result has no speed: no spark may be lost or lit twice, and momentum must be accounted
// for.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <utility>

#include "measured_steps.h"

namespace hooke::bench {
namespace {

Scene sparks(const benchmark::State& state) {
  Scene scene;
  scene.time_step = 5e-3;
  scene.precision = precision_of(state);
  scene.domain = {{-50, -1, -50}, {50, 60, 50}, {Boundary::open, Boundary::open, Boundary::open}};
  Material spark;
  spark.name = "spark";
  spark.radius = 0.1;
  spark.mass = 0.01;
  spark.contact = {20, 0, 0.01};
  spark.drag = 1e-3;
  spark.interacts = false;
  scene.materials = {spark};
  Collider floor, ball;
  floor.name = "floor";
  floor.shape = PlaneShape{{0, 0, 0}, {0, 1, 0}};
  ball.name = "ball";
  ball.shape = SphereShape{{0, 4, 0}, 1};
  scene.colliders = {floor, ball};
  Emitter fountain;
  fountain.name = "fountain";
  fountain.shape = DiscShape{{0, 0.3, 0}, {0, 1, 0}, 1};
  fountain.count = static_cast<std::uint64_t>(state.range(0));
  fountain.rate = static_cast<double>(state.range(0)) / scene.time_step;  // all in the first step
  fountain.speed = {8, 16};
  fountain.spread = 30;
  fountain.life = Range{1, 3};
  fountain.respawn = true;
  scene.emitters = {fountain};
  return scene;
}

void spark_steps(benchmark::State& state) {
  const auto count = static_cast<std::uint64_t>(state.range(0));
  auto simulation = simulate(state, sparks(state), {});
  if (!simulation) return state.SkipWithError(simulation.error().text().c_str());
  // Warm up until lives of every length have ended: from then on as many sparks die in each step.
  const auto now = run_steps(state, *simulation, 700);
  if (!now) return state.SkipWithError(now.error().text().c_str());
  const Ledger& ledger = simulation->ledger();
  const PopulationLedger& population = ledger.population;
  const std::uint64_t waiting = simulation->state().emission.emitters[0].to_respawn;
  if (population.born != population.expired + ledger.removed + now->particles ||
      now->particles + waiting + ledger.removed != count || population.expired < count) {
    return state.SkipWithError("particles are lost or too many");
  }
  if (!(ledger.impulse[Cause::collider].y > 0)) return state.SkipWithError("nobody bounces");
  state.SetLabel(simulation->backend_info().isa);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
  state.counters["deaths_a_step"] =
      static_cast<double>(population.expired) / static_cast<double>(simulation->step_count());
}
BENCHMARK(spark_steps)
    ->ArgNames({"sparks", "double", "threads"})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Args({100000, 0, 2})
    ->Args({1000000, 0, 1})
    ->Args({1000000, 0, 2})
    ->Args({1000000, 1, 2});

}  // namespace
}  // namespace hooke::bench
