// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/open_simulation.h"

#include <cstdlib>
#include <utility>

#include "hooke/backends/cpu/cpu_backend.h"
#include "hooke/backends/reference/reference_backend.h"
#include "hooke/io/checkpoint.h"

namespace hooke::run {

Expected<std::unique_ptr<Backend>> make_backend(const DeviceArguments& arguments, Precision precision) {
  if (arguments.device == "reference") return make_reference_backend();
  CpuOptions options;
  options.precision = precision;
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
  auto backend = make_backend(device, loaded.scene.precision);
  if (!backend) return fail(std::move(backend).error());

  auto simulation = [&]() -> Expected<Simulation> {
    if (resume.empty()) {
      return Simulation::create(std::move(loaded.scene), std::move(loaded.particles), std::move(*backend),
                                {.allow_unstable_step = true});  // start_checks.h warns of it
    }
    auto checkpoint = io::read_checkpoint(resume);
    if (!checkpoint) return fail(std::move(checkpoint).error());
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
