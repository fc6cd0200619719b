// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "man_page.h"

#include <fmt/format.h>

#include <sstream>

namespace hooke::manual {
namespace {

// Text with roff's own characters escaped.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      if ((c == '.' || c == '\'') && (escaped.empty() || escaped.back() == '\n')) escaped += "\\&";
      escaped += c;
    }
  }
  return escaped;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string sentence(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return roff(text) + ".";
}

std::string title(const std::string& name, const std::string& version) {
  std::string upper = name;
  for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return fmt::format(".TH {} 1 \"\" \"Hooke {}\" \"User commands\"\n", upper, version);
}

std::string option_list(const CommandText& command) {
  std::string list;
  for (const OptionText& option : command.options) {
    std::string names;
    for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + bold(name);
    if (option.positional) names = italic(option.names.front());
    if (!option.positional && !option.value.empty()) names += " " + italic(option.value);
    list += fmt::format(".TP\n{}\n{}\n", names, sentence(option.description));
  }
  return list;
}

std::string synopsis(const CommandText& command) {
  std::string line = bold("hooke");
  if (!command.name.empty()) line += " " + bold(command.name);
  for (const OptionText& option : command.options) {
    if (option.positional) line += " " + (option.required ? italic(option.value) : "[" + italic(option.value) + "]");
  }
  for (const OptionText& option : command.options) {
    if (!option.positional && option.required)
      line += fmt::format(" {} {}", bold(option.names[0]), italic(option.value));
  }
  return line + " [" + italic("OPTIONS") + "]\n";
}

// The lines of a footer as they are, without filling.
std::string footer(const std::string& text) {
  if (text.empty()) return {};
  std::istringstream lines(text);
  std::string heading, rest;
  std::getline(lines, heading);
  for (std::string line; std::getline(lines, line);) rest += roff(line) + "\n";
  for (char& c : heading) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  if (heading.ends_with(':')) heading.pop_back();
  return fmt::format(".SH {}\n.nf\n{}.fi\n", heading, rest);
}

constexpr const char* kExitStatus =
    ".SH EXIT STATUS\n"
    ".TP\n0\nDone.\n"
    ".TP\n2\nBad input or usage; nothing was written.\n"
    ".TP\n3\nThe run failed or could not be written; the last good state is kept.\n"
    ".TP\n130\nInterrupted; the checkpoint is written.\n";

}  // namespace

std::string program_page(const ProgramText& text, const std::string& version) {
  std::string page = title("hooke", version);
  page += ".SH NAME\nhooke \\- real\\-time spring\\-mass particle engine\n";
  page += fmt::format(".SH SYNOPSIS\n{} {} [{}]\n", bold("hooke"), italic("COMMAND"), italic("OPTIONS"));
  page +=
      ".SH DESCRIPTION\n"
      "Simulates grains, fluids, cloth, jelly, sparks and stars as spheres that push, rub and damp each other through\n"
      "springs. A scene is a JSON file; a run writes a folder with snapshots, time series and a checkpoint, and "
      "films.\n"
      "The same scene gives the same bits on every processor and for any number of threads.\n";
  page += ".SH COMMANDS\n";
  for (const CommandText& command : text.commands) {
    page += fmt::format(".TP\n{}\n{}\n", bold(command.name), sentence(command.description));
  }
  page += ".SH OPTIONS\n" + option_list(text.program);
  page += kExitStatus;
  page +=
      ".SH ENVIRONMENT\n.TP\n\\fBHOOKE_ISA\\fR\n"
      "The instruction set to use: portable, avx2 or avx512. By default the best that the processor has. Results are\n"
      "the same with each.\n";
  page += ".SH EXAMPLE\n.nf\nhooke run scenes/mixed.json \\-o out/mixed \\-\\-film out/mixed.mp4\n.fi\n";
  page += ".SH SEE ALSO\n";
  for (const CommandText& command : text.commands) {
    page += fmt::format("{}\\fB\\-{}\\fR(1)", &command == text.commands.data() ? "\\fBhooke\\fR" : ",\n\\fBhooke\\fR",
                        roff(command.name));
  }
  return page + "\n";
}

std::string command_page(const CommandText& command, const std::string& version) {
  const std::string name = "hooke-" + command.name;
  return title(name, version) + fmt::format(".SH NAME\n{} \\- {}\n", roff(name), roff(command.description)) +
         ".SH SYNOPSIS\n" + synopsis(command) + ".SH DESCRIPTION\n" + sentence(command.description) +
         "\n.SH OPTIONS\n" + option_list(command) + footer(command.footer) + kExitStatus +
         ".SH SEE ALSO\n\\fBhooke\\fR(1)\n";
}

}  // namespace hooke::manual
