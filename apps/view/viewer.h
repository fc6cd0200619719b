// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "collider_view.h"
#include "history.h"
#include "hooke/base/expected.h"
#include "hooke/render/frame.h"
#include "hooke/render/gl/live_renderer.h"
#include "orbit_camera.h"
#include "picking.h"
#include "session.h"
#include "stability_reading.h"
#include "stills.h"
#include "view_state.h"
#include "window.h"

namespace hooke::view {

struct ViewerOptions {
  std::filesystem::path status;  ///< a line of JSON that tells what the window shows; empty: none
};

/// The window: shows a session, and turns keys, gestures and panels into its actions.
class Viewer {
 public:
  static Expected<std::unique_ptr<Viewer>> open(Window& window, Session& session, const ViewerOptions& options);
  /// Until the window is closed.
  Expected<void> run();

 private:
  using Clock = std::chrono::steady_clock;

  Viewer(Window& window, Session& session, const ViewerOptions& options, render::LiveRenderer renderer);

  // viewer.cpp: the loop and the picture
  void follow_scene();
  void upload(const std::shared_ptr<const ViewFrame>& frame);
  void draw_picture();
  ColorRequest color_request() const;
  std::optional<render::ClipPlane> clip_plane() const;
  render::LiveView live_view() const;
  std::vector<render::LiveVertex> lines() const;
  void show_message(const std::string& text);
  void follow_replay();

  // viewer_input.cpp: keys and the mouse
  void handle(const InputEvent& event);
  void press(const InputEvent& event);
  void press_with_control(const InputEvent& event);
  void move_mouse(const InputEvent& event);
  void click(const InputEvent& event);
  void fly(double seconds);
  void change_speed(int by);

  // viewer_tools.cpp: what touches the simulation
  Ray ray_at(double x, double y) const;
  void take_hold(double x, double y);
  void lead(double right, double up, double ahead);
  void let_go();
  void cut(double x, double y);
  void pick(double x, double y);
  void drop_ball();
  void shoot_ball(double x, double y);
  void pour();
  std::optional<Hit> hit_cloth(const Ray& ray) const;
  double ball_size(const Material& material) const;

  // viewer_record.cpp: what is saved
  std::string output_name() const;
  void save_still();
  void capture();
  void toggle_film();
  void step_film();
  void end_film();
  void save_film_still();
  void finish_film_still();
  void save_scene();
  std::filesystem::path next_checkpoint() const;
  void load_checkpoint(const std::filesystem::path& file);

  // viewer_side_panel.cpp
  void draw_side_panel();
  void draw_time_controls();
  void draw_stability();
  void draw_tune();
  void draw_see();
  void draw_touch();
  void draw_inspection();
  void draw_save();

  // viewer_panels.cpp
  void draw_gui();
  void draw_numbers();
  void draw_message();
  void draw_legend();
  void draw_plot_window();
  void draw_help();
  void draw_menu();

  // viewer_status.cpp
  scene::Json status_now() const;

  Window& window_;
  Session& session_;
  ViewerOptions options_;
  render::LiveRenderer renderer_;
  ViewState state_;

  std::shared_ptr<const Scene> scene_;
  std::uint64_t scene_version_ = 0;
  std::vector<float> radii_;   // by material, as they are drawn
  std::vector<render::Color> colors_;  // by material
  double ball_ = 1;           // radius of a typical particle, m
  double reference_force_ = 1;  // N, > 0
  ColliderView colliders_;
  render::Look look_;
  Vec3d up_{0, 1, 0};
  double floor_ = 0, size_ = 1;  // m
  std::optional<OrbitCamera> camera_;

  std::shared_ptr<const ViewFrame> frame_;
  std::vector<ColliderPose> poses_;          // of the meshes
  std::vector<render::ShadedMesh> collider_meshes_;  // posed
  std::vector<render::ShadedMesh> cloth_meshes_;
  std::uint64_t drawn_ = 0;

  bool replays_ = false;
  bool turning_ = false, panning_ = false, zooming_ = false, holding_ = false, pouring_ = false, menu_wanted_ = false,
       close_menu_ = false;
  double pressed_x_ = 0, pressed_y_ = 0, mouse_x_ = 0.5, mouse_y_ = 0.5;
  double held_depth_ = 1;    // of what is held, m
  Vec3d held_shift_{0, 0, 0};
  std::optional<std::uint64_t> picked_;
  Clock::time_point last_frame_{}, last_pour_{};
  double frame_seconds_ = 0;
  std::string message_;
  Clock::time_point message_until_{};
  std::uint64_t random_ = 1;  // counts random choices

  StabilityReading stability_;
  std::uint64_t stability_version_ = 0;  // of the scene
  std::shared_ptr<const scene::Json> draft_;    // the text while a slider is dragged
  bool draft_continues_ = false;         // its first value has been tried
  History history_;
  std::array<char, 512> checkpoint_name_{};

  std::optional<std::filesystem::path> still_wanted_;
  std::optional<WindowFilm> film_;
  bool film_runs_ = false;
  std::future<Expected<render::Image>> film_still_;
};

}  // namespace hooke::view
