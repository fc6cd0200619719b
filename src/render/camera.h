// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "hooke/base/box3.h"
#include "hooke/base/vec3.h"
#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke::render {

/// A pinhole camera.
struct Camera {
  Vec3d eye{0, 0, 1};          ///< m
  Vec3d target{0, 0, 0};       ///< m, in the middle of the picture, not at the eye
  Vec3d up{0, 1, 0};           ///< what points up in the picture; unit vector, not along the view
  double field_of_view = 35;   ///< from the bottom of the picture to its top, degrees, in (0, 180)
};

/// The camera's own axes: unit vectors, right-handed, `back` from the target to the eye.
struct CameraAxes {
  Vec3d right, up, back;
};
CameraAxes axes(const Camera& camera);

/// Against gravity; y where there is none.
Vec3d up_of(const Scene& scene);

/// The length of `box` along the unit vector `direction`, m.
double extent_along(const Box3d& box, const Vec3d& direction);

/// Two level unit vectors at right angles; the unit vector `up` points up. `across` is along the longer level side of
/// `box`, which pictures show from left to right; `front` points to the viewer.
struct LevelAxes {
  Vec3d across, front;
};
LevelAxes level_axes(const Box3d& box, const Vec3d& up);

/// Where the sun stands in pictures of `box`, a unit vector: high, over the right shoulder of the default camera.
Vec3d direction_to_sun(const Box3d& box, const Vec3d& up);

/// A camera that shows all of `box`, from in front and a little above, its long side across the picture.
/// `field_of_view` in degrees, in (0, 180); `aspect`: width of the picture over its height, > 0.
Camera default_camera(const Box3d& box, const Vec3d& up, double field_of_view, double aspect);

/// What the scene's camera follows at `time` (s), m; empty where it follows nothing or nothing of it is there.
std::optional<Vec3d> followed_point(const Scene& scene, const ParticleSet& particles, double time);

/// The camera of a picture at `time` (s): the scene's camera, with the default camera's values where the scene gives
/// none, along its keyframes, then put where it looks at `followed`, carried around the target by the scene's orbit,
/// and rolled.
Camera camera_at(const Scene& scene, const Box3d& action, double aspect, double time,
                 const std::optional<Vec3d>& followed = {});

}  // namespace hooke::render
