// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace hooke::cli {

/// The name of the validator that knows the choices of an option: man pages and completions ask it.
inline constexpr const char* kChoices = "choices";

/// Adds an option that takes one of a few names and puts the value of that name into `value`, which must live as long
/// as the command. Any other name is refused with a list of them.
template <class Value>
CLI::Option* add_choice(CLI::App& command, const std::string& option, Value& value,
                        const std::vector<std::pair<std::string, Value>>& choices, const std::string& description) {
  std::vector<std::string> names;
  for (const auto& choice : choices) names.push_back(choice.first);
  return command
      .add_option_function<std::string>(
          option,
          [&value, choices](const std::string& given) {
            for (const auto& [name, meaning] : choices) {
              if (name == given) value = meaning;
            }
          },
          description)
      ->check(CLI::IsMember(names), kChoices);
}

}  // namespace hooke::cli
