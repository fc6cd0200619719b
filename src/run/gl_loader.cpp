// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/gl_loader.h"

#include <dlfcn.h>
#include <link.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "hooke/render/gl_module.h"

namespace hooke::run {
namespace {

namespace fs = std::filesystem;

// The file that this code was loaded from: a program, or a shared library that links Hooke.
fs::path own_file() {
  std::error_code ignored;
  Dl_info info{};
  link_map* loaded = nullptr;
  static const char kHere = 0;
  const bool found = dladdr1(&kHere, &info, reinterpret_cast<void**>(&loaded), RTLD_DL_LINKMAP) != 0;
  const bool is_library = found && loaded != nullptr && loaded->l_name[0] != 0;
  return is_library ? fs::canonical(loaded->l_name, ignored) : fs::read_symlink("/proc/self/exe", ignored);
}

// The module; beside this file where it is nowhere.
fs::path find_module() {
  constexpr int kFoldersUp = 4;  // /usr is that far above lib/python3/dist-packages/hooke
  std::error_code ignored;
  const fs::path home = own_file().parent_path();
  fs::path folder = home;
  for (int k = 0; k <= kFoldersUp; ++k, folder = folder.parent_path()) {
    for (const fs::path& module : {folder / "hooke-gl.so", folder / HOOKE_MODULES_BELOW_PREFIX / "hooke-gl.so"}) {
      if (fs::exists(module, ignored)) return module;
    }
  }
  return home / "hooke-gl.so";
}

}  // namespace

Expected<std::unique_ptr<render::Renderer>> load_gl_renderer(const render::RenderSettings& settings) {
#if !HOOKE_WITH_GL
  return fail(Error::Kind::bad_input, "OpenGL", "pictures need OpenGL, which is not in this build (HOOKE_WITH_GL)");
#endif
  const fs::path module = find_module();
  // Never closed: the driver's threads may still run in the library.
  void* const library = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return fail(Error::Kind::bad_input, "OpenGL", std::string("pictures need it: ") + dlerror());
  const auto make = reinterpret_cast<decltype(&hooke_make_gl_renderer)>(dlsym(library, "hooke_make_gl_renderer"));
  if (make == nullptr) return fail(Error::Kind::bad_input, module.string(), "is of another version of hooke");
  Expected<std::unique_ptr<render::Renderer>> renderer;
  make(settings, renderer);
  return renderer;
}

}  // namespace hooke::run
