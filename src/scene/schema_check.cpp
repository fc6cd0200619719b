// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/schema_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <set>
#include <string_view>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "hooke/scene/foreign_keys.h"
#include "hooke/scene/schema.h"
#include "hooke/scene/spelling.h"

namespace hooke::scene {
namespace {

struct CompiledSchema {
  CompiledSchema() {
    const nlohmann::json root = schema_root();
    const valijson::adapters::NlohmannJsonAdapter adapter(root);
    valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(adapter, schema);
  }
  valijson::Schema schema;
};

// A value that valijson refused, with its part of the schema.
struct Fault {
  std::string path;
  const Json* value;
  const Json* schema;       // null below an unknown key
  std::string description;  // valijson's words
};

// Follows valijson's path "<root>", "[key]", "[3]" down into the scene.
Fault locate(const valijson::ValidationResults::Error& error, const Json& scene) {
  Fault fault{"", &scene, &schema_root(), error.description};
  for (std::size_t i = 1; i < error.context.size(); ++i) {
    const std::string part = error.context[i].substr(1, error.context[i].size() - 2);
    if (fault.value->is_array()) {
      const std::size_t index = std::stoul(part);
      if (fault.schema != nullptr) fault.schema = schema_of_part(*fault.schema, *fault.value, index);
      fault.value = &fault.value->at(index);
      fault.path = join_path(fault.path, index);
    } else {
      if (fault.schema != nullptr) fault.schema = schema_of_part(*fault.schema, *fault.value, part);
      fault.value = &fault.value->at(part);
      fault.path = join_path(fault.path, part);
    }
  }
  return fault;
}

std::string number_text(const Json& number) { return number.dump(); }

std::string allowed_number(const Json& schema) {
  std::string words = schema.at("type") == "integer" ? "a whole number" : "a number";
  std::vector<std::string> bounds;
  if (schema.contains("exclusiveMinimum")) bounds.push_back("> " + number_text(schema.at("exclusiveMinimum")));
  if (schema.contains("minimum")) bounds.push_back(">= " + number_text(schema.at("minimum")));
  if (schema.contains("maximum")) bounds.push_back("<= " + number_text(schema.at("maximum")));
  for (std::size_t i = 0; i < bounds.size(); ++i) words += (i == 0 ? " " : " and ") + bounds[i];
  return words;
}

std::string allowed_list(const Json& schema) {
  if (!schema.contains("items")) return "a list";
  const Json& items = schema.at("items");
  const bool fixed = schema.contains("minItems") && schema.contains("maxItems");
  if (items.contains("enum")) {
    return fmt::format("a list{}, each {}", fixed ? " of " + schema.at("minItems").dump() : "", allowed_by(items));
  }
  const std::string type = items.value("type", "");
  const char* const of = type == "number"    ? "numbers"
                         : type == "string"  ? "texts"
                         : type == "array"   ? "lists"
                         : type == "integer" ? "whole numbers"
                                             : "objects";
  return fixed ? fmt::format("a list of {} {}", schema.at("minItems").dump(), of) : fmt::format("a list of {}", of);
}

bool breaks_range(const Json& schema, const Json& value) {
  const auto beyond = [&](const char* keyword, auto wrong) {
    return schema.contains(keyword) && wrong(value.get<double>(), schema.at(keyword).get<double>());
  };
  return value.is_number() && (beyond("exclusiveMinimum", [](double v, double b) { return !(v > b); }) ||
                               beyond("minimum", [](double v, double b) { return !(v >= b); }) ||
                               beyond("maximum", [](double v, double b) { return !(v <= b); }));
}

// Whether a plain value has the right type but is not allowed.
bool breaks_rule(const Json& schema, const Json& value) {
  if (breaks_range(schema, value)) return true;
  if (schema.contains("const")) return value != schema.at("const");
  if (schema.contains("enum")) {
    const Json& allowed = schema.at("enum");
    return std::find(allowed.begin(), allowed.end(), value) == allowed.end();
  }
  if (!value.is_string()) return false;
  const std::string& text = value.get_ref<const std::string&>();
  if (text.size() < schema.value("minLength", std::size_t{0})) return true;
  return schema.contains("pattern") && !std::regex_match(text, std::regex(schema.at("pattern").get<std::string>()));
}

std::vector<std::string> enum_names(const Json& schema) {
  std::vector<std::string> names;
  if (schema.contains("anyOf")) {
    for (const Json& branch : schema.at("anyOf")) {
      if (branch.contains("enum")) return enum_names(branch);
    }
  }
  if (schema.contains("enum")) {
    for (const Json& name : schema.at("enum")) {
      if (name.is_string()) names.push_back(name);
    }
  }
  return names;
}

// Words what is wrong with one value itself, not with its members.
class Wording {
 public:
  Wording(const Fault& fault, Findings& findings)
      : path_(fault.path),
        value_(*fault.value),
        schema_(chosen_branch(*fault.schema, value_)),
        findings_(findings) {}

