// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/gl/sun.h"

#include <cmath>

namespace hooke::render {

float action_size(const Frame& frame) {
  const Vec3d diagonal = frame.action.max - frame.action.min;
  return static_cast<float>(std::sqrt(dot(diagonal, diagonal)));
}

Sun make_sun(const Frame& frame) {
  constexpr double kRoom = 1.3;
  const Vec3d center = frame.action.center();
  const double radius = 0.5 * kRoom * action_size(frame);
  const Camera camera{
      center + radius * frame.to_sun, center,
      std::abs(dot(frame.to_sun, frame.up)) < 0.99 ? frame.up : Vec3d{frame.up.y, frame.up.z, frame.up.x}};
  Sun sun{project(camera, kSunMap, kSunMap), static_cast<float>(2 * radius), vec_cast<float>(frame.to_sun)};
  sun.projection.parallel = true;
  sun.projection.nearest = 0;
  sun.projection.scale = static_cast<float>(0.5 * kSunMap / radius);
  return sun;
}

void Sun::set(const gl::Program& program) const {
  program.set_rows("to_sun", projection.right, projection.up, projection.back);
  program.set("to_light", to);
  program.set("sun_eye", projection.eye);
  program.set("sun_scale", Vec3f{scale(), scale(), 1 / range});
  program.set("sun_blur", 0.003f * range);
}

}  // namespace hooke::render
