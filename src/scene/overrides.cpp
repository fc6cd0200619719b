// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/overrides.h"

#include <fmt/format.h>

#include <algorithm>

#include "hooke/scene/schema.h"

namespace hooke::scene {
namespace {

// The '=' between path and value: the first one outside quoted keys.
std::size_t find_equals(const std::string& text) {
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quoted && text[i] == '\\')
      ++i;
    else if (text[i] == '"')
      quoted = !quoted;
    else if (text[i] == '=' && !quoted)
      return i;
  }
  return std::string::npos;
}

bool is_utf8(const std::string& text) {
  try {
    (void)Json(text).dump();
    return true;
  } catch (const Json::type_error&) {
    return false;
  }
}

// Walks down a path and creates what is missing.
class Setter {
 public:
  Setter(Json& scene, Findings& findings) : at_(&scene), schema_(&schema_root()), findings_(findings) {}

  void set(const JsonPath& path, Json value) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      const bool found = std::visit([this](const auto& part) { return descend(part); }, path[i]);
      if (!found) return;
      // A missing value starts as the container that the next part of the path needs.
      if (at_->is_null() && i + 1 < path.size()) {
        *at_ = std::holds_alternative<std::string>(path[i + 1]) ? Json::object() : Json::array();
      }
    }
    *at_ = std::move(value);
  }

 private:
  bool descend(const std::string& key) {
    if (!at_->is_object()) {
      findings_.add(join_path(where_, key), fmt::format("can't be set: {} is {}, which has no keys",
                                                        where_.empty() ? "the scene" : where_, brief(*at_)));
      return false;
    }
    if (schema_ != nullptr) {
      const Alternatives alternatives = alternatives_of(*schema_, *at_);
      const auto& keys = alternatives.keys;
      if (alternatives.exclusive && std::find(keys.begin(), keys.end(), key) != keys.end()) {
        for (const std::string& other : keys) {
          if (other != key) at_->erase(other);
        }
      }
      schema_ = schema_of_part(*schema_, *at_, key);
    }
    at_ = &(*at_)[key];
    where_ = join_path(where_, key);
    return true;
  }

  bool descend(std::size_t index) {
    if (!at_->is_array() || index > at_->size()) {
      findings_.add(join_path(where_, index), fmt::format("can't be set: {} is {}, {}", where_, brief(*at_),
                                                          at_->is_array() ? "counted from 0" : "no list"));
      return false;
    }
    if (schema_ != nullptr) schema_ = schema_of_part(*schema_, *at_, index);
    if (index == at_->size()) at_->push_back(nullptr);
    at_ = &(*at_)[index];
    where_ = join_path(where_, index);
    return true;
  }

  Json* at_;
  const Json* schema_;  // null where the schema has no entry for this
  std::string where_;
  Findings& findings_;
};

void apply(const std::string& text, Json& scene, Findings& findings) {
  const auto complain = [&](std::string message) {
    findings.add_elsewhere("--set " + printable(text, 60), std::move(message));
  };
  const std::size_t equals = find_equals(text);
  if (equals == std::string::npos) return complain("must be PATH=VALUE, for instance time.step=0.002");
  if (!is_utf8(text)) return complain("is not valid UTF-8");
  const auto path = parse_path(std::string_view(text).substr(0, equals));
  if (!path)
    return complain("the path must be keys with dots and indices in brackets, for instance particles[0].block.count");

  const std::string where = to_text(*path);
  const std::string value_text = text.substr(equals + 1);
  JsonReading reading = read_json(value_text, "--set " + where, where);
  if (!reading.value && !reading.syntax_error) {
    return complain(reading.stopped ? reading.stopped->message : reading.faults.front().second);
  }
  findings.forget_lines(where);
  for (auto& [place, message] : reading.faults) findings.add(place, std::move(message));
  Setter(scene, findings).set(*path, reading.value ? std::move(*reading.value) : Json(value_text));
}

}  // namespace

void apply_overrides(const std::vector<std::string>& overrides, Json& scene, Findings& findings) {
  for (const std::string& text : overrides) apply(text, scene, findings);
}

}  // namespace hooke::scene
