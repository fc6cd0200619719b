// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/cpu_backend.h"

#include <algorithm>
#include <memory>
#include <thread>

#include "hooke/backends/cpu/cpu_backend_impl.h"
#include "hooke/base/format.h"

namespace hooke {

template <class Real>
void CpuBackend<Real>::configure(const Scene& scene) {
  scene_ = scene;
  rules_ = PassRules<Real>(scene);
  colliders_ = {};
  particles_.configure(scene_, rules_);
  list_.configure(rules_, loops_.search_window, applied_.springs().exclusions());
  applied_.configure(scene, rules_.view(), loops_);
  sinks_ = PlacedSinks(scene.sinks);
}

// Replaces all particles by these, with room for at least so many births.
template <class Real>
void CpuBackend<Real>::take(const ParticleSet& particles, std::size_t births) {
  particles_.place(particles, births);
  forget_layout();
}

template <class Real>
void CpuBackend<Real>::forget_layout() {
  list_.invalidate();
  leaving_ = {};
  copied_.clear();
  ghost_slots_.clear();
  leaving_ghosts_.clear();
  applied_.bind(particles_);
}

template class CpuBackend<float>;
template class CpuBackend<double>;

Expected<std::unique_ptr<Backend>> make_cpu_backend(const CpuOptions& options) {
  constexpr int kMostThreads = 1024;
  if (options.threads < 0 || options.threads > kMostThreads) {
    return fail(Error::Kind::bad_input, "threads", formatted("{} is not between 1 and 1024", options.threads));
  }
  const auto isa = choose_isa(options.isa);
  if (!isa) return fail(isa.error());
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int threads = options.threads > 0 ? options.threads : cores;
  if (options.precision == Precision::single_precision) {
    return std::make_unique<CpuBackend<float>>(*isa, isa->single_loops, threads, options.check_list);
  }
  return std::make_unique<CpuBackend<double>>(*isa, isa->double_loops, threads, options.check_list);
}

}  // namespace hooke
