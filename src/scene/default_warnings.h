// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/scene.h"

namespace hooke::scene {

/// Where a default of a scene that is otherwise right is likely to surprise: a wind over cloths that it does not press
/// on, and grains (contacts without tension) whose friction has no limit. Paths are those of the scene file.
std::vector<Finding> default_warnings(const Scene& scene);

}  // namespace hooke::scene
