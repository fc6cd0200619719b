// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "hooke/base/expected.h"

namespace hooke::run {

/// A shared library of Hooke's own, which is loaded when what it links is needed: OpenGL, CUDA. Never closed: a
/// driver's threads may still run in it.
class Module {
 public:
  /// Loads the file of this name, "hooke-gl.so", which lies in the folder of the program or library that this function
  /// is part of, or, where that folder is one of those that Hooke is installed in, below the same prefix. bad_input
  /// where the module or a library that it needs can't be loaded, or where it is of another version of Hooke, which
  /// its function `version` tells. `subject` and `needs` begin the message: "OpenGL", "pictures need it".
  static Expected<Module> load(const std::string& file, const char* version, const char* subject, const char* needs);

  /// A function of the module by its name; null where it has none.
  template <class Function>
  Function* function(const char* name) const {
    return reinterpret_cast<Function*>(find(name));
  }

 private:
  explicit Module(void* library) : library_(library) {}
  void* find(const char* name) const;

  void* library_;
};

}  // namespace hooke::run
