// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "program.h"
#include "support/bundled_scenes.h"
#include "support/openvdb.h"

namespace hooke::test {

/// A test of a scene that comes with Hooke; the parameter is its name.
class BundledScene : public ProgramTest, public testing::WithParamInterface<std::string> {
 protected:
  void SetUp() override {
    if (has_mesh(file())) HOOKE_NEEDS_OPENVDB();
  }
  std::string file() const { return (bundled_folder() / (GetParam() + ".json")).string(); }
};

}  // namespace hooke::test
