// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "hooke/base/printable.h"
#include "scale.h"
#include "schema_widgets.h"
#include "viewer.h"

namespace hooke::view {
namespace {

void line(const std::string& text) { ImGui::TextUnformatted(text.c_str()); }

void tooltip(const char* text) {
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
}

// A part of the domain or of a range, as a slider for floats.
bool slider(const char* label, float& value, float low, float high) {
  return ImGui::SliderFloat(label, &value, low, high, "%.3g");
}

}  // namespace

void Viewer::draw_side_panel() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float width = std::min(360 * window_.scale(), 0.45f * size.x);
  ImGui::SetNextWindowPos({size.x - width - 8 * window_.scale(), 8 * window_.scale()}, ImGuiCond_Once);
  ImGui::SetNextWindowSize({width, size.y - 16 * window_.scale()}, ImGuiCond_Once);
  if (ImGui::Begin("Scene", &state_.panel, ImGuiWindowFlags_NoSavedSettings)) {
    draw_time_controls();
    if (ImGui::BeginTabBar("tabs")) {
      if (ImGui::BeginTabItem("Tune")) {
        draw_tune();
        ImGui::EndTabItem();
      }
      if (ImGui::BeginTabItem("See")) {
        draw_see();
        ImGui::EndTabItem();
      }
      if (ImGui::BeginTabItem("Touch")) {
        draw_touch();
        ImGui::EndTabItem();
      }
      if (ImGui::BeginTabItem("Save")) {
        draw_save();
        ImGui::EndTabItem();
      }
      ImGui::EndTabBar();
    }
  }
  ImGui::End();
}

void Viewer::draw_time_controls() {
  if (ImGui::Button(session_.runs() ? "Pause" : "Run")) session_.run(!session_.runs());
  tooltip("space");
  ImGui::SameLine();
  if (ImGui::Button("Step")) session_.step();
  tooltip("enter");
  ImGui::SameLine();
  if (ImGui::Button("Back")) session_.go_back(1);
  tooltip(fmt::format("backspace; the last {} steps are kept", session_.readings().reach).c_str());
  ImGui::SameLine();
  if (ImGui::Button("Reset")) session_.act(Reset{});
  tooltip("1: starts again from the scene as it is tuned");
  ImGui::SameLine();
  const double speed = session_.speed();
  const auto name_of = [](double s) { return std::isinf(s) ? std::string("fastest") : fmt::format("{:g} x", s); };
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##speed", name_of(speed).c_str())) {
    for (const double choice : kSpeeds) {
      if (ImGui::Selectable(name_of(choice).c_str(), choice == speed)) session_.set_speed(choice);
    }
    ImGui::EndCombo();
  }
  tooltip("simulated seconds a second; + and -, 0 as fast as possible");
}

// How the step compares with what the scene's coefficients allow.
void Viewer::draw_stability() {
  const double dt = scene_->time_step, stable = stability_.stable.seconds;
  const bool good = dt <= stable;
  ImGui::TextColored(good ? ImVec4{0.45f, 0.8f, 0.5f, 1} : ImVec4{1, 0.42f, 0.36f, 1},
                     "step %.4g s, %.2f of the stable one", dt, std::isinf(stable) ? 0 : dt / stable);
  tooltip(fmt::format("stable up to {:.4g} s, which the {} sets", stable, stability_.stable.limit).c_str());
  if (std::isfinite(stability_.safe_step)) {
    ImGui::SameLine();
    if (ImGui::SmallButton(fmt::format("safe: {:.2g} s", stability_.safe_step).c_str())) {
      scene::Json next = *session_.wanted();
      next["time"]["step"] = stability_.safe_step;
      session_.change_scene(next);
    }
    tooltip("sets the time step to four fifths of the stable one");
  }
  if (!ImGui::BeginTable("materials", 4, ImGuiTableFlags_RowBg)) return;
  for (const char* title : {"contact", "damping", "bounce", "steps"}) ImGui::TableSetupColumn(title);
  ImGui::TableHeadersRow();
  for (const MaterialReading& m : stability_.materials) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    line(printable(m.name));
    ImGui::TableNextColumn();
    ImGui::Text("%.3f", m.damping_ratio);
    tooltip("damping ratio: 0 none, 1 critical");
    ImGui::TableNextColumn();
    ImGui::Text("%.3f", m.restitution);
    tooltip("restitution: speed after a head-on impact over the speed before it");
    ImGui::TableNextColumn();
    ImGui::Text("%.1f", m.contact_steps);
    tooltip("how many steps an impact lasts");
  }
  ImGui::EndTable();
}

