// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Overrides, PATH=VALUE a line, of a scene that is sound without them.
#include "fuzz/input.h"
#include "hooke/scene/load_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hooke;
  constexpr const char* kScene = R"({"hooke": 1, "time": {"step": 0.001, "end": 1},
    "domain": {"min": [0, 0, 0], "max": [1, 1, 1]},
    "materials": {"a": {"radius": 0.05, "mass": 1, "stiffness": 1000}},
    "particles": [{"material": "a", "block": {"min": [0.2, 0.2, 0.2], "count": [2, 2, 2], "spacing": 0.1}}]})";
  scene::LoadOptions options;
  options.memory_limit = 1 << 20U;
  std::string_view rest = fuzz::text_of(data, size);
  while (!rest.empty() && options.overrides.size() < 16) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    options.overrides.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  const auto loaded = scene::parse_scene(kScene, "scene.json", std::filesystem::temp_directory_path(), options);
  if (!loaded) fuzz::require_readable(loaded.error());
  return 0;
}
