// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/schema.h"

#include "hooke/scene/load_scene.h"

namespace hooke::scene {
namespace {

const Json* find(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

// "required" of each branch of a oneOf or anyOf: the keys that are alternatives.
Alternatives from_branches(const Json& schema) {
  Alternatives found;
  for (const char* keyword : {"oneOf", "anyOf"}) {
    const Json* branches = find(schema, keyword);
    if (branches == nullptr) continue;
    found.exclusive = std::string_view(keyword) == "oneOf";
    for (const Json& branch : *branches) {
      if (const Json* required = find(branch, "required")) found.keys.push_back(required->front());
    }
  }
  return found;
}

// Whether an "if" of the form {"properties": {KEY: {"const": VALUE}}} holds.
bool condition_holds(const Json& condition, const Json& value) {
  for (const auto& property : condition.at("properties").items()) {
    const Json* actual = find(value, property.key().c_str());
    if (actual == nullptr || *actual != property.value().at("const")) return false;
  }
  return true;
}

// Replaces {"$ref": "#/definitions/NAME", ...} by the definition; keys written beside "$ref" take precedence.
void put_in_definitions(const Json& definitions, Json& schema) {
  if (schema.is_object() && schema.contains("$ref")) {
    const std::string name = schema.at("$ref").get<std::string>();
    Json whole = definitions.at(name.substr(name.rfind('/') + 1));
    for (const auto& [key, value] : schema.items()) {
      if (key != "$ref") whole[key] = value;
    }
    schema = std::move(whole);
  }
  if (!schema.is_structured()) return;
  for (Json& part : schema) put_in_definitions(definitions, part);
}

}  // namespace

const Json& schema_root() {
  static const Json root = [] {
    Json schema = Json::parse(scene_schema());
    const Json definitions = schema.at("definitions");
    schema.erase("definitions");
    put_in_definitions(definitions, schema);
    return schema;
  }();
  return root;
}

bool has_type(const Json& schema, const Json& value) {
  const Json* type = find(schema, "type");
  if (type == nullptr) return true;
  if (*type == "object") return value.is_object();
  if (*type == "array") return value.is_array();
  if (*type == "string") return value.is_string();
  if (*type == "integer") return value.is_number_integer();
  if (*type == "number") return value.is_number();
  return value.is_boolean();
}

const Json& chosen_branch(const Json& schema, const Json& value) {
  const Json* branches = find(schema, "anyOf");
  if (branches == nullptr) return schema;
  for (const Json& branch : *branches) {
    if (branch.contains("type") && has_type(branch, value)) return branch;
  }
  return schema;
}

const Json* schema_of_part(const Json& schema, const Json& value, const std::string& key) {
  const Json& branch = chosen_branch(schema, value);
  if (const Json* properties = find(branch, "properties")) return find(*properties, key.c_str());
  const Json* others = find(branch, "additionalProperties");
  return others != nullptr && others->is_object() ? others : nullptr;
}

const Json* schema_of_part(const Json& schema, const Json& value, std::size_t) {
  return find(chosen_branch(schema, value), "items");
}

Alternatives alternatives_of(const Json& schema, const Json& value) {
  if (!value.is_object()) return {};
  const Json* condition = find(schema, "if");
  return from_branches(condition == nullptr ? schema : schema.at(condition_holds(*condition, value) ? "then" : "else"));
}

void fill_defaults(const Json& schema, Json& value) {
  const Json& branch = chosen_branch(schema, value);
  if (!has_type(branch, value)) return;
  if (value.is_object()) {
    if (const Json* properties = find(branch, "properties")) {
      for (const auto& property : properties->items()) {
        const Json* fallback = find(property.value(), "default");
        if (fallback != nullptr && !value.contains(property.key())) value[property.key()] = *fallback;
      }
    }
    for (auto& member : value.items()) {
      if (const Json* part = schema_of_part(branch, value, member.key())) fill_defaults(*part, member.value());
    }
  } else if (value.is_array()) {
    for (Json& item : value) {
      if (const Json* part = schema_of_part(branch, value, std::size_t{0})) fill_defaults(*part, item);
    }
  }
}

}  // namespace hooke::scene
