// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "hooke/volumes/openvdb_support.h"

/// Skips the test in a build without OpenVDB.
#define HOOKE_NEEDS_OPENVDB() \
  if (!hooke::volumes::has_openvdb()) GTEST_SKIP() << "needs OpenVDB, which is not in this build"

namespace hooke::test {

/// Whether a scene file has a mesh as a shape.
inline bool has_mesh(const std::filesystem::path& scene) {
  std::ifstream in(scene);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return text.find("\"mesh\": {") != std::string::npos;
}

}  // namespace hooke::test
