// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "viewer.h"

namespace hooke::view {
namespace {

constexpr double kHalfTurn = std::numbers::pi;  // across the window's width
constexpr double kStill = 0.006;                // share of the window that a click may move
constexpr double kFlight = 0.8;                 // of the distance from the target, a second

}  // namespace

void Viewer::handle(const InputEvent& event) {
  const ImGuiIO& io = ImGui::GetIO();
  switch (event.kind) {
    case InputEvent::Kind::key:
      if (event.code == GLFW_KEY_O) pouring_ = event.pressed && !io.WantTextInput;
      if (event.pressed && !io.WantTextInput) press(event);
      break;
    case InputEvent::Kind::button:
      if (event.pressed && io.WantCaptureMouse) return;
      click(event);
      break;
    case InputEvent::Kind::wheel:
      if (!io.WantCaptureMouse) {
        holding_ ? lead(0, 0, 0.05 * event.wheel) : camera_->zoom(std::pow(1.15, event.wheel));
      }
      break;
    case InputEvent::Kind::motion:
      move_mouse(event);
      break;
  }
}

void Viewer::press(const InputEvent& event) {
  if ((event.modifiers & GLFW_MOD_CONTROL) != 0) return press_with_control(event);
  if (event.code == GLFW_KEY_ENTER || event.code == GLFW_KEY_KP_ENTER) return session_.step();
  if (event.code == GLFW_KEY_BACKSPACE) return session_.go_back((event.modifiers & GLFW_MOD_SHIFT) != 0 ? 100 : 1);
  if (event.repeated) return;
  switch (event.code) {
    case GLFW_KEY_ESCAPE:
      if (ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel)) {
        close_menu_ = true;
      } else if (state_.help) {
        state_.help = false;
      } else {
        window_.close();
      }
      break;
    case GLFW_KEY_Q:
      window_.close();
      break;
    case GLFW_KEY_SPACE:
      session_.run(!session_.runs());
      break;
    case GLFW_KEY_1:
      session_.act(Reset{});
      break;
    case GLFW_KEY_2:
      session_.act(Scatter{++random_});
      break;
    case GLFW_KEY_3:
      drop_ball();
      break;
    case GLFW_KEY_4:
      shoot_ball(mouse_x_, mouse_y_);
      break;
    case GLFW_KEY_V:
      state_.mode = MouseMode::view;
      break;
    case GLFW_KEY_M:
      state_.mode = MouseMode::move;
      break;
    case GLFW_KEY_K:
      state_.mode = MouseMode::cut;
      break;
    case GLFW_KEY_F:
      state_.flies = !state_.flies;
      break;
    case GLFW_KEY_H:
      state_.panel = !state_.panel;
      break;
    case GLFW_KEY_T:
      state_.plots = !state_.plots;
      break;
    case GLFW_KEY_N:
      state_.numbers = !state_.numbers;
      break;
    case GLFW_KEY_F1:
      state_.help = !state_.help;
      break;
    case GLFW_KEY_SLASH:
      if ((event.modifiers & GLFW_MOD_SHIFT) != 0) state_.help = !state_.help;
      break;
    case GLFW_KEY_P:
      state_.spheres = !state_.spheres;
      break;
    case GLFW_KEY_R:
      state_.rendering = !state_.rendering;
      break;
    case GLFW_KEY_C: {
      const int count = static_cast<int>(kColorings.size());
      const int by = (event.modifiers & GLFW_MOD_SHIFT) != 0 ? count - 1 : 1;
      state_.coloring = static_cast<Coloring>((static_cast<int>(state_.coloring) + by) % count);
      break;
    }
    case GLFW_KEY_G:
      state_.ground = !state_.ground;
      break;
    case GLFW_KEY_B:
      state_.dark = !state_.dark;
      window_.set_dark(state_.dark);
      break;
    case GLFW_KEY_X:
      state_.clip = !state_.clip;
      break;
    case GLFW_KEY_S:
      (event.modifiers & GLFW_MOD_SHIFT) != 0 ? toggle_film() : save_still();
      break;
    case GLFW_KEY_HOME:
      camera_->reset();
      break;
    case GLFW_KEY_EQUAL:
    case GLFW_KEY_KP_ADD:
      change_speed(1);
      break;
    case GLFW_KEY_MINUS:
    case GLFW_KEY_KP_SUBTRACT:
      change_speed(-1);
      break;
    case GLFW_KEY_0:
      session_.set_speed(kSpeeds.back());
      break;
    case GLFW_KEY_DELETE:
      session_.inspect({});
      picked_.reset();
      break;
    default:
      break;
  }
}

