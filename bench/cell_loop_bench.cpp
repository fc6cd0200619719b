// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Speed of the plain loop over 27 cells, cell_loop.h, for a scene of one material. Prints the fields of
// `hooke bench --json` that it knows. Prints no speed where its positions differ from Hooke's.
//   hooke_cell_loop SCENE STEPS THREADS

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "cell_loop.h"
#include "hooke/backends/cpu/cpu_backend.h"
#include "hooke/base/threads.h"
#include "hooke/core/simulation.h"
#include "hooke/io/snapshot.h"
#include "hooke/scene/load_scene.h"

namespace hooke::bench {
namespace {

constexpr int kCheckedSteps = 20;
constexpr double kAllowed = 1e-3;  // of a radius, after those steps

int complain(const std::string& what) {
  std::fprintf(stderr, "hooke_cell_loop: %s\n", what.c_str());
  return EXIT_FAILURE;
}

// How far the loop's particles are from Hooke's, m.
template <class Real>
double largest_difference(const CellLoop<Real>& loop, const Simulation& simulation) {
  double largest2 = 0;
  for (const auto& p : loop.particles()) {
    const Vec3d apart = vec_cast<double>(p.x) - simulation.positions()[p.index];
    largest2 = std::max(largest2, dot(apart, apart));
  }
  return std::sqrt(largest2);
}

template <class Real>
int measure(const scene::LoadedScene& loaded, int steps, int threads) {
  const Scene& scene = loaded.scene;
  auto backend = make_cpu_backend({.precision = scene.precision, .threads = threads, .isa = ""});
  if (!backend) return complain(backend.error().text());
  auto simulation = Simulation::create(scene, loaded.particles, std::move(*backend));
  if (!simulation) return complain(simulation.error().text());
  if (auto stepped = simulation->step(kCheckedSteps); !stepped) return complain(stepped.error().text());

  CellLoop<Real> loop(scene, loaded.particles);
  for (int i = 0; i < kCheckedSteps; ++i) loop.step();
  const double difference = largest_difference(loop, *simulation) / scene.materials[0].radius;
  if (!(difference < kAllowed)) {
    return complain("particles are " + std::to_string(difference) + " radii from where Hooke has them");
  }
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < steps; ++i) loop.step();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  nlohmann::ordered_json json;
  json["particles"] = loaded.particles.size();
  json["steps"] = steps;
  json["seconds"] = seconds;
  json["particle_steps_per_second"] = static_cast<double>(loaded.particles.size()) * steps / seconds;
  json["threads"] = threads;
  json["isa"] = "scalar";
  json["precision"] = to_string(scene.precision);
  json["difference"] = difference;
  std::printf("%s\n", json.dump(2).c_str());
  return EXIT_SUCCESS;
}

bool has_only_walls(const Domain& domain) {
  return std::all_of(domain.boundary.begin(), domain.boundary.end(), [](Boundary b) { return b == Boundary::spring; });
}

int run(int argc, char** argv) {
  if (argc != 4) return complain("SCENE, STEPS and THREADS are wanted");
  const int steps = std::atoi(argv[2]), threads = std::atoi(argv[3]);
  if (steps < 1 || threads < 1) return complain("STEPS and THREADS are at least 1");
  const auto loaded = scene::load_scene(argv[1], {});
  if (!loaded) return complain(loaded.error().text());
  const Scene& scene = loaded->scene;
  if (scene.materials.size() != 1 || scene.materials[0].drag > 0 || !has_only_walls(scene.domain) ||
      scene.integrator != Integrator::symplectic_euler) {
    return complain("one material without drag, spring walls and symplectic Euler are all that it can do");
  }
  int status = 1;
  Threads(threads).run([&] {
    status = scene.precision == Precision::single_precision ? measure<float>(*loaded, steps, threads)
                                                            : measure<double>(*loaded, steps, threads);
  });
  return status;
}

}  // namespace
}  // namespace hooke::bench

int main(int argc, char** argv) { return hooke::bench::run(argc, argv); }
