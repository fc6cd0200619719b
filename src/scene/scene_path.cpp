// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/scene_path.h"

#include <algorithm>

namespace hooke::scene {
namespace fs = std::filesystem;

Expected<fs::path> find_scene_file(const fs::path& folder, const std::string& name, bool allow_outside) {
  const auto refuse = [](const std::string& why) { return fail(Error::Kind::bad_input, "", why); };
  if (name.find('\0') != std::string::npos) return refuse("holds a null character");
  const fs::path relative(name);
  if (!allow_outside) {
    if (relative.is_absolute())
      return refuse("is absolute; paths are relative to the scene's folder (--allow-outside lifts this)");
    if (std::find(relative.begin(), relative.end(), "..") != relative.end()) {
      return refuse("leads out of the scene's folder by \"..\" (--allow-outside lifts this)");
    }
  }
  std::error_code fault;
  const fs::path home = fs::canonical(folder.empty() ? fs::path(".") : folder, fault);
  if (fault) return refuse("the scene's folder can't be read: " + fault.message());
  fs::path file = fs::canonical(home / relative, fault);
  if (fault) return refuse("can't be opened: " + fault.message());
  if (!allow_outside && std::mismatch(home.begin(), home.end(), file.begin(), file.end()).first != home.end()) {
    return refuse("leads out of the scene's folder through a symbolic link (--allow-outside lifts this)");
  }
  // Reading a folder, a device or a pipe may never end.
  if (!fs::is_regular_file(file, fault)) return refuse("is no regular file");
  return file;
}

}  // namespace hooke::scene
