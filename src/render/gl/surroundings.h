// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/render/frame.h"
#include "hooke/render/gl/gl_objects.h"

namespace hooke::render {

/// Sets the uniforms of light.glsl that say what is around the action: sky, ground and how bright they are.
void set_surroundings(const gl::Program& program, const Frame& frame);

}  // namespace hooke::render
