// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/open_simulation.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "hooke/backends/cpu/cpu_backend.h"
#include "hooke/backends/gpu/cuda_backend.h"
#include "hooke/backends/reference/reference_backend.h"
#include "hooke/base/format.h"
#include "hooke/io/checkpoint.h"
#include "hooke/run/cuda_loader.h"

namespace hooke::run {

namespace {

Expected<std::unique_ptr<Backend>> make_gpu_backend(const DeviceArguments& arguments, const Scene& scene,
                                                    std::size_t particles) {
  const auto gpu = find_cuda_device(0);
  if (!gpu) return fail(gpu.error());
  if (std::vector<Finding> refusals = cuda_refusals(scene, particles); !refusals.empty())
    return fail(Error{Error::Kind::bad_input, std::move(refusals)});
  const std::uint64_t room =
      std::min(gpu->free_memory / cuda_bytes_per_particle(scene.precision, scene.integrator), kMostCudaParticles);
  if (particles > room) {
    return fail(Error::Kind::bad_input, "cuda",
                formatted("{} has {} MiB free, room for about {} particles; the scene has {}", gpu->name,
                          gpu->free_memory >> 20U, room, particles));
  }
  CudaOptions options;
  options.precision = scene.precision;
  options.threads = arguments.threads;
  return load_cuda_backend(options);
}

}  // namespace

Expected<std::unique_ptr<Backend>> make_backend(const DeviceArguments& arguments, const Scene& scene,
                                                std::size_t particles, std::vector<Finding>& findings) {
  if (arguments.device == "reference") return make_reference_backend();
  if (arguments.device == "cuda" || arguments.device == "auto") {
    auto backend = make_gpu_backend(arguments, scene, particles);
    if (backend || arguments.device == "cuda") return backend;
    findings.push_back({"device", "\"auto\" takes the CPU: " + backend.error().text()});
  }
  CpuOptions options;
  options.precision = scene.precision;
  options.threads = arguments.threads;
  if (const char* isa = std::getenv("HOOKE_ISA"); isa != nullptr) options.isa = isa;
  return make_cpu_backend(options);
}

Expected<OpenedSimulation> open_simulation(const SceneArguments& scene, const DeviceArguments& device,
                                           const std::filesystem::path& resume) {
  scene::LoadOptions options;
  options.overrides = scene.overrides;
  options.allow_outside = scene.allow_outside;
  options.with_particles = resume.empty();
  auto loaded = scene::load_scene(scene.file, options);
  if (!loaded) return fail(std::move(loaded).error());
  return open_simulation(std::move(*loaded), device, resume);
}

Expected<OpenedSimulation> open_simulation(scene::LoadedScene loaded, const DeviceArguments& device,
                                           const std::filesystem::path& resume) {
  Expected<io::Checkpoint> checkpoint;
  if (!resume.empty()) {
    checkpoint = io::read_checkpoint(resume);
    if (!checkpoint) return fail(std::move(checkpoint).error());
  }
  const std::size_t particles = resume.empty() ? loaded.particles.size() : checkpoint->state.particles.size();
  auto backend = make_backend(device, loaded.scene, particles, loaded.warnings);
  if (!backend) return fail(std::move(backend).error());

  auto simulation = [&]() -> Expected<Simulation> {
    if (resume.empty()) {
      return Simulation::create(std::move(loaded.scene), std::move(loaded.particles), std::move(*backend),
                                {.allow_unstable_step = true});  // start_checks.h warns of it
    }
    const io::RunInfo info = io::describe_run(loaded.scene, (*backend)->info().precision);
    if (auto findings = io::check_resumable(checkpoint->info, info); !findings.empty()) {
      return fail(Error{Error::Kind::bad_input, std::move(findings)});
    }
    return Simulation::resume(std::move(loaded.scene), std::move(checkpoint->state), std::move(*backend));
  }();
  if (!simulation) return fail(std::move(simulation).error());
  const std::int64_t step = simulation->step_count();
  return OpenedSimulation{std::move(*simulation),  std::move(loaded.resolved),
                          std::move(loaded.files), std::move(loaded.warnings),
                          loaded.fields,           step};
}

}  // namespace hooke::run
