// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hooke::manual {
namespace {

constexpr const char* kHead =
    "# SPDX-FileCopyrightText: The Hooke authors\n"
    "# SPDX-License-Identifier: MIT\n"
    "# Made from the program's options.\n";

std::string names_of(const std::vector<CommandText>& commands) {
  std::string names;
  for (const CommandText& command : commands) names += (names.empty() ? "" : " ") + command.name;
  return names;
}

// The bash command that fills COMPREPLY with what fits such a value.
std::string bash_values(const OptionText& option, const std::string& commands) {
  const auto words = [](const std::string& list) { return "_hooke_reply -W \"" + list + "\""; };
  if (!option.choices.empty()) return words(fmt::format("{}", fmt::join(option.choices, " ")));
  switch (kind_of_value(option.value)) {
    case ValueKind::scene_file:
      return "_hooke_files -o plusdirs -f -X '!*.json'";
    case ValueKind::folder:
      return "_hooke_files -d";
    case ValueKind::file:
      return "_hooke_files -f";
    case ValueKind::command:
      return words(commands);
    case ValueKind::text:
      break;
  }
  return ":";
}

std::string zsh_quoted(const std::string& text) {
  std::string quoted;
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      if (c == '[' || c == ']' || c == ':' || c == '\\') quoted += '\\';
      quoted += c;
    }
  }
  return quoted;
}

std::string zsh_values(const OptionText& option, const std::string& commands) {
  if (!option.choices.empty()) return fmt::format("({})", fmt::join(option.choices, " "));
  switch (kind_of_value(option.value)) {
    case ValueKind::scene_file:
      return "_files -g \"*.json\"";
    case ValueKind::folder:
      return "_files -/";
    case ValueKind::file:
      return "_files";
    case ValueKind::command:
      return "(" + commands + ")";
    case ValueKind::text:
      break;
  }
  return " ";
}

// One argument of zsh's _arguments.
std::string zsh_argument(const OptionText& option, const std::string& commands) {
  const std::string value =
      option.value.empty() ? "" : fmt::format(":{}:{}", option.value, zsh_values(option, commands));
  if (option.positional) return fmt::format("'{}'", value);
  const std::string rest = fmt::format("'[{}]{}'", zsh_quoted(option.description), value);
  if (option.names.size() == 1) return option.names[0] + rest;
  return fmt::format("'({})'{{{}}}{}", fmt::join(option.names, " "), fmt::join(option.names, ","), rest);
}

}  // namespace

std::string bash_completion(const ProgramText& text) {
  const std::string commands = names_of(text.commands);
  std::string values, flags, positionals;
  for (const CommandText& command : text.commands) {
    std::string all;
    for (const OptionText& option : command.options) {
      const std::string reply = bash_values(option, commands);
      if (option.positional) {
        positionals += fmt::format("    {}) {} ;;\n", command.name, reply);
        continue;
      }
      all += fmt::format("{}{}", all.empty() ? "" : " ", fmt::join(option.names, " "));
      if (option.value.empty()) continue;
      std::string cases;
      for (const std::string& name : option.names) {
        cases += fmt::format("{}\"{} {}\"", cases.empty() ? "" : " | ", command.name, name);
      }
      values += fmt::format("    {}) {}; return ;;\n", cases, reply);
    }
    flags += fmt::format("      {}) _hooke_reply -W \"{}\" ;;\n", command.name, all);
  }
  std::string program;
  for (const OptionText& option : text.program.options) program += fmt::format(" {}", fmt::join(option.names, " "));
  return std::string(kHead) +
         "_hooke_reply() { mapfile -t COMPREPLY < <(compgen \"$@\" -- \"$word\"); }\n"
         "_hooke_files() { compopt -o filenames 2>/dev/null; _hooke_reply \"$@\"; }\n"
         "_hooke() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}\n"
         "  COMPREPLY=()\n"
         "  if ((COMP_CWORD == 1)); then\n" +
         fmt::format("    _hooke_reply -W \"{}{}\"\n    return\n  fi\n", commands, program) +
         "  case \"$command $before\" in\n" + values +
         "  esac\n"
         "  if [[ $word == -* ]]; then\n"
         "    case $command in\n" +
         flags +
         "    esac\n"
         "    return\n"
         "  fi\n"
         "  case $command in\n" +
         positionals +
         "  esac\n"
         "}\n"
         "complete -F _hooke hooke\n";
}

std::string zsh_completion(const ProgramText& text) {
  const std::string commands = names_of(text.commands);
  std::string list, cases;
  for (const CommandText& command : text.commands) {
    list += fmt::format("    '{}:{}'\n", command.name, zsh_quoted(command.description));
    std::string arguments;
    for (const OptionText& option : command.options) {
      arguments += fmt::format(" \\\n        {}", zsh_argument(option, commands));
    }
    cases += fmt::format("    {})\n      _arguments{} ;;\n", command.name, arguments);
  }
  return std::string("#compdef hooke\n") + kHead +
         "_hooke() {\n"
         "  local -a commands\n"
         "  commands=(\n" +
         list +
         "  )\n"
         "  if (( CURRENT == 2 )); then\n"
         "    _describe command commands\n"
         "    return\n"
         "  fi\n"
         "  local command=$words[2]\n"
         "  shift words\n"
         "  (( CURRENT-- ))\n"
         "  case $command in\n" +
         cases +
         "  esac\n"
         "}\n"
         "_hooke \"$@\"\n";
}

}  // namespace hooke::manual
