// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "gl_loader.h"

#include <dlfcn.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace hooke::cli {

Expected<std::unique_ptr<render::Renderer>> load_gl_renderer(const render::RenderSettings& settings) {
  std::error_code ignored;
  const std::filesystem::path home = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
  const std::filesystem::path beside = home / "hooke-gl.so";
  const std::filesystem::path module =
      std::filesystem::exists(beside, ignored) ? beside : home / HOOKE_MODULES_FROM_PROGRAM / "hooke-gl.so";
  // Never closed: the driver's threads may still run in the library.
  void* const library = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return fail(Error::Kind::bad_input, "OpenGL", std::string("pictures need it: ") + dlerror());
  const auto make = reinterpret_cast<decltype(&hooke_make_gl_renderer)>(dlsym(library, "hooke_make_gl_renderer"));
  if (make == nullptr) return fail(Error::Kind::bad_input, module.string(), "is of another version of hooke");
  Expected<std::unique_ptr<render::Renderer>> renderer;
  make(settings, renderer);
  return renderer;
}

}  // namespace hooke::cli
