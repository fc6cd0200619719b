// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hooke/base/expected.h"

struct GLFWwindow;

namespace hooke::view {

/// What came from keyboard and mouse, in its order. Places are shares of the window, from its upper left corner.
struct InputEvent {
  enum class Kind { key, button, wheel, motion };
  Kind kind = Kind::motion;
  int code = 0;       ///< GLFW's number of the key or button
  int modifiers = 0;  ///< GLFW's bits
  bool pressed = false;  ///< else released; of a key, repeats count
  bool repeated = false;
  double x = 0, y = 0;  ///< where the cursor was
  double wheel = 0;     ///< notches, up positive
};

/// A window with an OpenGL context, which is current on the thread that opened it, and Dear ImGui in it.
class Window {
 public:
  /// Checks that there is a display. bad_input where there is none.
  static Expected<void> check_display();
  /// bad_input where there is no display or no OpenGL of this version.
  static Expected<std::unique_ptr<Window>> open(const std::string& title, int width, int height, int gl_major,
                                                int gl_minor);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  bool should_close() const;
  void close();
  /// Takes what has come, and waits for it no longer than `seconds` if nothing has.
  std::vector<InputEvent> take_events(double seconds);
  // A frame: begin_frame(), calls of ImGui, the picture, draw_gui(), show().
  void begin_frame();
  void draw_gui();
  void show();
  /// In pixels; 0 while it is minimised.
  int width() const;
  int height() const;
  /// Pixels of a monitor a pixel of common ones.
  float scale() const { return scale_; }
  bool is_down(int key) const;
  bool is_button_down(int button) const;
  void set_dark(bool dark);
  void set_title(const std::string& title);

 private:
  explicit Window(GLFWwindow* window);
  void set_style(bool dark);
  void fit_scale();

  GLFWwindow* window_;
  float scale_ = 0;
  bool dark_ = true;
  std::vector<InputEvent> events_;
  friend struct WindowCallbacks;
};

}  // namespace hooke::view
