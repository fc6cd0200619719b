// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/attraction.h"
#include "hooke/scene/json_reader.h"

namespace hooke::scene {

/// Builds a scene's "attraction" from its JSON, which has passed the schema and has its defaults.
Attraction build_attraction(const Json& json);

}  // namespace hooke::scene
