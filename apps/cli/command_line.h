// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "commands.h"

namespace CLI {
class App;
}

namespace hooke::cli {

/// What the command line says, but for the arguments of `hooke view`, which stay with its command.
struct CommandLine {
  RunArguments run;
  CheckArguments check;
  BenchArguments bench;
  RenderArguments render;
  ExportArguments exports;
  InfoArguments info;
  std::string help_topic;  ///< of `hooke help`; empty: the program
  std::optional<std::int64_t> steps;
  std::optional<double> end;
};

/// Adds every command with its options to `app`. Parsing fills `line`, which must live as long as `app`.
void add_commands(CLI::App& app, CommandLine& line);

}  // namespace hooke::cli
