// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// A scene's text: it is refused with findings, or the scene that comes out is valid and its text reads back.
#include <nlohmann/json.hpp>

#include "fuzz/input.h"
#include "hooke/scene/load_scene.h"

namespace {

hooke::scene::LoadOptions small() {
  hooke::scene::LoadOptions options;
  options.memory_limit = 1 << 20U;
  return options;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hooke;
  static const fuzz::InputFile file(".csv");
  file.write("x,y,z\n0,0,0\n1,1,1\n");
  const auto loaded = scene::parse_scene(fuzz::text_of(data, size), "scene.json", file.folder(), small());
  if (!loaded) {
    fuzz::require_readable(loaded.error());
    return 0;
  }
  for (const Finding& warning : loaded->warnings) fuzz::require_readable(warning);
  fuzz::require(validate(loaded->scene).empty(), "a scene that was read is valid");
  fuzz::require(are_particles_of(loaded->particles, loaded->scene), "its particles are its own");
  const auto again = scene::parse_scene(loaded->resolved, "resolved.json", file.folder(), small());
  fuzz::require(again.has_value(), "a resolved scene reads back");
  fuzz::require(nlohmann::json::parse(again->resolved) == nlohmann::json::parse(loaded->resolved),
                "a resolved scene resolves to itself");
  return 0;
}
