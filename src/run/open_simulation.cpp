// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/open_simulation.h"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include "hooke/backends/cpu/cpu_backend.h"
#include "hooke/backends/gpu/cuda_backend.h"
#include "hooke/backends/reference/reference_backend.h"
#include "hooke/base/format.h"
#include "hooke/io/checkpoint.h"
#include "hooke/io/checkpoint_slices.h"
#include "hooke/run/cuda_loader.h"
#include "hooke/run/mpi_loader.h"
#include "hooke/run/rank_orders.h"

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

namespace {

// All that a simulation is made of.
struct Parts {
  scene::LoadedScene loaded;
  std::optional<io::Checkpoint> checkpoint;
  std::shared_ptr<const ParticleSlices> slices;  // if any, in place of the scene's or the checkpoint's particles
  std::unique_ptr<Backend> backend;
};

Expected<scene::LoadedScene> load(const SceneArguments& scene, bool with_particles, const LaunchedRanks& ranks) {
  scene::LoadOptions options;
  options.overrides = scene.overrides;
  options.allow_outside = scene.allow_outside;
  options.with_particles = with_particles;
  options.share_here = static_cast<double>(ranks.on_this_machine) / ranks.size();
  options.in_slices = ranks.size() > 1;
  return scene::load_scene(scene.file, options);
}

Expected<void> open_checkpoint(const std::filesystem::path& file, bool in_slices, Parts& parts) {
  if (in_slices) {
    auto checkpoint = io::read_checkpoint_in_slices(file);
    if (!checkpoint) return fail(std::move(checkpoint).error());
    parts.checkpoint = std::move(checkpoint->rest);
    parts.slices = std::move(checkpoint->particles);
    return {};
  }
  auto checkpoint = io::read_checkpoint(file);
  if (!checkpoint) return fail(std::move(checkpoint).error());
  parts.checkpoint = std::move(*checkpoint);
  return {};
}

// In slices: the particles of the checkpoint; those of a scene are as they have been loaded.
Expected<Parts> collect_parts(scene::LoadedScene loaded, const DeviceArguments& device,
                              const std::filesystem::path& resume, bool in_slices) {
  Parts parts;
  parts.slices = std::move(loaded.slices);
  if (!resume.empty()) {
    if (auto opened = open_checkpoint(resume, in_slices, parts); !opened) return fail(std::move(opened).error());
  }
  const std::size_t particles = parts.slices       ? parts.slices->size()
                                : parts.checkpoint ? parts.checkpoint->state.particles.size()
                                                   : loaded.particles.size();
  auto backend = make_backend(device, loaded.scene, particles, loaded.warnings);
  if (!backend) return fail(std::move(backend).error());
  if (parts.checkpoint) {
    const io::RunInfo info = io::describe_run(loaded.scene, (*backend)->info().precision);
    if (auto findings = io::check_resumable(parts.checkpoint->info, info); !findings.empty())
      return fail(Error{Error::Kind::bad_input, std::move(findings)});
  }
  parts.loaded = std::move(loaded);
  parts.backend = std::move(*backend);
  return parts;
}

Expected<Simulation> start(Parts& parts, const std::shared_ptr<Communicator>& communicator) {
  scene::LoadedScene& loaded = parts.loaded;
  if (parts.checkpoint) {
    SimulationState& state = parts.checkpoint->state;
    if (!parts.slices)
      return Simulation::resume(std::move(loaded.scene), std::move(state), std::move(parts.backend), communicator);
    return Simulation::resume_in_slices(std::move(loaded.scene), std::move(state), std::move(parts.slices),
                                        std::move(parts.backend), communicator);
  }
  // start_checks.h warns of an unstable step
  const CreateOptions options{.allow_unstable_step = true, .communicator = communicator};
  if (!parts.slices) {
    return Simulation::create(std::move(loaded.scene), std::move(loaded.particles), std::move(parts.backend), options);
  }
  return Simulation::create_in_slices(std::move(loaded.scene), std::move(parts.slices), std::move(parts.backend),
                                      options);
}

Expected<OpenedSimulation> assemble(Parts parts, const std::shared_ptr<Communicator>& communicator) {
  scene::LoadedScene& loaded = parts.loaded;
  const int threads = parts.backend->info().threads;
  auto simulation = start(parts, communicator);
  if (!simulation) return fail(std::move(simulation).error());
  const std::int64_t step = simulation->step_count();
  return OpenedSimulation{std::move(*simulation),
                          std::move(loaded.resolved),
                          std::move(loaded.files),
                          std::move(loaded.warnings),
                          loaded.fields,
                          step,
                          communicator ? communicator->size() : 1,
                          threads};
}

// A rank that lacks memory must say so like one that finds no file: the others wait for its word.
template <class Make>
auto within_memory(const Make& make) -> decltype(make()) {
  try {
    return make();
  } catch (const std::bad_alloc&) {
    return fail(Error::Kind::bad_input, "scene", "does not fit into memory");
  }
}

// The parts of one of several ranks. Rank 0 has the particles.
Expected<Parts> collect_parts_of_rank(const SceneArguments& scene, DeviceArguments device,
                                      const std::filesystem::path& resume, const LaunchedRanks& ranks) {
  const bool leads = ranks.rank() == 0;
  std::vector<Finding> findings;
  if (device.device == "auto") {
    device.device = "cpu";
    findings.push_back({"device", "\"auto\" takes the CPU: several ranks can't compute on GPUs yet"});
  }
  if (device.device != "cpu") {
    return fail(Error::Kind::bad_input, "device",
                formatted("\"{}\" can't compute on several ranks yet; \"cpu\" can", device.device));
  }
  if (device.threads == 0) device.threads = ranks.cores;
  auto loaded = load(scene, leads && resume.empty(), ranks);
  if (!loaded) return fail(std::move(loaded).error());
  for (Finding& finding : findings) loaded->warnings.push_back(std::move(finding));
  return collect_parts(std::move(*loaded), device, resume, true);
}

// The same, once all ranks have theirs; sets the threads of all.
Expected<Parts> collect_parts_of_all(const SceneArguments& scene, const DeviceArguments& device,
                                     const std::filesystem::path& resume, const LaunchedRanks& ranks, int& threads) {
  auto parts = within_memory([&] { return collect_parts_of_rank(scene, device, resume, ranks); });
  const auto agreed = agree(*ranks.communicator, [&]() -> Expected<RankReadiness> {
    if (!parts) return fail(parts.error());
    return RankReadiness{hash_of_scene(parts->loaded.resolved), parts->backend->info().threads};
  }());
  if (!agreed) return fail(agreed.error());
  threads = *agreed;
  return parts;
}

Expected<OpenedSimulation> open_on_all(const SceneArguments& scene, const DeviceArguments& device,
                                       const std::filesystem::path& resume, const LaunchedRanks& ranks) {
  RankOrder order{RankOrder::Kind::open, 0, scene, device};
  std::error_code ignored;  // where there is no such file, all say so
  order.scene.file = std::filesystem::absolute(scene.file, ignored);
  give_order(*ranks.communicator, order);
  int threads = 1;
  auto parts = collect_parts_of_all(scene, device, resume, ranks, threads);
  if (!parts) return fail(std::move(parts).error());
  auto opened = assemble(std::move(*parts), ranks.communicator);
  if (opened) opened->threads = threads;
  return opened;
}

}  // namespace

