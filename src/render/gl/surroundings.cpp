// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/gl/surroundings.h"

#include <cmath>

#include "hooke/render/gl/sun.h"

namespace hooke::render {

namespace {

constexpr Vec3f kDarkGround{0.095f, 0.108f, 0.125f};

// A colour of a screen as light in [0, 1].
Vec3f linear(Color color) {
  const auto channel = [](std::uint8_t value) {
    const float c = static_cast<float>(value) / 255;
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
  };
  return {channel(color.red), channel(color.green), channel(color.blue)};
}

Vec3f root(const Vec3f& v) { return {std::sqrt(v.x), std::sqrt(v.y), std::sqrt(v.z)}; }

// The light that light.glsl stores as a screen's light.
Vec3f unstored(const Vec3f& light) {
  const auto channel = [](float stored) {
    const float c = stored / 1.25f, half = 2.5f * (c - 1);
    return half + std::sqrt(half * half + 5 * c);
  };
  return {channel(light.x), channel(light.y), channel(light.z)};
}

}  // namespace

void set_surroundings(const gl::Program& program, const Frame& frame) {
  program.set("up", vec_cast<float>(frame.up));
  program.set("has_ground", frame.ground ? 1 : 0);
  program.set("ground", static_cast<float>(frame.ground.value_or(0)));
  program.set("ground_tint", frame.ground_color ? unstored(linear(*frame.ground_color)) : kDarkGround);
  program.set("sky_light", frame.night ? 0.03f : 1.0f);
  program.set("background", frame.background ? 2 : frame.bright_sky ? 1 : 0);
  program.set("background_color", root(linear(frame.background.value_or(Color{}))));
  program.set("sunlight_strength", frame.sunlight);
  program.set("skylight_strength", frame.skylight);
  program.set("action_center", vec_cast<float>(frame.action.center()));
  program.set("action_size", action_size(frame));
  program.set("daylight", frame.daylight);
}

}  // namespace hooke::render
