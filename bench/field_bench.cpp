// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// What fields cost in whole steps: a block of 512,000 balls in a box, by itself and with each kind of field. A wrong
// result has no speed: a uniform push must give the known momentum, other fields must push the way they point, and
// momentum must be accounted for.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "block_of_balls.h"
#include "measured_steps.h"

namespace hooke::bench {
namespace {

constexpr double kPush = 0.5;  // m/s^2

struct Surroundings {
  const char* name;
  std::vector<Field> fields;
};

template <class Law>
Field field(const Law& law) {
  Field made;
  made.law = law;
  return made;
}

Surroundings surroundings(std::int64_t choice) {
  const Field push = field(UniformPush{{kPush, 0, 0}});
  Wind steady{{2, 0, 0}, 0.5, 0, {}}, gusts = steady;
  gusts.gust = Gust{{0.5, 0, 0}, 2, 4};
  PushToward walkers;
  walkers.point = {2 * kBlockEdge, 0, 0};
  walkers.speed = 1;
  walkers.time = 0.5;
  switch (choice) {
    case 0:
      return {"none", {}};
    case 1:
      return {"uniform", {push}};
    case 2:
      return {"wind", {field(steady)}};
    case 3:
      return {"gusts that travel", {field(gusts)}};
    case 4:
      return {"toward", {field(walkers)}};
    default:
      return {"uniform, wind and toward", {push, field(steady), field(walkers)}};
  }
}

void field_steps(benchmark::State& state) {
  const Surroundings around = surroundings(state.range(0));
  Scene scene = block_of_balls_scene(precision_of(state));
  scene.fields = around.fields;
  const ParticleSet balls = block_of_balls([](const Vec3d&) { return false; });
  auto simulation = simulate(state, std::move(scene), balls);
  if (!simulation) return state.SkipWithError(simulation.error().text().c_str());
  const auto now = run_steps(state, *simulation, 20);
  if (!now) return state.SkipWithError(now.error().text().c_str());
  const Vec3d given = simulation->ledger().impulse[Cause::field];
  if (state.range(0) == 1) {
    const double pushed = kPush * kBallMass * static_cast<double>(kBallsInBlock) * simulation->time();
    if (!(std::abs(given.x - pushed) < 1e-9 * pushed)) return state.SkipWithError("the push is another one");
  }
  if (state.range(0) > 0 && !(given.x > 0)) return state.SkipWithError("nobody is pushed along x");
  state.SetLabel(std::string(around.name) + ", " + simulation->backend_info().isa);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kBallsInBlock));
}
BENCHMARK(field_steps)
    ->ArgNames({"field", "double", "threads"})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->ArgsProduct({{0, 1, 2, 3, 4, 5}, {0}, {2}})
    ->ArgsProduct({{0, 1}, {1}, {2}});

}  // namespace
}  // namespace hooke::bench