Expected<OpenedSimulation> open_simulation(const SceneArguments& scene, const DeviceArguments& device,
                                           const std::filesystem::path& resume, const LaunchedRanks& ranks) {
  if (ranks.size() > 1) return open_on_all(scene, device, resume, ranks);
  auto loaded = load(scene, resume.empty(), ranks);
  if (!loaded) return fail(std::move(loaded).error());
  return open_simulation(std::move(*loaded), device, resume);
}

Expected<OpenedSimulation> open_simulation(scene::LoadedScene loaded, const DeviceArguments& device,
                                           const std::filesystem::path& resume) {
  auto parts = collect_parts(std::move(loaded), device, resume, false);
  if (!parts) return fail(std::move(parts).error());
  return assemble(std::move(*parts), nullptr);
}

Expected<LaunchedRanks> join_launched_ranks() {
  const int ranks = launched_rank().ranks;
  return ranks > 1 ? load_ranks(ranks) : LaunchedRanks{};
}

int follow_ranks(const LaunchedRanks& ranks) {
  try {
    for (;;) {
      const RankOrder order = take_order(*ranks.communicator);
      if (order.kind == RankOrder::Kind::end) return order.status;
      int threads = 1;
      auto parts = collect_parts_of_all(order.scene, order.device, {}, ranks, threads);
      if (parts) Simulation::follow(std::move(parts->loaded.scene), std::move(parts->backend), ranks.communicator);
    }
  } catch (const std::bad_alloc&) {
    ranks.communicator->abort("out of memory");
  }
  std::abort();  // not reached: compilers don't see that a virtual function does not return
}

void release_ranks(const LaunchedRanks& ranks, int status) {
  if (ranks.size() > 1) give_order(*ranks.communicator, {RankOrder::Kind::end, status, {}, {}});
}

}  // namespace hooke::run