  // Whether anything was wrong.
  bool say() {
    const bool no_branch_fits = schema_.contains("anyOf") && !schema_.contains("type");
    if (no_branch_fits || !has_type(schema_, value_) || breaks_rule(schema_, value_)) {
      std::string hint;
      if (value_.is_string()) hint = did_you_mean(value_.get_ref<const std::string&>(), enum_names(schema_));
      complain(path_, fmt::format("is {}; must be {}{}", brief(value_), allowed_by(schema_), hint));
    } else if (value_.is_array()) {
      say_length();
    } else if (value_.is_object()) {
      say_missing_keys();
      say_unknown_keys();
      say_alternatives();
      if (value_.size() > schema_.value("maxProperties", value_.size())) {
        complain(path_, fmt::format("has {} entries; at most {} are possible", value_.size(),
                                    schema_.at("maxProperties").dump()));
      }
    }
    return said_;
  }

 private:
  void complain(const std::string& path, std::string message) {
    findings_.add(path, std::move(message));
    said_ = true;
  }

  void say_length() {
    const std::size_t size = value_.size();
    if (size >= schema_.value("minItems", std::size_t{0}) && size <= schema_.value("maxItems", size)) return;
    complain(path_, fmt::format("is {}; must be {}", brief(value_), allowed_by(schema_)));
  }

  void say_missing_keys() {
    if (!schema_.contains("required")) return;
    for (const std::string key : schema_.at("required")) {
      if (value_.contains(key)) continue;
      complain(join_path(path_, key), "is missing; must be " + allowed_by(schema_.at("properties").at(key)));
    }
  }

  void say_unknown_keys() {
    if (schema_.value("additionalProperties", Json()) != false) return;
    std::vector<std::string> known;
    for (const auto& property : schema_.at("properties").items()) {
      if (property.key() != "$schema") known.push_back(property.key());
    }
    for (const auto& member : value_.items()) {
      if (findings_.overflows()) return;
      if (schema_.at("properties").contains(member.key())) continue;
      if (const std::string_view foreign = foreign_key_hint(member.key()); !foreign.empty()) {
        complain(join_path(path_, member.key()),
                 fmt::format("is no key of a scene (its value: {}): {}", brief(member.value()), foreign));
        continue;
      }
      const std::string hint = did_you_mean(member.key(), known);
      complain(join_path(path_, member.key()),
               fmt::format("is no key of a scene (its value: {}){}{} keys here: {}", brief(member.value()), hint,
                           hint.empty() ? ";" : "", quoted_list(known)));
    }
  }

  void say_alternatives() {
    const Alternatives alternatives = alternatives_of(schema_, value_);
    if (alternatives.keys.empty()) return;
    std::vector<std::string> given;
    std::string values;
    for (const std::string& key : alternatives.keys) {
      if (!value_.contains(key)) continue;
      given.push_back(key);
      values += fmt::format("{}\"{}\" ({})", values.empty() ? "" : " and ", key, brief(value_.at(key)));
    }
    std::string all;
    for (const std::string& key : alternatives.keys) all += fmt::format("{}\"{}\"", all.empty() ? "" : " or ", key);
    if (given.empty()) complain(path_, fmt::format("needs {}; none is given", all));
    if (given.size() > 1 && alternatives.exclusive) {
      complain(path_, fmt::format("has {}, which contradict each other; give {}", values, all));
    }
  }

  const std::string& path_;
  const Json& value_;
  const Json& schema_;
  Findings& findings_;
  bool said_ = false;
};

}  // namespace

std::string allowed_by(const Json& schema) {
  std::string words;
  if (schema.contains("anyOf") && !schema.contains("type")) {
    for (const Json& branch : schema.at("anyOf")) words += (words.empty() ? "" : ", or ") + allowed_by(branch);
    if (schema.contains("unit")) words += fmt::format(" ({})", schema.at("unit").get<std::string>());
    return words;
  }
  if (schema.contains("const")) return schema.at("const").dump();
  if (schema.contains("enum")) {
    const Json& names = schema.at("enum");
    for (std::size_t i = 0; i < names.size(); ++i) {
      words += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i].dump();
    }
    return words;
  }
  const std::string type = schema.value("type", "");
  if (type == "number" || type == "integer") {
    words = allowed_number(schema);
  } else if (type == "array") {
    words = allowed_list(schema);
  } else if (type == "object") {
    words = "an object {...}";
  } else if (type == "boolean") {
    words = "true or false";
  } else {
    words = "a text";
    if (schema.contains("examples")) words += " like " + schema.at("examples").front().dump();
  }
  if (schema.contains("unit")) words += fmt::format(" ({})", schema.at("unit").get<std::string>());
  return words;
}

void check_against_schema(const Json& scene, Findings& findings) {
  static const CompiledSchema compiled;
  const nlohmann::json target = scene;
  valijson::ValidationResults results;
  valijson::Validator validator;
  if (validator.validate(compiled.schema, valijson::adapters::NlohmannJsonAdapter(target), &results)) return;

  // valijson reports a fault once for every rule and every level that it breaks. Each value is worded once, and only
  // for faults of its own.
  std::set<std::string> seen;
  std::vector<Fault> unworded;
  for (const auto& error : results) {
    if (findings.overflows()) return;
    Fault fault = locate(error, scene);
    if (fault.schema == nullptr || !seen.insert(fault.path).second || findings.touches_at(fault.path)) continue;
    if (!Wording(fault, findings).say()) unworded.push_back(std::move(fault));
  }
  for (const Fault& fault : unworded) {
    if (!findings.touches(fault.path))
      findings.add(fault.path, fmt::format("is {}: {}", brief(*fault.value), printable(fault.description)));
  }
}

}  // namespace hooke::scene
