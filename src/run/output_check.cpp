// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/output_check.h"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

#include "hooke/io/output_file.h"

namespace hooke::run {

Expected<void> check_output_file(const std::filesystem::path& file, const std::string& option) {
  std::error_code ignored;
  const auto complain = [&](const std::string& what) { return fail(Error::Kind::bad_input, option, what); };
  if (std::filesystem::is_directory(file, ignored)) return complain(fmt::format("{} is a folder", file.string()));
  const auto target = io::output_target(file);
  if (!target) return fail(target.error());
  if (target->is_stream) {
    if (access(target->file.c_str(), W_OK) == 0) return {};
    return complain(fmt::format("{}: can't be written", file.string()));
  }
  const std::filesystem::path folder = target->file.has_parent_path() ? target->file.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, ignored)) {
    return complain(fmt::format("{}: there is no folder {}", file.string(), folder.string()));
  }
  if (access(folder.c_str(), W_OK) != 0) {
    return complain(fmt::format("{}: can't write into {}", file.string(), folder.string()));
  }
  return {};
}

}  // namespace hooke::run
