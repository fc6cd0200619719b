// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Writes man pages and shell completions of the program hooke into a folder: hooke_manual FOLDER

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

#include "completion.h"
#include "man_page.h"

namespace {

bool write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out << text << std::flush;
  if (!out) fmt::print(stderr, "{}: can't be written\n", file.string());
  return out.good();
}

}  // namespace

int main(int argc, char** argv) try {
  using namespace hooke::manual;
  if (argc != 2) {
    fmt::print(stderr, "usage: hooke_manual FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const ProgramText text = describe_program();
  bool good = write(folder / "man1/hooke.1", program_page(text, HOOKE_VERSION));
  for (const CommandText& command : text.commands) {
    good = write(folder / "man1" / ("hooke-" + command.name + ".1"), command_page(command, HOOKE_VERSION)) && good;
  }
  good = write(folder / "bash/hooke", bash_completion(text)) && good;
  good = write(folder / "zsh/_hooke", zsh_completion(text)) && good;
  return good ? 0 : 3;
} catch (const std::exception& fault) {
  fmt::print(stderr, "hooke_manual: {}\n", fault.what());
  return 3;
}
