// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"

namespace hooke::scene {

/// Checks a scene against the schema and words every finding from it: the value, what is allowed, the nearest key for a
/// misspelling.
void check_against_schema(const Json& scene, Findings& findings);

/// What a part of the schema allows, in words: "a number > 0 (m)".
std::string allowed_by(const Json& schema);

}  // namespace hooke::scene
