// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "command_list.h"

#include <CLI/CLI.hpp>
#include <sstream>

#include "choice.h"
#include "command_line.h"
#include "view_options.h"

namespace hooke::manual {
namespace {

// "{a,b,c}": how CLI11 describes a validator of names.
std::vector<std::string> choices_of(CLI::Option& option) {
  std::vector<std::string> choices;
  try {
    std::string list = option.get_validator(cli::kChoices)->get_description();
    list = list.substr(list.find('{') + 1);
    std::istringstream names(list.substr(0, list.find('}')));
    for (std::string name; std::getline(names, name, ',');) choices.push_back(name);
  } catch (const CLI::OptionNotFound&) {}
  return choices;
}

OptionText describe(CLI::Option& option) {
  OptionText text;
  text.description = option.get_description();
  text.required = option.get_required();
  text.positional = option.get_positional();
  text.choices = choices_of(option);
  if (text.positional) {
    text.names = {option.get_name(true)};
    text.value = text.names.front();
    return text;
  }
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  if (option.get_expected_max() > 0) text.value = option.get_option_text();
  return text;
}

CommandText describe(CLI::App& command) {
  CommandText text{command.get_name(), command.get_description(), command.get_footer(), {}};
  for (CLI::Option* option : command.get_options(std::function<bool(CLI::Option*)>())) {
    text.options.push_back(describe(*option));
  }
  return text;
}

}  // namespace

ProgramText describe_program() {
  cli::CommandLine line;
  CLI::App app("Hooke, a real-time spring-mass particle engine", "hooke");
  app.set_version_flag("--version", "");
  cli::add_commands(app, line);
  ProgramText text{describe(app), {}};
  text.program.name.clear();
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    text.commands.push_back(describe(*command));
    if (command->get_name() != "view") continue;
    view::ViewArguments arguments;
    CLI::App window(command->get_description(), "view");
    view::add_view_options(window, arguments);
    text.commands.back() = describe(window);
  }
  return text;
}

ValueKind kind_of_value(const std::string& word) {
  if (word == "SCENE") return ValueKind::scene_file;
  if (word == "RUN" || word == "DIR") return ValueKind::folder;
  if (word == "FILE" || word == "CHECKPOINT") return ValueKind::file;
  return word == "COMMAND" ? ValueKind::command : ValueKind::text;
}

}  // namespace hooke::manual
