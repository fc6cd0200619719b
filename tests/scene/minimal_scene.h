// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hooke {

/// The shortest possible scene, with two particles.
inline constexpr const char* kMinimalScene = R"({
  "hooke": 1,
  "time": { "step": 0.01, "end": 1 },
  "domain": { "min": [0, 0, 0], "max": [10, 10, 10] },
  "materials": { "water": { "radius": 0.5, "mass": 2, "stiffness": 100 } },
  "particles": [
    { "material": "water", "block": { "min": [1, 1, 1], "max": [2, 1, 1], "spacing": 1 } }
  ]
})";

}  // namespace hooke
