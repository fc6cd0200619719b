// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/module_loader.h"

#include <dlfcn.h>
#include <link.h>

#include <filesystem>
#include <string_view>
#include <system_error>

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
fs::path find_module(const std::string& file) {
  std::error_code ignored;
  const fs::path home = own_file().parent_path();
  fs::path beside = home / file;
  if (fs::exists(beside, ignored)) return beside;
  for (const char* below : {HOOKE_PROGRAMS_BELOW_PREFIX, HOOKE_LIBRARIES_BELOW_PREFIX, HOOKE_PYTHON_BELOW_PREFIX}) {
    const fs::path prefix = prefix_of(home, below);
    const fs::path module = prefix / HOOKE_MODULES_BELOW_PREFIX / file;
    if (!prefix.empty() && fs::exists(module, ignored)) return module;
  }
  return beside;
}

}  // namespace

Expected<Module> Module::load(const std::string& file, const char* version, const char* subject, const char* needs) {
  const fs::path module = find_module(file);
  void* const library = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* const why = dlerror();
    return fail(Error::Kind::bad_input, subject, std::string(needs) + ": " + why);
  }
  const Module loaded(library);
  const auto version_of = loaded.function<const char*()>(version);
  if (version_of == nullptr || std::string_view(version_of()) != HOOKE_VERSION)
    return fail(Error::Kind::bad_input, module.string(), "is of another version of hooke");
  return loaded;
}

void* Module::find(const char* name) const { return dlsym(library_, name); }

}  // namespace hooke::run