void Viewer::press_with_control(const InputEvent& event) {
  if (event.repeated) return;
  if (event.code == GLFW_KEY_S) save_scene();
  if (event.code == GLFW_KEY_E) session_.save_checkpoint(next_checkpoint());
  if (event.code == GLFW_KEY_Z && (event.modifiers & GLFW_MOD_SHIFT) == 0) session_.undo();
  if (event.code == GLFW_KEY_Y || (event.code == GLFW_KEY_Z && (event.modifiers & GLFW_MOD_SHIFT) != 0))
    session_.redo();
}

// To the next of the speeds, up or down.
void Viewer::change_speed(int by) {
  const double now = session_.speed();
  if (by > 0) {
    const auto next = std::upper_bound(kSpeeds.begin(), kSpeeds.end(), now);
    session_.set_speed(next == kSpeeds.end() ? kSpeeds.back() : *next);
  } else {
    const auto next = std::lower_bound(kSpeeds.begin(), kSpeeds.end(), now);
    session_.set_speed(next == kSpeeds.begin() ? kSpeeds.front() : *(next - 1));
  }
}

void Viewer::click(const InputEvent& event) {
  mouse_x_ = event.x;
  mouse_y_ = event.y;
  const bool shift = (event.modifiers & GLFW_MOD_SHIFT) != 0, control = (event.modifiers & GLFW_MOD_CONTROL) != 0;
  const bool left = event.code == GLFW_MOUSE_BUTTON_LEFT, middle = event.code == GLFW_MOUSE_BUTTON_MIDDLE;
  if (!event.pressed) {
    const bool still = std::hypot(event.x - pressed_x_, event.y - pressed_y_) < kStill;
    if (left && still && turning_ && state_.mode == MouseMode::view) pick(event.x, event.y);
    if (left && holding_) let_go();
    turning_ = panning_ = zooming_ = false;
    return;
  }
  pressed_x_ = event.x;
  pressed_y_ = event.y;
  if (event.code == GLFW_MOUSE_BUTTON_RIGHT) {
    menu_wanted_ = true;
    return;
  }
  if (left && !shift && !control && state_.mode == MouseMode::move && !panning_) return take_hold(event.x, event.y);
  if (left && state_.mode == MouseMode::cut) return cut(event.x, event.y);
  zooming_ = (left && (control || panning_)) || (middle && turning_);
  panning_ = !zooming_ && (middle || (left && shift));
  turning_ = !zooming_ && !panning_ && left;
}

void Viewer::move_mouse(const InputEvent& event) {
  const double aspect = static_cast<double>(window_.width()) / std::max(window_.height(), 1);
  const double right = event.x - mouse_x_, down = event.y - mouse_y_;
  mouse_x_ = event.x;
  mouse_y_ = event.y;
  if (holding_) return window_.is_down(GLFW_KEY_LEFT_SHIFT) ? lead(0, 0, -down) : lead(right * aspect, -down, 0);
  if (state_.mode == MouseMode::cut && window_.is_button_down(GLFW_MOUSE_BUTTON_LEFT) &&
      !ImGui::GetIO().WantCaptureMouse) {
    return cut(event.x, event.y);
  }
  if (zooming_) camera_->zoom(std::exp(-3 * down));
  if (panning_) camera_->pan(-right * aspect, down);
  if (turning_ && state_.flies) camera_->look(right * kHalfTurn * 0.5, -down * kHalfTurn * 0.5);
  if (turning_ && !state_.flies) camera_->turn(-right * kHalfTurn, down * kHalfTurn * 0.6);
}

// By the arrow keys, and up and down.
void Viewer::fly(double seconds) {
  if (ImGui::GetIO().WantTextInput) return;
  const auto axis = [&](int more, int less) {
    return static_cast<double>(window_.is_down(more)) - static_cast<double>(window_.is_down(less));
  };
  const double way = kFlight * std::min(seconds, 0.25);
  const double right = axis(GLFW_KEY_RIGHT, GLFW_KEY_LEFT), up = axis(GLFW_KEY_PAGE_UP, GLFW_KEY_PAGE_DOWN),
               ahead = axis(GLFW_KEY_UP, GLFW_KEY_DOWN);
  if (right != 0 || up != 0 || ahead != 0) camera_->fly(way * right, way * up, way * ahead);
}

}  // namespace hooke::view
