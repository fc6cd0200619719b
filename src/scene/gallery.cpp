// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/gallery.h"

#include <algorithm>

#include "hooke/scene/json_reader.h"
#include "hooke/scene/text_file.h"

namespace hooke::scene {
namespace fs = std::filesystem;

Expected<std::vector<GalleryScene>> list_scenes(const fs::path& folder) {
  std::error_code fault;
  std::vector<GalleryScene> scenes;
  for (fs::directory_iterator entry(folder, fault), end; !fault && entry != end; entry.increment(fault)) {
    const fs::path& file = entry->path();
    std::error_code ignored;
    if (file.extension() != ".json" || !entry->is_regular_file(ignored)) continue;
    const auto text = read_text_file(file, std::uint64_t{1} << 20U);
    if (!text) continue;
    const JsonReading reading = read_json(*text, file.string());
    if (!reading.value || !reading.value->is_object() || !reading.value->contains("hooke")) continue;
    const auto text_at = [&reading](const char* key, const std::string& fallback) {
      const auto found = reading.value->find(key);
      return found != reading.value->end() && found->is_string() ? found->get<std::string>() : fallback;
    };
    scenes.push_back({file, text_at("name", file.stem().string()), text_at("description", "")});
  }
  if (fault) return fail(Error::Kind::io, folder.string(), "can't be read: " + fault.message());
  std::sort(scenes.begin(), scenes.end(), [](const auto& a, const auto& b) { return a.file < b.file; });
  return scenes;
}

}  // namespace hooke::scene
