// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hooke/core/materials.h"
#include "hooke/scene/findings.h"

namespace hooke::scene {

/// The index of the material that the text at the path `where` names; nothing, with a finding, if there is none.
std::optional<std::size_t> material_named(const std::string& name, const std::string& where,
                                          const std::vector<Material>& materials, Findings& findings);

}  // namespace hooke::scene
