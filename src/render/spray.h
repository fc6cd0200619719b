// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hooke/render/frame.h"

namespace hooke::render {

/// Draws a particle of loose water, `drop`, as spray: it becomes smaller, by a share of its own, and fine drops of
/// several sizes around it are added to `fine`. `particle`: its id, from which its drops follow, so that they stay with
/// it from picture to picture; `radius`: the particle's, m; `loose`: how far it is a drop of its own, and `dense`: how
/// far it is one of many, both from 0 to 1. A drop alone stays one.
void make_spray(Sphere& drop, std::uint64_t particle, float radius, float loose, float dense,
                std::vector<Sphere>& fine);

}  // namespace hooke::render
