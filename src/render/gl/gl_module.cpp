// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/render/gl_module.h"

#include "hooke/render/gl/gl_renderer.h"

extern "C" __attribute__((visibility("default"))) const char* hooke_gl_version() { return HOOKE_VERSION; }

extern "C" __attribute__((visibility("default"))) void hooke_make_gl_renderer(
    const hooke::render::RenderSettings& settings,
    hooke::Expected<std::unique_ptr<hooke::render::Renderer>>& renderer) {
  renderer = hooke::render::make_gl_renderer(settings);
}
