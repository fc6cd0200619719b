// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "hooke/base/printable.h"
#include "hooke/render/color_map.h"
#include "hooke/run/numbers.h"
#include "viewer.h"

namespace hooke::view {
namespace {

constexpr ImGuiWindowFlags kOverlay = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                      ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoInputs;

struct HelpLine {
  const char* keys;
  const char* text;
};
constexpr std::array kHelp = {
    HelpLine{"space", "run and pause"},
    HelpLine{"enter", "one step"},
    HelpLine{"backspace", "one step back; with shift, a hundred"},
    HelpLine{"+  -  0", "faster, slower, as fast as possible"},
    HelpLine{"1  2", "start again; put the particles at random places"},
    HelpLine{"3  4", "drop a ball; shoot one from the camera to the cursor"},
    HelpLine{"o, held", "pour from the cursor"},
    HelpLine{"v", "view: drag turns, with shift pans, with control or the wheel zooms; a click picks a particle"},
    HelpLine{"m", "move: drag a collider or particles; with shift or the wheel, away and near"},
    HelpLine{"k", "knife: drag across springs to cut them"},
    HelpLine{"f", "turn about the eye instead of the target"},
    HelpLine{"arrows, page up and down", "fly"},
    HelpLine{"home", "the camera of the start"},
    HelpLine{"p  r", "balls or points; drawing on and off, for the engine's own speed"},
    HelpLine{"c, shift c", "the next and the last quantity that colours show"},
    HelpLine{"x  g  b", "clipping plane; ground; dark or light"},
    HelpLine{"h  t  n", "panel; plots; numbers"},
    HelpLine{"control z, control y", "undo and redo a change of the scene"},
    HelpLine{"control s, control e", "save the scene as it is now; save a checkpoint"},
    HelpLine{"s, shift s", "a still; a film, begin and end; beside it the scene that made it"},
    HelpLine{"delete", "pick nothing"},
    HelpLine{"F1 or ?", "this help"},
    HelpLine{"q, escape", "quit"},
};

std::string speed_text(double speed) {
  if (std::isinf(speed)) return "as fast as possible";
  return speed == 1 ? "real time" : fmt::format("{:g} x real time", speed);
}

// In seconds, milliseconds or microseconds.
std::string duration_text(double seconds) {
  return seconds >= 1      ? fmt::format("{:.2f} s", seconds)
         : seconds >= 1e-3 ? fmt::format("{:.1f} ms", 1e3 * seconds)
                           : fmt::format("{:.0f} us", 1e6 * seconds);
}

ImU32 color_of(render::Color c, int opacity = 255) { return IM_COL32(c.red, c.green, c.blue, opacity); }

void line(const std::string& text) { ImGui::TextUnformatted(text.c_str()); }

}  // namespace

void Viewer::draw_gui() {
  if (state_.numbers) draw_numbers();
  draw_legend();
  if (state_.panel) draw_side_panel();
  if (state_.plots) draw_plot_window();
  draw_message();
  if (state_.help) draw_help();
  draw_menu();
}

// What the right mouse button offers.
void Viewer::draw_menu() {
  if (menu_wanted_) ImGui::OpenPopup("menu");
  menu_wanted_ = false;
  const bool closes = std::exchange(close_menu_, false);
  if (!ImGui::BeginPopup("menu")) return;
  if (closes) ImGui::CloseCurrentPopup();
  if (ImGui::MenuItem("Start again", "1")) session_.act(Reset{});
  if (ImGui::MenuItem("Random places", "2")) session_.act(Scatter{++random_});
  if (ImGui::MenuItem("Drop a ball", "3")) drop_ball();
  if (ImGui::MenuItem("Shoot a ball", "4")) shoot_ball(pressed_x_, pressed_y_);
  ImGui::Separator();
  if (ImGui::MenuItem("View", "v", state_.mode == MouseMode::view)) state_.mode = MouseMode::view;
  if (ImGui::MenuItem("Move", "m", state_.mode == MouseMode::move)) state_.mode = MouseMode::move;
  if (ImGui::MenuItem("Knife", "k", state_.mode == MouseMode::cut)) state_.mode = MouseMode::cut;
  ImGui::Separator();
  ImGui::MenuItem("Balls", "p", &state_.spheres);
  ImGui::MenuItem("Drawing", "r", &state_.rendering);
  ImGui::MenuItem("Panel", "h", &state_.panel);
  ImGui::MenuItem("Help", "F1", &state_.help);
  ImGui::Separator();
  if (ImGui::MenuItem(session_.runs() ? "Pause" : "Run", "space")) session_.run(!session_.runs());
  if (ImGui::MenuItem("One step", "enter")) session_.step();
  if (ImGui::MenuItem("Quit", "q")) window_.close();
  ImGui::EndPopup();
}

void Viewer::draw_numbers() {
  const Readings now = session_.readings();
  ImGui::SetNextWindowPos({10 * window_.scale(), 10 * window_.scale()});
  ImGui::SetNextWindowBgAlpha(0.55f);
  ImGui::Begin("numbers", nullptr, kOverlay);
  line(fmt::format("{}   {} particles", printable(scene_->name), run::with_commas(now.particles)));
  line(fmt::format("t {:.3f} s   step {}   {}", now.time, run::with_commas(static_cast<std::uint64_t>(now.step_count)),
                   session_.runs() ? speed_text(session_.speed()) : "paused"));
  if (session_.runs()) {
    line(fmt::format("{:.3g} x real time   {:.0f} steps/s   step {}", now.steps_per_second * now.time_step,
                     now.steps_per_second, duration_text(now.step_seconds)));
  }
  line(fmt::format("frame {}   {:.1f} /s", duration_text(frame_seconds_), frame_seconds_ > 0 ? 1 / frame_seconds_ : 0));
  if (now.recorded) ImGui::TextColored({1, 0.4f, 0.35f, 1}, "recorded: every action is logged");
  if (now.replay.diverged) {
    ImGui::TextColored({1, 0.4f, 0.35f, 1}, "DIVERGED at step %lld", static_cast<long long>(*now.replay.diverged));
  } else if (now.replay.running) {
    line(fmt::format("replay: the same bits up to step {}", now.replay.last_equal));
  } else if (now.replay.compared > 0) {
    line(fmt::format("replayed with the same bits, {} states compared", now.replay.compared));
  }
  const auto figures = session_.figures();
  for (std::size_t k = 0; figures && !now.held_collider.empty() && k < scene_->colliders.size(); ++k) {
    if (scene_->colliders[k].name != now.held_collider || k >= figures->now.colliders.size()) continue;
    const ColliderLoad& load = figures->now.colliders[k];
    line(fmt::format("{}: load {:.4g} N ({:.3g}, {:.3g}, {:.3g}), {} contacts", printable(now.held_collider),
                     std::sqrt(dot(load.force, load.force)), load.force.x, load.force.y, load.force.z, load.contacts));
  }
  if (now.held_particles > 0) line(fmt::format("{} particles held", now.held_particles));
  ImGui::End();
}

void Viewer::draw_message() {
  const Readings now = session_.readings();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  if (!now.failure.empty()) {
    ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(0.7f * size.x, 700 * window_.scale()), 0});
    ImGui::Begin("The simulation has failed", nullptr, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PushTextWrapPos();
    line(printable(now.failure, now.failure.size()));
    ImGui::PopTextWrapPos();
    if (ImGui::Button("Go back to the state before it")) session_.go_back(std::min<std::int64_t>(now.reach, 1));
    ImGui::SameLine();
    if (ImGui::Button("Start again")) session_.act(Reset{});
    ImGui::End();
  }
  if (message_.empty() || Clock::now() > message_until_) return;
  ImGui::SetNextWindowPos({0.5f * size.x, size.y - 16 * window_.scale()}, ImGuiCond_Always, {0.5f, 1});
  ImGui::Begin("message", nullptr, kOverlay);
  ImGui::PushTextWrapPos(0.6f * size.x);
  line(printable(message_, message_.size()));
  ImGui::PopTextWrapPos();
  ImGui::End();
}

