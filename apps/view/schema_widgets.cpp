// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "schema_widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hooke/render/color_map.h"
#include "hooke/scene/schema.h"
#include "scene_document.h"

namespace hooke::view {
namespace {

constexpr std::size_t kMostItems = 200;  // of a list that are shown

// Draws one value after the other and notes which one was changed.
class Widgets {
 public:
  explicit Widgets(const scene::Json& scene) : scene_(scene) {}

  std::optional<SceneEdit> draw() {
    draw_members(scene::schema_root(), scene_, scene::Json::json_pointer());
    return std::move(edit_);
  }

 private:
  void changed(const scene::Json::json_pointer& at, scene::Json value, bool finished) {
    SceneEdit edit{scene_, at.to_string(), finished};
    edit.scene[at] = std::move(value);
    edit_ = std::move(edit);
  }
  static std::string range_of(const scene::Json& schema) {
    std::string text;
    if (schema.contains("exclusiveMinimum")) text += fmt::format("> {}", schema["exclusiveMinimum"].dump());
    if (schema.contains("minimum")) text += fmt::format(">= {}", schema["minimum"].dump());
    if (schema.contains("maximum")) text += fmt::format("{}<= {}", text.empty() ? "" : ", ", schema["maximum"].dump());
    return text;
  }

  // The help beside a widget: what it is, its unit, its range, and when a change takes effect.
  static void help(const scene::Json& schema, const scene::Json::json_pointer& at) {
    const Effect effect = effect_of(at.to_string());
    if (effect == Effect::reset) {
      ImGui::SameLine();
      ImGui::TextDisabled("(1)");
    }
    if (!ImGui::IsItemHovered()) return;
    constexpr const char* kEffects[] = {"changes nothing in the simulation", "takes effect at once",
                                        "takes effect at once, in a simulation made anew from the present particles",
                                        "takes effect when the simulation starts again: key 1"};
    std::string text = schema.value("description", "");
    if (const std::string unit = schema.value("unit", ""); !unit.empty()) text += "\nunit: " + unit;
    if (const std::string range = range_of(schema); !range.empty()) text += "\nrange: " + range;
    text += std::string("\n") + kEffects[static_cast<int>(effect)];
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(28 * ImGui::GetFontSize());
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }

  static std::string label_of(const std::string& key, const scene::Json& schema) {
    const std::string unit = schema.value("unit", "");
    return unit.empty() ? key : key + ", " + unit;
  }

  // The branch of a union that fits `value`, with the description and the unit of the union.
  static scene::Json described_branch(const scene::Json& part, const scene::Json& value) {
    scene::Json branch = scene::chosen_branch(part, value);
    for (const char* words : {"description", "unit"}) {
      if (part.contains(words) && !branch.contains(words)) branch[words] = part[words];
    }
    return branch;
  }

  // In the order of the schema, whatever that of the scene is.
  void draw_members(const scene::Json& schema, const scene::Json& object, const scene::Json::json_pointer& at) {
    if (!schema.contains("properties")) {
      for (const auto& [key, value] : object.items()) draw_member(schema, object, key, value, at);
      return;
    }
    for (const auto& [key, part] : schema["properties"].items()) {
      if (object.contains(key)) {
        draw_member(schema, object, key, object.at(key), at);
      } else if (!at.empty()) {
        draw_addition(part, key, at / key);
      }
    }
  }

  void draw_member(const scene::Json& schema, const scene::Json& object, const std::string& key,
                   const scene::Json& value, const scene::Json::json_pointer& at) {
    const scene::Json* part = scene::schema_of_part(schema, object, key);
    if (part == nullptr || key == "$schema" || key == "hooke") return;
    draw_value(described_branch(*part, value), value, key, at / key);
  }

  // A number that the scene leaves out can be added.
  void draw_addition(const scene::Json& part, const std::string& key, const scene::Json::json_pointer& at) {
    if (!part.contains("type") || part["type"] != "number") return;
    ImGui::PushID(key.c_str());
    if (ImGui::SmallButton("+")) changed(at, part.value("default", part.value("minimum", 0.0)), true);
    ImGui::SameLine();
    ImGui::TextDisabled("%s", label_of(key, part).c_str());
    help(part, at);
    ImGui::PopID();
  }

  void draw_value(const scene::Json& schema, const scene::Json& value, const std::string& key,
                  const scene::Json::json_pointer& at) {
    ImGui::PushID(key.c_str());
    if (value.is_object()) {
      if (!value.empty() && ImGui::TreeNode(key.c_str())) {
        draw_members(schema, value, at);
        ImGui::TreePop();
      }
    } else if (value.is_array()) {
      draw_array(schema, value, key, at);
    } else if (value.is_boolean()) {
      bool on = value.get<bool>();
      if (ImGui::Checkbox(key.c_str(), &on)) changed(at, on, true);
      help(schema, at);
    } else if (value.is_number()) {
      draw_numbers(schema, scene::Json::array({value}), key, at, false);
    } else if (value.is_string()) {
      draw_text(schema, value.get<std::string>(), key, at);
    }
    ImGui::PopID();
  }

