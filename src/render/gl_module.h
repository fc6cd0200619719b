// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "hooke/base/expected.h"
#include "hooke/render/renderer.h"

/// The version of Hooke that the module is of, e.g. "1.2.3".
extern "C" const char* hooke_gl_version();

/// The function that the module hooke-gl.so exports: make_gl_renderer() (render/gl/gl_renderer.h), for programs that
/// load what needs OpenGL only when a picture is wanted. To be called only where hooke_gl_version() is the caller's.
extern "C" void hooke_make_gl_renderer(const hooke::render::RenderSettings& settings,
                                       hooke::Expected<std::unique_ptr<hooke::render::Renderer>>& renderer);
