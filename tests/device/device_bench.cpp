// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Rates of a GPU, as CSV: device_bench FILE. Water that stands, water that splashes, sparks and stars; before each
// rate, the same scene at a small size has the CPU's state hash.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "hooke/backends/cpu/cpu_backend.h"
#include "hooke/backends/gpu/cuda_backend.h"
#include "hooke/core/simulation.h"
#include "sample_rate.h"

namespace {

using namespace hooke;

struct Workload {
  Scene scene;
  ParticleSet particles;
};

[[noreturn]] void stop(const Error& error) {
  std::fprintf(stderr, "device_bench: %s\n", error.text().c_str());
  std::exit(1);
}

Scene water_scene(double length, double height, double width) {
  constexpr double kRadius = 0.05, kStiffness = 1000, kMass = 0.5;
  Scene scene;
  Material water;
  water.name = "water";
  water.radius = kRadius;
  water.mass = kMass;
  water.contact = {kStiffness, 0.5, 2};
  scene.materials = {water};
  scene.precision = Precision::single_precision;
  scene.time_step = 0.002;
  scene.gravity = {0, -9.81, 0};
  scene.domain.min = {0, 0, 0};
  scene.domain.max = {length, height, width};
  scene.domain.boundary = {Boundary::spring, Boundary::spring, Boundary::spring};
  return scene;
}

// A block of water, n particles along x and z and m along y, in one corner of a tank `wider` times as long as the
// block.
Workload water(std::size_t n, std::size_t m, double wider) {
  constexpr double kSpacing = 0.098;
  const double side = static_cast<double>(n) * kSpacing, top = static_cast<double>(m) * kSpacing;
  Workload work{water_scene(wider * side, 2 * top, side), {}};
  ParticleSet& p = work.particles;
  p.reserve(n * m * n);
  std::uint64_t id = 1;
  for (std::size_t y = 0; y < m; ++y) {
    for (std::size_t z = 0; z < n; ++z) {
      for (std::size_t x = 0; x < n; ++x) {
        const auto at = [&](std::size_t k) { return (static_cast<double>(k) + 0.5) * kSpacing; };
        const double nudge = 1e-4 * static_cast<double>((x * 7 + y * 13 + z * 29) % 11);
        p.id.push_back(id++);
        p.material.push_back(0);
        p.position.push_back({at(x) + nudge, at(y), at(z) - nudge + 5e-4});
        p.velocity.push_back({0, 0, 0});
      }
    }
  }
  return work;
}

Workload sparks(std::size_t n) {
  Workload work = water(n, n, 1);
  work.scene.materials[0].interacts = false;
  work.scene.materials[0].drag = 0.01;
  return work;
}

Workload stars(std::size_t n) {
  Workload work = sparks(n);
  work.scene.gravity = {0, 0, 0};
  work.scene.attraction.emplace();
  work.scene.attraction->constant = 1e-4;
  work.scene.attraction->softening = 0.05;
  work.scene.attraction->method = Attraction::Method::direct;
  return work;
}

Simulation start(const Workload& work, bool gpu) {
  auto backend =
      gpu ? make_cuda_backend({work.scene.precision, 0, 0}) : make_cpu_backend({work.scene.precision, 0, "", false});
  if (!backend) stop(backend.error());
  auto simulation = Simulation::create(work.scene, work.particles, std::move(*backend), {.allow_unstable_step = true});
  if (!simulation) stop(simulation.error());
  return std::move(*simulation);
}

void advance(Simulation& simulation, std::int64_t steps) {
  if (const auto done = simulation.step(steps); !done) stop(done.error());
}

bool has_the_cpus_bits(const char* name, const Workload& small) {
  Simulation cpu = start(small, false), gpu = start(small, true);
  advance(cpu, 60);
  advance(gpu, 60);
  const bool same = cpu.state_hash() == gpu.state_hash() && cpu.ledger() == gpu.ledger();
  if (!same) std::fprintf(stderr, "device_bench: %s has other bits than on the CPU\n", name);
  return same;
}

// Steps a second over at least a second, after `before` steps.
void measure(std::FILE* csv, const char* name, const Workload& work, std::int64_t before) {
  using Clock = std::chrono::steady_clock;
  Simulation simulation = start(work, true);
  advance(simulation, before);
  const StageTimes stages = simulation.stage_times();
  const std::uint64_t builds = simulation.neighbour_statistics().rebuilds;
  const auto from = Clock::now();
  std::int64_t steps = 0;
  double seconds = 0;
  do {
    advance(simulation, 20);
    steps += 20;
    seconds = std::chrono::duration<double>(Clock::now() - from).count();
  } while (seconds < 1);
  const StageTimes spent = simulation.stage_times() - stages;
  const auto particles = static_cast<double>(simulation.particle_count());
  const double rate = static_cast<double>(steps) / seconds;
  std::fprintf(csv, "%s,%s,%.0f,%.1f,%.3e,%.2f,%.1f,%.1f,%.1f\n", simulation.backend_info().device.c_str(), name,
               particles, rate, rate * particles,
               static_cast<double>(simulation.neighbour_statistics().rebuilds - builds) / static_cast<double>(steps),
               1e6 * spent.force / static_cast<double>(steps),
               1e6 * (spent.sort + spent.list) / static_cast<double>(steps),
               1e6 * spent.motion / static_cast<double>(steps));
  std::fflush(csv);
  if (!work.scene.materials[0].interacts) return;
  // The same state by the scheme of CUDA's own sample, in the same run.
  const double sample = test::sample_rate(work.scene, simulation.particles());
  std::fprintf(csv, "%s,%s by sorting and 27 cells every step,%.0f,%.1f,%.3e,1,,,\n",
               simulation.backend_info().device.c_str(), name, particles, sample, sample * particles);
  std::fflush(csv);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: device_bench FILE\n");
    return 2;
  }
  if (const auto gpu = cuda_device(0); !gpu) stop(gpu.error());
  const bool same = has_the_cpus_bits("water", water(16, 16, 3)) && has_the_cpus_bits("sparks", sparks(16)) &&
                    has_the_cpus_bits("stars", stars(12));
  if (!same) return 1;
  std::FILE* const csv = std::fopen(argv[1], "w");
  if (csv == nullptr) {
    std::fprintf(stderr, "device_bench: %s can't be written\n", argv[1]);
    return 1;
  }
  std::fprintf(csv, "device,workload,particles,steps/s,particle-steps/s,lists/step,us forces,us lists,us motion\n");
  measure(csv, "water at rest", water(80, 80, 1), 400);
  measure(csv, "water in the splash", water(80, 80, 3), 400);
  measure(csv, "water in the splash", water(252, 252, 3), 60);
  measure(csv, "sparks", sparks(252), 20);
  measure(csv, "stars", stars(64), 2);
  return std::fclose(csv) == 0 ? 0 : 1;
}
