// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "hooke/scene/json_reader.h"

namespace hooke::view {

/// What a user has done to a scene in a panel this frame.
struct SceneEdit {
  scene::Json scene;             ///< the text as it is to be
  std::string pointer;    ///< JSON pointer of the value that was changed
  bool finished = true;   ///< false while a slider is still dragged
};

/// Draws widgets for all values of the scene, made from scene_schema(): with unit, range and help. Values that the
/// scene leaves out can be added. To be called inside of an ImGui window.
std::optional<SceneEdit> draw_scene_widgets(const scene::Json& scene);

}  // namespace hooke::view
