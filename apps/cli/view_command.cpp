// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "commands.h"

namespace hooke::cli {

ExitStatus view_command(const std::vector<std::string>& arguments) {
  std::error_code ignored;
  const std::filesystem::path home = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
  const std::filesystem::path program = home / "hooke-view";
  if (!std::filesystem::exists(program, ignored)) {
    spdlog::error(
        "{}: there is none; hooke view is built where GLFW and Dear ImGui are (Debian: libglfw3-dev, libimgui-dev)",
        program.string());
    return kBadInput;
  }
  std::vector<std::string> texts{"hooke view"};
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<char*> values;
  for (std::string& text : texts) values.push_back(text.data());
  values.push_back(nullptr);
  execv(program.c_str(), values.data());
  spdlog::error("{}: can't be started: {}", program.string(), std::strerror(errno));
  return kBadInput;
}

}  // namespace hooke::cli
