// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include "commands.h"
#include "hooke/base/printable.h"
#include "hooke/io/describe_file.h"
#include "hooke/run/numbers.h"
#include "log.h"
#include "run_argument.h"

namespace hooke::cli {

ExitStatus info_command(const std::filesystem::path& file) {
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
