// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "run_argument.h"

#include <fmt/format.h>

#include "hooke/io/run_folder.h"

namespace hooke::cli {

Expected<void> check_run_argument(const std::filesystem::path& run, const std::string& command) {
  std::error_code ignored;
  if (run.extension() != ".json" || !std::filesystem::is_regular_file(run, ignored)) return {};
  const std::filesystem::path folder = run.parent_path();
  if (const auto in_run = io::holds_run(folder.empty() ? "." : folder); in_run && *in_run) {
    return fail(Error::Kind::bad_input, run.string(),
                fmt::format("is one file of a run; give its folder: hooke {} {}", command,
                            folder.empty() ? "." : folder.string()));
  }
  const std::string name = run.stem().string();
  return fail(Error::Kind::bad_input, run.string(),
              fmt::format("is no run but a scene; run it first: hooke run {} -o {}, then hooke {} {}", run.string(),
                          name, command, name));
}

}  // namespace hooke::cli
