// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/base/vec3.h"

namespace hooke {

/// Where the camera is at one time. What is left out is the camera's own value.
struct CameraKeyframe {
  double time = 0;            ///< s
  std::optional<Vec3d> eye;     ///< m
  std::optional<Vec3d> target;  ///< m
  std::optional<double> field_of_view;  ///< degrees, 1 to 150
  std::optional<double> roll;           ///< degrees
};

/// What a camera follows: the middle of a material's particles, or a collider.
struct CameraFollow {
  std::optional<std::size_t> material;  ///< index into the scene's; one of the two is given
  std::optional<std::size_t> collider;
};

/// From where pictures show a scene. What is left out follows from the scene's action (render/camera.h).
struct SceneCamera {
  std::optional<Vec3d> eye;     ///< m
  std::optional<Vec3d> target;  ///< m, other than the eye
  double field_of_view = 35;    ///< from the bottom of the picture to its top, degrees, 1 to 150
  double orbit = 0;             ///< how fast the eye circles the target, around what points up, degrees/s
  double roll = 0;              ///< the camera turned clockwise about the view, degrees
  std::vector<CameraKeyframe> keyframes;  ///< times ascending; smooth in between, at rest before and after
  std::optional<CameraFollow> follow;     ///< the target is put there, and the eye keeps its place beside it
};

/// What pictures show of springs: nothing, rods in the colour of their material, or rods coloured by strain.
enum class SpringLook { none, rods, strain };

/// What pictures show beside particles and colliders, and in which light.
struct ScenePicture {
  bool box = true;           ///< edges of the domain's walls
  bool ground = true;        ///< where there is gravity
  bool ground_lines = true;
  std::string ground_color;  ///< "#rrggbb", or empty
  std::string background = "studio";  ///< "studio" (dark), "sky", or "#rrggbb"
  std::optional<Vec3d> sun;  ///< direction to the sun, of any length but 0; left out: over the right shoulder
  double sunlight = 1;       ///< its brightness, >= 0
  double skylight = 1;       ///< brightness of the light from all around, >= 0
  SpringLook springs = SpringLook::none;
};

/// What is wrong with them, if anything. Paths are those of the scene file.
std::vector<Finding> validate(const SceneCamera& camera);
std::vector<Finding> validate(const ScenePicture& picture);

}  // namespace hooke
