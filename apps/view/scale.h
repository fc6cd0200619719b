// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>

#include "hooke/core/scene.h"
#include "view_frame.h"

namespace hooke::view {

/// The values at the two ends of the colours that suit a scene, ascending.
std::tuple<double, double> default_range(const Scene& scene, const ParticleSet& first, const ColoringInfo& coloring);

}  // namespace hooke::view
