// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/gl_loader.h"

#include <dlfcn.h>
#include <link.h>

#include <filesystem>
#include <string>
#include <string_view>
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

// The prefix of an installation where `home` is its folder `below`; empty otherwise. No other folder above `home` is
// looked into: anybody may write into it, if it is /tmp.
fs::path prefix_of(const fs::path& home, const fs::path& below) {
  fs::path prefix = home;
  for (auto name = below.end(); name != below.begin(); prefix = prefix.parent_path()) {
    if (prefix.filename() != *--name) return {};
  }
  return prefix;
}

// The module; beside this file where it is nowhere.
fs::path find_module() {
  std::error_code ignored;
  const fs::path home = own_file().parent_path();
  fs::path beside = home / "hooke-gl.so";
  if (fs::exists(beside, ignored)) return beside;
  for (const char* below : {HOOKE_PROGRAMS_BELOW_PREFIX, HOOKE_LIBRARIES_BELOW_PREFIX, HOOKE_PYTHON_BELOW_PREFIX}) {
    const fs::path prefix = prefix_of(home, below);
    const fs::path module = prefix / HOOKE_MODULES_BELOW_PREFIX / "hooke-gl.so";
    if (!prefix.empty() && fs::exists(module, ignored)) return module;
  }
  return beside;
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
  const auto version = reinterpret_cast<decltype(&hooke_gl_version)>(dlsym(library, "hooke_gl_version"));
  const auto make = reinterpret_cast<decltype(&hooke_make_gl_renderer)>(dlsym(library, "hooke_make_gl_renderer"));
  const bool fits = version != nullptr && make != nullptr && std::string_view(version()) == HOOKE_VERSION;
  if (!fits) return fail(Error::Kind::bad_input, module.string(), "is of another version of hooke");
  Expected<std::unique_ptr<render::Renderer>> renderer;
  make(settings, renderer);
  return renderer;
}

}  // namespace hooke::run
