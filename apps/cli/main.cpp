// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "command_line.h"
#include "hooke/base/printable.h"
#include "hooke/run/launched_ranks.h"
#include "hooke/scene/spelling.h"
#include "interrupt.h"
#include "log.h"

namespace hooke::cli {
namespace {

ExitStatus parse_and_run(int argc, const char* const* argv, const run::LaunchedRanks& ranks);

ExitStatus help_command(const CLI::App& app, const std::string& topic, const run::LaunchedRanks& ranks) {
  std::vector<const char*> words{"hooke", "--help"};
  if (!topic.empty()) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
      names.push_back(command->get_name());
    }
    if (std::find(names.begin(), names.end(), topic) == names.end()) {
      spdlog::error("help: \"{}\" is no command{}; commands: {}", printable(topic), scene::did_you_mean(topic, names),
                    fmt::join(names, ", "));
      return kBadInput;
    }
    words.insert(words.begin() + 1, topic.c_str());
  }
  return parse_and_run(static_cast<int>(words.size()), words.data(), ranks);
}

ExitStatus run_chosen(const CLI::App& app, const CommandLine& line, const run::LaunchedRanks& ranks) {
  if (app.get_subcommands().empty()) {
    fmt::print("{}", app.help());
    return kBadInput;
  }
  const CLI::App& command = *app.get_subcommands().front();
  const std::string& name = command.get_name();
  if (name == "run") {
    start_log(line.run.quiet);
    return run_command(line.run, ranks);
  }
  if (name == "check") return check_command(line.check);
  if (name == "bench") return bench_command(line.bench, ranks);
  if (name == "render") return render_command(line.render);
  if (name == "export") return export_command(line.exports);
  if (name == "view") {
    if (ranks.size() == 1) return view_command(command.remaining());
    spdlog::error("view: the window computes on one rank; {} were started", ranks.size());
    return kBadInput;
  }
  if (name == "info") return info_command(line.info);
  if (name == "scenes") return scenes_command();
  if (name == "schema") return schema_command();
  return help_command(app, line.help_topic, ranks);
}

ExitStatus parse_and_run(int argc, const char* const* argv, const run::LaunchedRanks& ranks) {
  CommandLine line;
  CLI::App app("Hooke, a real-time spring-mass particle engine", "hooke");
  app.set_version_flag("--version", "hooke " HOOKE_VERSION);
  add_commands(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and the version arrive as errors of status 0; any other error is wrong usage, whatever CLI11's number.
    return app.exit(error) == 0 ? kDone : kBadInput;
  }
  const ExitStatus status = run_chosen(app, line, ranks);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    spdlog::error("standard output can't be written");
    return status == kDone ? kRunFailed : status;
  }
  return status;
}

// What no part of the program has expected. The other ranks may wait for anything then: they are not released, but
// ended.
int report_exception(const std::string& what, const run::LaunchedRanks& ranks) {
  if (ranks.size() > 1) ranks.communicator->abort(what);
  spdlog::error(what);
  return kRunFailed;
}

int lead(int argc, const char* const* argv, const run::LaunchedRanks& ranks) {
  try {
    const int status = parse_and_run(argc, argv, ranks);
    run::release_ranks(ranks, status);
    return status;
  } catch (const std::bad_alloc&) {
    return report_exception("out of memory", ranks);
  } catch (const std::exception& error) {
    return report_exception(fmt::format("unexpected: {}", error.what()), ranks);
  }
}

// Signals are for rank 0, which stops all.
int follow(const run::LaunchedRanks& ranks) {
  const Interrupt left_to_rank_0;
  return run::follow_ranks(ranks);
}

}  // namespace
}  // namespace hooke::cli

int main(int argc, char** argv) {
  // Makes a write beyond the limit on file sizes fail with an error, like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  hooke::cli::start_log(false);
  const auto ranks = hooke::run::join_launched_ranks();
  if (!ranks)
    return hooke::run::launched_rank().rank == 0 ? hooke::cli::report_error(ranks.error()) : hooke::cli::kBadInput;
  return ranks->rank() == 0 ? hooke::cli::lead(argc, argv, *ranks) : hooke::cli::follow(*ranks);
}
