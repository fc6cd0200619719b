// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "hooke/base/expected.h"

namespace hooke {

/// An OpenGL 3.3 core context without a window, current on the thread that made it until it is destroyed there. Takes
/// Mesa's surfaceless platform (a software driver will do), else the first device, else the default display.
class EglContext {
 public:
  /// bad_input with what is missing: no libEGL, no display, no OpenGL 3.3.
  static Expected<EglContext> create();

  ~EglContext();
  EglContext(EglContext&&) noexcept;
  EglContext& operator=(EglContext&&) noexcept;

  const std::string& device() const;  ///< GL_RENDERER

 private:
  struct Impl;
  explicit EglContext(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace hooke
