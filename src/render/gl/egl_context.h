// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "hooke/base/expected.h"

namespace hooke::render {

/// An OpenGL 3.3 core context without a window, for the thread that makes it. Takes the first of EGL's devices that
/// works, else Mesa's surfaceless platform (a software driver will do), else the default display.
class EglContext {
 public:
  /// bad_input with what is missing: no libEGL, no display, no OpenGL 3.3.
  static Expected<EglContext> create();

  ~EglContext();
  EglContext(EglContext&&) noexcept;
  EglContext& operator=(EglContext&&) noexcept;

  /// OpenGL calls of this thread go to this context from now on; a thread may have several. create() does it too.
  void make_current() const;
  const std::string& device() const;  ///< GL_RENDERER

 private:
  struct Impl;
  explicit EglContext(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace hooke::render
