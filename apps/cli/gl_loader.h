// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "hooke/base/expected.h"
#include "hooke/render/renderer.h"

/// The function that hooke-gl.so exports.
extern "C" void hooke_make_gl_renderer(const hooke::render::RenderSettings& settings,
                                       hooke::Expected<std::unique_ptr<hooke::render::Renderer>>& renderer);

namespace hooke::cli {

/// make_gl_renderer() of hooke-gl.so, which lies beside this program or in its library folder. bad_input where the
/// module or a library that it needs can't be loaded. The renderer belongs to the calling thread.
Expected<std::unique_ptr<render::Renderer>> load_gl_renderer(const render::RenderSettings& settings);

}  // namespace hooke::cli
