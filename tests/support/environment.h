// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace hooke::test {

/// Sets an environment variable, for this process and processes it starts, during its lifetime.
class EnvironmentVariable {
 public:
  EnvironmentVariable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  EnvironmentVariable(const EnvironmentVariable&) = delete;
  EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;
  ~EnvironmentVariable() {
    if (before_) {
      setenv(name_, before_->c_str(), 1);
    } else {
      unsetenv(name_);
    }
  }

 private:
  const char* name_;
  std::optional<std::string> before_;
};

/// From now on Mesa's software driver draws OpenGL, on a machine with any graphics card: only Mesa's driver is used,
/// and only its device for the processor.
inline void use_software_gl() {
  constexpr const char* kMesa = "/usr/share/glvnd/egl_vendor.d/50_mesa.json";
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  if (std::filesystem::exists(kMesa)) setenv("__EGL_VENDOR_LIBRARY_FILENAMES", kMesa, 1);
}

}  // namespace hooke::test
