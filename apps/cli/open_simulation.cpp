// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "open_simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "hooke/backends/cpu/cpu_backend.h"
#include "hooke/backends/reference/reference_backend.h"
#include "hooke/io/checkpoint.h"
#include "hooke/scene/load_scene.h"

namespace hooke::cli {

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
  LoadOptions options;
  options.overrides = scene.overrides;
  options.allow_outside = scene.allow_outside;
  options.with_particles = resume.empty();
  auto loaded = load_scene(scene.file, options);
  if (!loaded) return fail(std::move(loaded).error());
  auto backend = make_backend(device, loaded->scene.precision);
  if (!backend) return fail(std::move(backend).error());

  auto simulation = [&]() -> Expected<Simulation> {
    if (resume.empty()) {
      return Simulation::create(std::move(loaded->scene), std::move(loaded->particles), std::move(*backend));
    }
    auto checkpoint = read_checkpoint(resume);
    if (!checkpoint) return fail(std::move(checkpoint).error());
    const RunInfo info = describe_run(loaded->scene, (*backend)->info().precision);
    if (auto findings = check_resumable(checkpoint->info, info); !findings.empty()) {
      return fail(Error{Error::Kind::bad_input, std::move(findings)});
    }
    return Simulation::resume(std::move(loaded->scene), std::move(checkpoint->state), std::move(*backend));
  }();
  if (!simulation) return fail(std::move(simulation).error());
  return OpenedSimulation{std::move(*simulation), std::move(loaded->resolved), std::move(loaded->files),
                          std::move(loaded->warnings), loaded->fields};
}

std::string unstable_step(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const StableStep stable = stable_step(simulation);
  if (scene.time_step <= stable.seconds) return {};
  return fmt::format("time.step: {:.6g} s is {:.3g} times the stable step {:.6g} s, which the {} sets", scene.time_step,
                     scene.time_step / stable.seconds, stable.seconds, stable.limit);
}

FloatSpacing float_spacing(const Scene& scene) {
  double farthest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    farthest =
        std::max({farthest, std::abs(component(scene.domain.min, axis)), std::abs(component(scene.domain.max, axis))});
  }
  double radius = INFINITY;
  for (const Material& material : scene.materials) {
    if (material.is_of_particles()) radius = std::min(radius, material.radius);
  }
  const auto edge = static_cast<float>(farthest);
  const double spacing = static_cast<double>(std::nextafter(edge, INFINITY)) - static_cast<double>(edge);
  return {spacing, spacing / radius};
}

std::string coarse_positions(const Simulation& simulation) {
  // docs/determinism.md says how a coarser spacing affects a pile.
  constexpr double kFinest = 1e-4;  // radii
  if (simulation.backend_info().precision == Precision::double_precision) return {};
  const double radii = float_spacing(simulation.scene()).radii;
  if (radii <= kFinest) return {};
  return fmt::format(
      "domain: single precision resolves only {:.3g} radii at its edge ({} is fine), too little for particles at rest "
      "there: set \"precision\": \"double\", or move the domain nearer to 0",
      radii, kFinest);
}

}  // namespace hooke::cli
