// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <thread>

#include "commands.h"
#include "hooke/backends/cpu/cpu_backend.h"
#include "hooke/base/printable.h"
#include "hooke/io/describe_file.h"
#include "hooke/run/cuda_loader.h"
#include "hooke/run/numbers.h"
#include "log.h"
#include "run_argument.h"

namespace hooke::cli {

namespace {

ExitStatus list_devices() {
  std::string sets;
  for (const std::string& name : cpu_instruction_sets()) sets += (sets.empty() ? "" : ", ") + name;
  fmt::print("cpu        {} threads; {}\n", std::max(1U, std::thread::hardware_concurrency()), sets);
  const auto count = run::count_cuda_devices();
  if (!count) fmt::print("cuda       none: {}\n", count.error().findings.front().message);
  for (int index = 0; count && index < *count; ++index) {
    const auto gpu = run::find_cuda_device(index);
    if (!gpu) {
      fmt::print("cuda       {}\n", gpu.error().findings.front().message);
      continue;
    }
    constexpr double kGiB = 1024.0 * 1024 * 1024;
    const std::uint64_t bytes = cuda_bytes_per_particle(Precision::single_precision, Integrator::symplectic_euler);
    fmt::print(
        "cuda       {}, compute capability {}.{}, {:.1f} GiB, {:.1f} of them free: some {} particles in single "
        "precision\n",
        gpu->name, gpu->major, gpu->minor, static_cast<double>(gpu->memory) / kGiB,
        static_cast<double>(gpu->free_memory) / kGiB, run::with_commas(gpu->free_memory / bytes));
  }
  fmt::print("reference  all pairs, double precision: for checks\n");
  return kDone;
}

}  // namespace

ExitStatus info_command(const InfoArguments& arguments) {
  if (arguments.devices) return list_devices();
  const std::filesystem::path& file = arguments.file;
  if (file.empty())
    return report_error(Error{Error::Kind::bad_input, {{"info", "name a run folder or a file of one, or --devices"}}});
  if (auto right = check_run_argument(file, "info"); !right) return report_error(right.error());
  const auto found = io::describe_file(file);
  if (!found) return report_error(found.error());
  const io::FileDescription& it = *found;

  fmt::print("{}: {} of \"{}\"\n", printable(file.string()), to_string(it.kind), printable(it.info.scene));
  fmt::print("  size        {:.1f} MB\n", static_cast<double>(it.bytes) * 1e-6);
  fmt::print("  time step   {} s, {}, {} precision\n", it.info.time_step, to_string(it.info.integrator),
             to_string(it.info.precision));
  for (const io::MaterialInfo& material : it.info.materials) {
    fmt::print("  material    {}: radius {} m, mass {} kg\n", printable(material.name), material.radius, material.mass);
  }
  if (it.kind == io::FileDescription::Kind::checkpoint) {
    fmt::print("  state       step {}, t = {} s, {} particles\n", it.steps.front(), it.times.front(),
               run::with_commas(it.particle_counts.front()));
    return kDone;
  }
  fmt::print("  snapshots   {}\n", it.steps.size());
  const auto print_snapshot = [&](const char* which, std::size_t index) {
    fmt::print("  {:<10}  step {}, t = {} s, {} particles\n", which, it.steps[index], it.times[index],
               run::with_commas(it.particle_counts[index]));
  };
  if (!it.steps.empty()) print_snapshot("first", 0);
  if (it.steps.size() > 1) print_snapshot("last", it.steps.size() - 1);
  if (it.checkpoint_step) fmt::print("  checkpoint  step {}\n", *it.checkpoint_step);
  return kDone;
}

}  // namespace hooke::cli
