// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <system_error>

#include "commands.h"
#include "hooke/scene/gallery.h"
#include "hooke/scene/load_scene.h"
#include "log.h"

namespace hooke::cli {
namespace {

// The scenes installed beside this program, or those of its source folder.
std::filesystem::path scenes_folder() {
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const std::filesystem::path installed = (program.parent_path() / HOOKE_SCENES_FROM_PROGRAM).lexically_normal();
  return std::filesystem::is_directory(installed, ignored) ? installed : HOOKE_SOURCE_SCENES;
}

}  // namespace

ExitStatus scenes_command() {
  const std::filesystem::path folder = scenes_folder();
  const auto scenes = scene::list_scenes(folder);
  if (!scenes) return report_error(scenes.error());
  fmt::print("In {}:\n", folder.string());
  for (const scene::GalleryScene& scene : *scenes) {
    const std::string& about = scene.description.empty() ? scene.title : scene.description;
    fmt::print("  {:<16} {}\n", scene.file.filename().string(), about);
  }
  return kDone;
}

ExitStatus schema_command() {
  fmt::print("{}", scene::scene_schema());
  return kDone;
}

}  // namespace hooke::cli