void Viewer::draw_tune() {
  if (stability_version_ != scene_version_) {
    stability_version_ = scene_version_;
    stability_ = read_stability(*scene_, session_.first_particles());
  }
  draw_stability();
  if (ImGui::SmallButton("Undo") && session_.can_undo()) session_.undo();
  tooltip("control z");
  ImGui::SameLine();
  if (ImGui::SmallButton("Redo") && session_.can_redo()) session_.redo();
  tooltip("control y");
  ImGui::SameLine();
  ImGui::TextDisabled("(1): takes effect with key 1");
  ImGui::BeginChild("values");
  ImGui::PushItemWidth(0.5f * ImGui::GetWindowWidth());
  // While a slider is dragged, its values are tried as fast as the engine takes them.
  const std::shared_ptr<const scene::Json> scene = draft_ ? draft_ : session_.wanted();
  if (auto edit = draw_scene_widgets(*scene)) {
    draft_ = std::make_shared<const scene::Json>(std::move(edit->scene));
    const bool at_once = effect_of(edit->pointer) != Effect::rebuild;
    if (edit->finished || (at_once && session_.is_text_settled())) {
      session_.change_scene(*draft_, draft_continues_);
      draft_continues_ = true;
    }
    if (edit->finished) {
      draft_.reset();
      draft_continues_ = false;
    }
  } else if (draft_ && !ImGui::IsAnyItemActive()) {
    session_.change_scene(*draft_, draft_continues_);
    draft_.reset();
    draft_continues_ = false;
  }
  ImGui::PopItemWidth();
  ImGui::EndChild();
}

void Viewer::draw_see() {
  ImGui::PushItemWidth(0.5f * ImGui::GetWindowWidth());
  const auto by = static_cast<std::size_t>(state_.coloring);
  if (ImGui::BeginCombo("colour by", kColorings[by].name)) {
    for (std::size_t k = 0; k < kColorings.size(); ++k) {
      if (ImGui::Selectable(kColorings[k].name, k == by)) state_.coloring = static_cast<Coloring>(k);
    }
    ImGui::EndCombo();
  }
  if (state_.coloring != Coloring::material) {
    std::array<double, 2> range = {state_.low[by], state_.high[by]};
    const auto speed = static_cast<float>(0.005 * (range[1] - range[0]));
    if (ImGui::DragScalarN("from, to", ImGuiDataType_Double, range.data(), 2, speed, nullptr, nullptr, "%.4g") &&
        range[0] < range[1]) {
      state_.low[by] = range[0];
      state_.high[by] = range[1];
    }
    if (ImGui::Button("Fit") && frame_ && frame_->lowest < frame_->highest) {
      state_.low[by] = frame_->lowest;
      state_.high[by] = frame_->highest;
    }
    tooltip("the range of the particles as they are now");
    ImGui::SameLine();
    if (ImGui::Button("Default")) {
      std::tie(state_.low[by], state_.high[by]) = default_range(*scene_, session_.first_particles(), kColorings[by]);
    }
  }
  ImGui::Separator();
  ImGui::Checkbox("balls", &state_.spheres);
  if (!state_.spheres) slider("point, pixels", state_.point_size, 1, 8);
  ImGui::Checkbox("relief", &state_.relief);
  tooltip("darkens what lies deeper than its surroundings");
  ImGui::Checkbox("tank", &state_.tank);
  ImGui::Checkbox("ground", &state_.ground);
  if (ImGui::Checkbox("dark", &state_.dark)) window_.set_dark(state_.dark);
  ImGui::Separator();
  ImGui::Checkbox("clipping plane", &state_.clip);
  if (state_.clip) {
    ImGui::RadioButton("x", &state_.clip_axis, 0);
    ImGui::SameLine();
    ImGui::RadioButton("y", &state_.clip_axis, 1);
    ImGui::SameLine();
    ImGui::RadioButton("z", &state_.clip_axis, 2);
    ImGui::SameLine();
    ImGui::Checkbox("other side", &state_.clip_flipped);
    slider("place", state_.clip_place, 0, 1);
  }
  ImGui::Separator();
  ImGui::Checkbox("plots", &state_.plots);
  ImGui::SameLine();
  ImGui::Checkbox("numbers", &state_.numbers);
  ImGui::PopItemWidth();
}