void Viewer::draw_legend() {
  if (state_.coloring == Coloring::material || !state_.rendering) return;
  const auto by = static_cast<std::size_t>(state_.coloring);
  const ColoringInfo& info = kColorings[by];
  const float scale = window_.scale(), width = 220 * scale, height = 14 * scale;
  ImGui::SetNextWindowPos({10 * scale, ImGui::GetIO().DisplaySize.y - 10 * scale}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowBgAlpha(0.55f);
  ImGui::Begin("legend", nullptr, kOverlay);
  line(*info.unit != 0 ? fmt::format("{}, {}", info.name, info.unit) : std::string(info.name));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  constexpr int kPieces = 48;
  for (int i = 0; i < kPieces; ++i) {
    const float left = corner.x + width * static_cast<float>(i) / kPieces;
    const ImU32 from = color_of(render::map_color(static_cast<double>(i) / kPieces)),
                to = color_of(render::map_color(static_cast<double>(i + 1) / kPieces));
    ImGui::GetWindowDrawList()->AddRectFilledMultiColor(
        {left, corner.y}, {left + width / kPieces + 1, corner.y + height}, from, to, to, from);
  }
  ImGui::Dummy({width, height});
  line(fmt::format("{:.4g}", state_.low[by]));
  const std::string high = fmt::format("{:.4g}", state_.high[by]);
  ImGui::SameLine(width + ImGui::GetStyle().WindowPadding.x - ImGui::CalcTextSize(high.c_str()).x);
  line(high);
  ImGui::End();
}

void Viewer::draw_plot_window() {
  const float scale = window_.scale();
  ImGui::SetNextWindowPos({10 * scale, 120 * scale}, ImGuiCond_Once);
  ImGui::SetNextWindowSize({330 * scale, 420 * scale}, ImGuiCond_Once);
  if (ImGui::Begin("Plots", &state_.plots, ImGuiWindowFlags_NoSavedSettings)) draw_plots(history_);
  ImGui::End();
}

void Viewer::draw_help() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::Begin("Keys", &state_.help,
               ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
  if (ImGui::BeginTable("keys", 2)) {
    for (const HelpLine& help : kHelp) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(help.keys);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(help.text);
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace hooke::view
