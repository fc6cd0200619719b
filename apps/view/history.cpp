// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "history.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>

namespace hooke::view {
namespace {

constexpr std::size_t kMostSamples = 1200;

// A curve: what it shows, in which colour.
struct Curve {
  const char* name;
  ImU32 color;
  double (*value)(const History::Sample&);
};

constexpr ImU32 kBlue = IM_COL32(86, 156, 230, 255), kGreen = IM_COL32(104, 190, 110, 255),
                kOrange = IM_COL32(235, 150, 60, 255), kGrey = IM_COL32(170, 176, 186, 255),
                kRed = IM_COL32(220, 92, 96, 255);

constexpr std::array kEnergies = {
    Curve{"total", kGrey, [](const History::Sample& s) { return s.total; }},
    Curve{"kinetic", kBlue, [](const History::Sample& s) { return s.kinetic; }},
    Curve{"potential", kGreen, [](const History::Sample& s) { return s.potential; }},
    Curve{"elastic", kOrange, [](const History::Sample& s) { return s.elastic; }},
};
constexpr std::array kContacts = {Curve{"contacts", kBlue, [](const History::Sample& s) { return s.contacts; }}};
constexpr std::array kTimes = {
    Curve{"step", kGrey, [](const History::Sample& s) { return 1e3 * s.step_seconds; }},
    Curve{"force", kBlue, [](const History::Sample& s) { return 1e3 * s.stages.force; }},
    Curve{"list", kOrange, [](const History::Sample& s) { return 1e3 * (s.stages.list + s.stages.sort); }},
    Curve{"motion", kGreen, [](const History::Sample& s) { return 1e3 * (s.stages.motion + s.stages.drift); }},
};

void draw_curves(const char* title, const std::deque<History::Sample>& samples, std::span<const Curve> curves) {
  double low = 0, high = 0;
  for (const Curve& curve : curves) {
    for (const History::Sample& s : samples) {
      if (const double v = curve.value(s); std::isfinite(v)) {
        low = std::min(low, v);
        high = std::max(high, v);
      }
    }
  }
  if (!(high > low)) high = low + 1;
  ImGui::Text("%s   %.4g to %.4g", title, low, high);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size{ImGui::GetContentRegionAvail().x, 5 * ImGui::GetFontSize()};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg));
  const double from = samples.empty() ? 0 : samples.front().time;
  const double span = samples.size() < 2 ? 1 : std::max(samples.back().time - from, 1e-12);
  for (const Curve& curve : curves) {
    std::vector<ImVec2> points;
    for (const History::Sample& s : samples) {
      const double v = std::clamp(curve.value(s), low, high);
      points.push_back({corner.x + size.x * static_cast<float>((s.time - from) / span),
                        corner.y + size.y * static_cast<float>(1 - (v - low) / (high - low))});
    }
    list.AddPolyline(points.data(), static_cast<int>(points.size()), curve.color, 0, 1.5f);
  }
  ImGui::Dummy(size);
  for (const Curve& curve : curves) {
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(curve.color), "%s %.4g", curve.name,
                       samples.empty() ? 0.0 : curve.value(samples.back()));
    if (&curve != &curves.back()) ImGui::SameLine();
  }
  ImGui::Spacing();
}

}  // namespace

void History::add(const std::shared_ptr<const Figures>& figures, const Readings& now) {
  while (!samples_.empty() && samples_.back().steps > now.steps) samples_.pop_back();
  if (!figures || figures == last_) return;
  last_ = figures;
  if (!samples_.empty() && samples_.back().time > figures->time) samples_.clear();  // it has started again
  const Measurements& m = figures->now;
  Sample sample;
  sample.steps = figures->steps;
  sample.time = figures->time;
  sample.kinetic = m.kinetic_energy;
  sample.elastic = m.elastic_energy + m.wall_elastic_energy + m.collider_elastic_energy + m.spring_energy;
  sample.potential = m.potential_energy + m.attraction_energy;
  sample.total = sample.kinetic + sample.elastic + sample.potential;
  sample.contacts = static_cast<double>(m.contacts);
  sample.step_seconds = now.step_seconds;
  sample.stages = now.stages;
  samples_.push_back(sample);
  if (samples_.size() > kMostSamples) samples_.pop_front();
}

void draw_plots(const History& history) {
  draw_curves("energy, J", history.samples(), kEnergies);
  draw_curves("contacts", history.samples(), kContacts);
  draw_curves("time of a step, ms", history.samples(), kTimes);
}

}  // namespace hooke::view
