// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "hooke/base/expected.h"
#include "hooke/render/renderer.h"

namespace hooke::run {

/// make_gl_renderer() of hooke-gl.so, which lies in the folder of the program or library that this function is part of,
/// or, where that folder is one of those that Hooke is installed in, below the same prefix. bad_input where the module
/// or a library that it needs can't be loaded, or it is of another version. The renderer belongs to the calling thread.
Expected<std::unique_ptr<render::Renderer>> load_gl_renderer(const render::RenderSettings& settings);

}  // namespace hooke::run
