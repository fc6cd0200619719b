// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "hooke/base/expected.h"
#include "hooke/render/renderer.h"

namespace hooke::render {

/// A renderer that draws with OpenGL 3.3, without a window, on the thread that calls this function. bad_input where
/// there is no OpenGL, or the settings can't be met.
Expected<std::unique_ptr<Renderer>> make_gl_renderer(const RenderSettings& settings);

}  // namespace hooke::render