void Viewer::draw_touch() {
  ImGui::PushItemWidth(0.5f * ImGui::GetWindowWidth());
  int mode = static_cast<int>(state_.mode);
  ImGui::RadioButton("view (v)", &mode, 0);
  ImGui::RadioButton("move (m)", &mode, 1);
  ImGui::RadioButton("knife (k)", &mode, 2);
  state_.mode = static_cast<MouseMode>(mode);
  ImGui::Checkbox("turn about the eye (f)", &state_.flies);
  ImGui::Separator();
  if (ImGui::BeginCombo("balls of", printable(state_.ball_material).c_str())) {
    for (const Material& m : scene_->materials) {
      if (m.is_of_particles() && ImGui::Selectable(printable(m.name).c_str(), m.name == state_.ball_material)) {
        state_.ball_material = m.name;
      }
    }
    ImGui::EndCombo();
  }
  slider("radius, particle radii", state_.ball_radius, 0.5f, 20);
  slider("shot, falls", state_.shot_speed, 0, 5);
  tooltip("speed of a shot, in that of a fall through the scene; never so fast that the step can't follow");
  if (ImGui::Button("Drop (3)")) drop_ball();
  ImGui::SameLine();
  if (ImGui::Button("Shoot (4)")) shoot_ball(0.5, 0.5);
  ImGui::SameLine();
  if (ImGui::Button("Scatter (2)")) session_.act(Scatter{++random_});
  tooltip("puts the particles at random places of the domain");
  ImGui::PopItemWidth();
  ImGui::Separator();
  draw_inspection();
}

void Viewer::draw_inspection() {
  const auto found = session_.inspection();
  if (!picked_) return line("click on a particle to read its state");
  if (!found) return line(fmt::format("particle {} is not there any more", *picked_));
  const ParticleAt& p = found->particle;
  const auto vector = [](const Vec3d& v) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x, v.y, v.z); };
  line(fmt::format("particle {}, {}", p.id, printable(scene_->materials[p.material].name)));
  line("x " + vector(p.position) + " m");
  line(fmt::format("v {} m/s, {:.4g}", vector(p.velocity), std::sqrt(dot(p.velocity, p.velocity))));
  line(fmt::format("contacts {}, force {} N", found->contacts.size(), vector(found->force)));
  for (const Inspection::Touch& touch : found->contacts) {
    ImGui::BulletText("%s: overlap %.3g m, %.4g N", touch.partner.c_str(), touch.overlap,
                      std::sqrt(dot(touch.force, touch.force)));
  }
}

void Viewer::draw_save() {
  if (ImGui::Button("Scene as it is now")) save_scene();
  tooltip("control s: the text, with what was tuned and with colliders where they were led");
  if (ImGui::Button("Checkpoint")) session_.save_checkpoint(next_checkpoint());
  tooltip("control e: the state, from which hooke view and hooke run go on with --resume");
  ImGui::InputText("##checkpoint", checkpoint_name_.data(), checkpoint_name_.size());
  ImGui::SameLine();
  if (ImGui::Button("Load")) load_checkpoint(checkpoint_name_.data());
  tooltip("goes on from a checkpoint of this scene");
  ImGui::Separator();
  if (ImGui::Button("Still")) save_still();
  tooltip("s: the picture without panels, and its scene");
  if (ImGui::Button("Still with the look of films")) save_film_still();
  if (ImGui::Button(film_ ? "End the film" : "Film")) toggle_film();
  tooltip("shift s: 30 pictures a second of simulated time; the engine waits for them");
}

}  // namespace hooke::view
