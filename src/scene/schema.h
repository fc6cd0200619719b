// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "hooke/scene/json_path.h"
#include "hooke/scene/json_reader.h"

namespace hooke {

/// schema/scene.json, as a value; what it refers to by "$ref" in its place.
const Json& schema_root();

/// The part of the schema that rules the value `part` of a value that `schema` rules; null where it rules none
/// (an unknown key). Of a union the branch that fits `value` is looked into.
const Json* schema_of_part(const Json& schema, const Json& value, const std::string& key);
const Json* schema_of_part(const Json& schema, const Json& value, std::size_t index);

/// `schema` itself, or the branch of its union whose type `value` has; `schema` where none has.
const Json& chosen_branch(const Json& schema, const Json& value);

/// Whether `value` is of the type that a schema without union names ("number", "array" ...), or it names none.
bool has_type(const Json& schema, const Json& value);

/// Keys of an object of which some are needed.
struct Alternatives {
  std::vector<std::string> keys;
  bool exclusive = true;  ///< exactly one; else at least one
};
/// The alternatives in force for the object `value`; no keys where the schema names none.
Alternatives alternatives_of(const Json& schema, const Json& value);

/// Writes the schema's defaults into what `value` leaves out, all the way down. Values of a wrong type stay alone.
void fill_defaults(const Json& schema, Json& value);

}  // namespace hooke
