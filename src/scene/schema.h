// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "hooke/scene/json_path.h"
#include "hooke/scene/json_reader.h"

namespace hooke::scene {

/// schema/scene.json as a value, with every "$ref" replaced by its definition.
const Json& schema_root();

/// The part of `schema` for the member `key` of the object `value`, or for an item of the array `value`; null where it
/// has none (an unknown key). Of a union, the branch that fits `value` is used.
const Json* schema_of_part(const Json& schema, const Json& value, const std::string& key);
const Json* schema_of_part(const Json& schema, const Json& value, std::size_t index);

/// The branch of the schema's union whose type `value` has; `schema` itself where it has no such branch.
const Json& chosen_branch(const Json& schema, const Json& value);

/// Whether `value` has the type that a schema without union names ("number", "array" ...); true where it names none.
bool has_type(const Json& schema, const Json& value);

/// Keys of an object, some of which are required.
struct Alternatives {
  std::vector<std::string> keys;
  bool exclusive = true;  ///< Exactly one is required; if false, at least one
};
/// The alternatives that apply to the object `value`; no keys where the schema names none.
Alternatives alternatives_of(const Json& schema, const Json& value);

/// Writes the schema's defaults for what `value` leaves out, at all levels. Leaves values of a wrong type alone.
void fill_defaults(const Json& schema, Json& value);

}  // namespace hooke::scene
