// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace hooke::manual {

/// An option or a positional argument, as the program's own help shows it.
struct OptionText {
  std::vector<std::string> names;    ///< "-o", "--output"; of a positional argument its one name, "SCENE"
  std::string value;                 ///< "DIR"; empty: a flag
  std::string description;
  std::vector<std::string> choices;  ///< all values there are; empty: any
  bool positional = false;
  bool required = false;
};

/// A command of the program; the program itself has no name.
struct CommandText {
  std::string name, description;
  std::string footer;  ///< what its help says after the options
  std::vector<OptionText> options;
};

/// The program's own options and all its commands, those of `hooke view` included.
struct ProgramText {
  CommandText program;
  std::vector<CommandText> commands;
};
ProgramText describe_program();

/// What an argument's value names, by the word for it in the help ("SCENE", "DIR").
enum class ValueKind { scene_file, folder, file, command, text };
ValueKind kind_of_value(const std::string& word);

}  // namespace hooke::manual
