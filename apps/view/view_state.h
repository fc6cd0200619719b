// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>

#include "view_frame.h"

namespace hooke::view {

/// What the left mouse button does.
enum class MouseMode { view, move, cut };

/// How the window shows a simulation, and what its keys and panels have set.
struct ViewState {
  // The picture
  bool rendering = true;
  bool spheres = true;
  bool relief = true;
  bool dark = true;
  bool tank = true;
  bool ground = true;
  float point_size = 2;  ///< pixels
  Coloring coloring = Coloring::material;
  std::array<double, kColorings.size()> low{}, high{};  ///< of each coloring, set when a scene is opened
  bool clip = false;
  int clip_axis = 0;
  bool clip_flipped = false;
  float clip_place = 0.5f;  ///< share of the domain

  // The mouse
  MouseMode mode = MouseMode::view;
  bool flies = false;  ///< turns about the eye

  // Balls
  std::string ball_material;
  float ball_radius = 5;   ///< radii of a particle
  float shot_speed = 1;    ///< of the speed of a fall through the scene

  // Panels
  bool panel = true, help = false, plots = false, numbers = true;
};

/// Speeds that + and - go through, simulated seconds a second.
inline constexpr std::array<double, 9> kSpeeds = {
    0.01, 0.03, 0.1, 0.25, 0.5, 1, 2, 5, std::numeric_limits<double>::infinity()};

}  // namespace hooke::view
