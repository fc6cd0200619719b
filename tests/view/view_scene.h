// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "session.h"
#include "timeline.h"

namespace hooke::test {

/// A folder of its own with a scene in it: balls of two materials in a tank, a collider, and a small cloth.
class ViewTest : public testing::Test {
 protected:
  ViewTest();
  ~ViewTest() override;

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  /// Of scene.json, at rest, stepped by `threads`.
  view::SessionOptions options(int threads = 2) const;

 private:
  std::filesystem::path folder_;
};

/// The text of scene.json.
std::string small_view_scene();

}  // namespace hooke::test
