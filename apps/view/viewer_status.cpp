// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <cmath>

#include "viewer.h"

namespace hooke::view {

scene::Json Viewer::status_now() const {
  const Readings now = session_.readings();
  const render::Camera camera = camera_->camera();
  constexpr const char* kModes[] = {"view", "move", "cut"};
  scene::Json json;
  json["frame"] = drawn_;
  json["frame_seconds"] = frame_seconds_;
  json["steps"] = now.steps;
  json["step_count"] = now.step_count;
  json["time"] = now.time;
  json["time_step"] = now.time_step;
  json["steps_per_second"] = now.steps_per_second;
  json["runs"] = session_.runs();
  json["speed"] = std::isinf(session_.speed()) ? scene::Json("fastest") : scene::Json(session_.speed());
  json["particles"] = now.particles;
  json["mode"] = kModes[static_cast<int>(state_.mode)];
  json["flies"] = state_.flies;
  json["rendering"] = state_.rendering;
  json["spheres"] = state_.spheres;
  json["coloring"] = kColorings[static_cast<std::size_t>(state_.coloring)].name;
  json["clip"] = state_.clip;
  json["ground"] = state_.ground;
  json["dark"] = state_.dark;
  json["panel"] = state_.panel;
  json["plots"] = state_.plots;
  json["numbers"] = state_.numbers;
  json["help"] = state_.help;
  json["eye"] = {camera.eye.x, camera.eye.y, camera.eye.z};
  json["target"] = {camera.target.x, camera.target.y, camera.target.z};
  json["up"] = {camera.up.x, camera.up.y, camera.up.z};
  json["field_of_view"] = camera.field_of_view;
  const Vec3d& gravity = scene_->gravity;
  json["gravity"] = {gravity.x, gravity.y, gravity.z};
  json["held_collider"] = now.held_collider;
  json["held_particles"] = now.held_particles;
  json["drags"] = turning_ || panning_ || zooming_ || holding_;
  json["pours"] = pouring_;
  const auto figures = session_.figures();
  json["broken_springs"] = figures ? figures->ledger.springs.broken : 0;
  json["picked"] = picked_ ? scene::Json(*picked_) : scene::Json(nullptr);
  json["can_undo"] = session_.can_undo();
  json["reach"] = now.reach;
  json["message"] = message_;
  json["failure"] = now.failure;
  json["replay_running"] = now.replay.running;
  json["diverged"] = now.replay.diverged ? scene::Json(*now.replay.diverged) : scene::Json(nullptr);
  json["device"] = render::LiveRenderer::device();
  json["scale"] = window_.scale();
  json["width"] = window_.width();
  json["height"] = window_.height();
  return json;
}

}  // namespace hooke::view
