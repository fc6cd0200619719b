// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/gl_loader.h"

#include "hooke/render/gl_module.h"
#include "hooke/run/module_loader.h"

namespace hooke::run {

Expected<std::unique_ptr<render::Renderer>> load_gl_renderer(const render::RenderSettings& settings) {
#if !HOOKE_WITH_GL
  return fail(Error::Kind::bad_input, "OpenGL", "pictures need OpenGL, which is not in this build (HOOKE_WITH_GL)");
#endif
  const auto module = Module::load("hooke-gl.so", "hooke_gl_version", "OpenGL", "pictures need it");
  if (!module) return fail(module.error());
  const auto make = module->function<decltype(hooke_make_gl_renderer)>("hooke_make_gl_renderer");
  if (make == nullptr) return fail(Error::Kind::bad_input, "hooke-gl.so", "is of another version of hooke");
  Expected<std::unique_ptr<render::Renderer>> renderer;
  make(settings, renderer);
  return renderer;
}

}  // namespace hooke::run
