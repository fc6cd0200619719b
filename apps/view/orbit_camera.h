// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/base/box3.h"
#include "hooke/render/camera.h"

namespace hooke::view {

/// A camera led by hand: turns about its target, or about its eye, pans, zooms and flies; its picture follows softly.
class OrbitCamera {
 public:
  /// Starts as `camera`. `up`: against gravity; unit vector. `size`: of what there is to see, m, > 0.
  OrbitCamera(const render::Camera& camera, const render::LevelAxes& level, const Vec3d& up, double size);

  /// By radians: to the right and up around the target.
  void turn(double right, double up);
  /// By radians, around the eye.
  void look(double right, double up);
  /// By shares of the picture's height.
  void pan(double right, double up);
  /// Divides the distance from the target; > 0.
  void zoom(double factor);
  /// By shares of the distance from the target.
  void fly(double right, double up, double ahead);
  /// As it was at the start.
  void reset() { wanted_ = start_; }
  /// The picture follows what is wanted for `seconds`.
  void follow(double seconds);
  /// The picture is at once as it is wanted.
  void arrive() { shown_ = wanted_; }

  /// As it is shown, in metres.
  render::Camera camera() const { return camera_of(shown_); }
  double distance() const { return shown_.distance; }

 private:
  struct Pose {
    Vec3d target;
    double yaw = 0, pitch = 0;  // rad
    double distance = 1;        // m
  };
  Vec3d from_target(const Pose& pose) const;
  render::Camera camera_of(const Pose& pose) const;

  render::LevelAxes level_;
  Vec3d up_;
  double field_of_view_, size_;
  Pose start_, wanted_, shown_;
};

}  // namespace hooke::view
