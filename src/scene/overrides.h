// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"

namespace hooke::scene {

/// Applies "PATH=VALUE" texts to a scene in their order. A key that excludes another ("time.end", "time.steps")
/// replaces it. An override that can't be applied becomes a finding.
void apply_overrides(const std::vector<std::string>& overrides, Json& scene, Findings& findings);

}  // namespace hooke::scene
