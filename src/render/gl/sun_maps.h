// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "hooke/render/gl/gl_buffers.h"
#include "hooke/render/gl/render_programs.h"
#include "hooke/render/gl/render_targets.h"
#include "hooke/render/gl/seen_spheres.h"
#include "hooke/render/gl/sun.h"

namespace hooke::render {

/// Draws how far the sun's light gets past solids into one map, and past water, where there is any, into another.
/// `spheres`: those that the sun sees.
void draw_sun_maps(const RenderTargets& targets, const RenderPrograms& programs, const Sun& sun,
                   const SeenSpheres& spheres, bool water, const MeshBuffer& buffer,
                   std::span<const ShadedMesh> meshes);

}  // namespace hooke::render
