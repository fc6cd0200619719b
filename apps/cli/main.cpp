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
#include "hooke/scene/spelling.h"
#include "log.h"

namespace hooke::cli {
namespace {

ExitStatus parse_and_run(int argc, const char* const* argv);

ExitStatus help_command(const CLI::App& app, const std::string& topic) {
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
  return parse_and_run(static_cast<int>(words.size()), words.data());
}

ExitStatus run_chosen(const CLI::App& app, const CommandLine& line) {
  if (app.get_subcommands().empty()) {
    fmt::print("{}", app.help());
    return kBadInput;
  }
  const CLI::App& command = *app.get_subcommands().front();
  const std::string& name = command.get_name();
  if (name == "run") {
    start_log(line.run.quiet);
    return run_command(line.run);
  }
  if (name == "check") return check_command(line.check);
  if (name == "bench") return bench_command(line.bench);
  if (name == "render") return render_command(line.render);
  if (name == "export") return export_command(line.exports);
  if (name == "view") return view_command(command.remaining());
  if (name == "info") return info_command(line.info);
  if (name == "scenes") return scenes_command();
  if (name == "schema") return schema_command();
  return help_command(app, line.help_topic);
}

ExitStatus parse_and_run(int argc, const char* const* argv) {
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
  const ExitStatus status = run_chosen(app, line);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    spdlog::error("standard output can't be written");
    return status == kDone ? kRunFailed : status;
  }
  return status;
}

}  // namespace
}  // namespace hooke::cli

int main(int argc, char** argv) {
  // Makes a write beyond the limit on file sizes fail with an error, like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  hooke::cli::start_log(false);
  try {
    return hooke::cli::parse_and_run(argc, argv);
  } catch (const std::bad_alloc&) {
    spdlog::error("out of memory");
  } catch (const std::exception& error) {
    spdlog::error("unexpected: {}", error.what());
  }
  return hooke::cli::kRunFailed;
}