  void draw_array(const scene::Json& schema, const scene::Json& value, const std::string& key,
                  const scene::Json::json_pointer& at) {
    const bool numbers = std::all_of(value.begin(), value.end(), [](const scene::Json& v) { return v.is_number(); });
    if (numbers && !value.empty() && value.size() <= 4) return draw_numbers(schema, value, key, at, true);
    if (value.empty() || !ImGui::TreeNode(key.c_str(), "%s (%zu)", key.c_str(), value.size())) return;
    for (std::size_t i = 0; i < std::min(value.size(), kMostItems); ++i) {
      const scene::Json* part = scene::schema_of_part(schema, value, i);
      if (part == nullptr) continue;
      const std::string name = value[i].is_object() ? value[i].value("name", value[i].value("material", "")) : "";
      draw_value(scene::chosen_branch(*part, value[i]), value[i],
                 fmt::format("{}{}{}", i, name.empty() ? "" : " ", name), at / i);
    }
    ImGui::TreePop();
  }

  // A number, or up to four.
  void draw_numbers(const scene::Json& schema, const scene::Json& values, const std::string& key,
                    const scene::Json::json_pointer& at, bool is_array) {
    std::array<double, 4> numbers{};
    double largest = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      numbers[k] = values[k].get<double>();
      largest = std::max(largest, std::abs(numbers[k]));
    }
    const scene::Json& each = is_array && schema.contains("items") ? schema["items"] : schema;
    const bool whole = each.value("type", "") == "integer";
    const double low = each.value("minimum", each.value("exclusiveMinimum", -std::numeric_limits<double>::max()));
    const double high = each.value("maximum", std::numeric_limits<double>::max());
    const auto speed = static_cast<float>(whole ? 0.2 : std::max(0.004 * largest, 1e-4));
    const bool edited =
        ImGui::DragScalarN(label_of(key, schema).c_str(), ImGuiDataType_Double, numbers.data(),
                           static_cast<int>(values.size()), speed, &low, &high, whole ? "%.0f" : "%.5g");
    const bool finished = ImGui::IsItemDeactivatedAfterEdit();
    help(schema, at);
    if (!edited && !finished) return;
    scene::Json next = scene::Json::array();
    for (std::size_t k = 0; k < values.size(); ++k) {
      double number = numbers[k];
      if (each.contains("exclusiveMinimum") && !(number > low)) number = values[k].get<double>();
      next.push_back(whole ? scene::Json(static_cast<std::int64_t>(std::llround(number))) : scene::Json(number));
    }
    changed(at, is_array ? next : next[0], finished && !edited);
  }

  void draw_text(const scene::Json& schema, const std::string& text, const std::string& key,
                 const scene::Json::json_pointer& at) {
    if (schema.contains("enum")) {
      if (ImGui::BeginCombo(key.c_str(), text.c_str())) {
        for (const scene::Json& choice : schema["enum"]) {
          if (!choice.is_string()) continue;
          const auto name = choice.get<std::string>();
          if (ImGui::Selectable(name.c_str(), name == text)) changed(at, name, true);
        }
        ImGui::EndCombo();
      }
    } else if (text.size() == 7 && text[0] == '#') {
      const render::Color color = render::parse_color(text.c_str());
      std::array<float, 3> channels = {color.red / 255.0f, color.green / 255.0f, color.blue / 255.0f};
      if (ImGui::ColorEdit3(key.c_str(), channels.data(), ImGuiColorEditFlags_NoInputs)) {
        const auto byte = [](float c) { return static_cast<int>(std::lround(255 * std::clamp(c, 0.0f, 1.0f))); };
        changed(at, fmt::format("#{:02x}{:02x}{:02x}", byte(channels[0]), byte(channels[1]), byte(channels[2])), false);
      }
    } else if (at.back() == "name" || at.back() == "description") {
      std::string edited = text;
      if (ImGui::InputText(key.c_str(), &edited, ImGuiInputTextFlags_EnterReturnsTrue)) changed(at, edited, true);
    } else {
      ImGui::LabelText(key.c_str(), "%s", text.c_str());
    }
    help(schema, at);
  }

  const scene::Json& scene_;
  std::optional<SceneEdit> edit_;
};

}  // namespace

std::optional<SceneEdit> draw_scene_widgets(const scene::Json& scene) { return Widgets(scene).draw(); }

}  // namespace hooke::view
