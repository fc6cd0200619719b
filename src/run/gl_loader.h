// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "hooke/base/expected.h"
#include "hooke/render/renderer.h"

namespace hooke::run {

/// make_gl_renderer() of hooke-gl.so, which lies in the folder of the program or library that this function is part of,
/// in one of the folders above it, or in a library folder below one of those. bad_input where the module or a library
/// that it needs can't be loaded. The renderer belongs to the calling thread.
Expected<std::unique_ptr<render::Renderer>> load_gl_renderer(const render::RenderSettings& settings);

}  // namespace hooke::run
