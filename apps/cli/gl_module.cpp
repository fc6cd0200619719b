// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The part of the program that needs OpenGL's libraries. It is loaded only when a picture is wanted, so that everything
// else runs without these libraries (gl_loader.h).

#include "gl_loader.h"
#include "hooke/render/gl/gl_renderer.h"

extern "C" __attribute__((visibility("default"))) void hooke_make_gl_renderer(
    const hooke::render::RenderSettings& settings,
    hooke::Expected<std::unique_ptr<hooke::render::Renderer>>& renderer) {
  renderer = hooke::render::make_gl_renderer(settings);
}
