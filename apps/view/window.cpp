// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace hooke::view {
namespace {

constexpr float kFontSize = 15;  // pixels of a common monitor
constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

std::string& last_error() {
  static std::string text;
  return text;
}

Unexpected no_window(const std::string& why) {
  return fail(Error::Kind::bad_input, "window",
              why + "; hooke run and hooke render make pictures and films without one");
}

}  // namespace

struct WindowCallbacks {
  static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }
  static InputEvent event(GLFWwindow* window, InputEvent::Kind kind, int code, int action, int modifiers) {
    InputEvent e{kind, code, modifiers, action != GLFW_RELEASE, action == GLFW_REPEAT, 0, 0, 0};
    int width = 1, height = 1;
    glfwGetCursorPos(window, &e.x, &e.y);
    glfwGetWindowSize(window, &width, &height);
    e.x /= std::max(width, 1);
    e.y /= std::max(height, 1);
    return e;
  }
  static void key(GLFWwindow* window, int key, int /*scancode*/, int action, int modifiers) {
    of(window).events_.push_back(event(window, InputEvent::Kind::key, key, action, modifiers));
  }
  static void button(GLFWwindow* window, int button, int action, int modifiers) {
    of(window).events_.push_back(event(window, InputEvent::Kind::button, button, action, modifiers));
  }
  static void wheel(GLFWwindow* window, double /*x*/, double y) {
    InputEvent e = event(window, InputEvent::Kind::wheel, 0, GLFW_RELEASE, 0);
    e.wheel = y;
    of(window).events_.push_back(e);
  }
  static void motion(GLFWwindow* window, double /*x*/, double /*y*/) {
    of(window).events_.push_back(event(window, InputEvent::Kind::motion, 0, GLFW_RELEASE, 0));
  }
};

Expected<void> Window::check_display() {
  glfwSetErrorCallback([](int, const char* text) { last_error() = text; });
  if (glfwInit() == GLFW_TRUE) return {};
  return no_window(last_error().empty() ? "there is no display" : "there is no display (" + last_error() + ")");
}

Expected<std::unique_ptr<Window>> Window::open(const std::string& title, int width, int height, int gl_major,
                                               int gl_minor) {
  if (auto display = check_display(); !display) return fail(display.error());
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, gl_major);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, gl_minor);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  GLFWwindow* window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (window == nullptr) {
    const std::string why = last_error();
    glfwTerminate();
    return no_window(fmt::format("there is no OpenGL {}.{} for it ({})", gl_major, gl_minor, why));
  }
  return std::unique_ptr<Window>(new Window(window));
}

Window::Window(GLFWwindow* window) : window_(window) {
  glfwMakeContextCurrent(window);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window, this);
  // ImGui's callbacks call these after their own.
  glfwSetKeyCallback(window, WindowCallbacks::key);
  glfwSetMouseButtonCallback(window, WindowCallbacks::button);
  glfwSetScrollCallback(window, WindowCallbacks::wheel);
  glfwSetCursorPosCallback(window, WindowCallbacks::motion);
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 430 core");
  fit_scale();
}

Window::~Window() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool Window::should_close() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }
void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }

std::vector<InputEvent> Window::take_events(double seconds) {
  seconds > 0 ? glfwWaitEventsTimeout(seconds) : glfwPollEvents();
  return std::exchange(events_, {});
}

// Letters and margins fit the monitor that the window is on.
void Window::fit_scale() {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  const float wanted = std::clamp(std::max(x, y), 0.5f, 8.0f);
  if (wanted == scale_) return;
  scale_ = wanted;
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  std::error_code ignored;
  if (std::filesystem::exists(kFont, ignored)) {
    fonts.AddFontFromFileTTF(kFont, std::round(kFontSize * scale_));
  } else {
    ImFontConfig config;
    config.SizePixels = std::round(13 * scale_);
    fonts.AddFontDefault(&config);
  }
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
  set_style(dark_);
}

void Window::set_style(bool dark) {
  ImGui::GetStyle() = ImGuiStyle{};
  dark ? ImGui::StyleColorsDark() : ImGui::StyleColorsLight();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 4;
  style.FrameRounding = 3;
  style.WindowBorderSize = 0;
  style.Colors[ImGuiCol_WindowBg].w = 0.86f;
  style.ScaleAllSizes(scale_);
}

void Window::set_dark(bool dark) {
  if (dark == dark_) return;
  dark_ = dark;
  set_style(dark);
}

void Window::begin_frame() {
  fit_scale();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Window::draw_gui() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Window::show() { glfwSwapBuffers(window_); }

int Window::width() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return width;
}
int Window::height() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return height;
}

bool Window::is_down(int key) const { return glfwGetKey(window_, key) == GLFW_PRESS; }
bool Window::is_button_down(int button) const { return glfwGetMouseButton(window_, button) == GLFW_PRESS; }
void Window::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

}  // namespace hooke::view
