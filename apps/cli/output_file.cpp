// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

namespace hooke::cli {

Expected<void> check_output_file(const std::filesystem::path& file, const std::string& option) {
  std::error_code ignored;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const auto complain = [&](const std::string& what) { return fail(Error::Kind::bad_input, option, what); };
  if (std::filesystem::is_directory(file, ignored)) return complain(fmt::format("{} is a folder", file.string()));
  if (!std::filesystem::is_directory(folder, ignored)) {
    return complain(fmt::format("{}: there is no folder {}", file.string(), folder.string()));
  }
  if (access(folder.c_str(), W_OK) != 0) {
    return complain(fmt::format("{}: can't write into {}", file.string(), folder.string()));
  }
  return {};
}

}  // namespace hooke::cli
