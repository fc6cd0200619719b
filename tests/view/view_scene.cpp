// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "view_scene.h"

#include <unistd.h>

#include <fstream>
#include <sstream>

namespace hooke::test {

std::string small_view_scene() {
  return R"({
  "hooke": 1, "name": "small",
  "time": { "step": 0.001, "end": 1 },
  "domain": { "min": [0, 0, 0], "max": [2, 2, 2] },
  "materials": {
    "red":   { "radius": 0.05, "mass": 0.1, "stiffness": 500, "shear": 0.3, "damping": 1, "color": "#e4453a" },
    "blue":  { "radius": 0.07, "mass": 0.2, "stiffness": 500, "shear": 0.3, "damping": 1, "color": "#2f7fd6" },
    "linen": { "radius": 0.03, "mass": 0.01, "stiffness": 300, "damping": 0.1, "color": "#c9485b" } },
  "particles": [
    { "material": "red", "block": { "min": [0.1, 0.1, 0.1], "max": [1.9, 0.5, 1.9], "spacing": 0.12 } },
    { "material": "blue", "block": { "min": [0.2, 0.8, 0.2], "count": 20, "spacing": 0.2 } } ],
  "cloths": [
    { "material": "linen", "corner": [0.6, 1.4, 0.6], "edges": [[0.8, 0, 0], [0, 0, 0.8]], "cells": [8, 8],
      "stretch": 40, "shear": 10, "bend": 2, "damping": 0.02, "pins": ["edge:0"] } ],
  "colliders": [ { "name": "ball", "shape": { "sphere": { "center": [1, 0.9, 1.6], "radius": 0.2 } } } ],
  "output": { "every": 0.1 }
})";
}

ViewTest::ViewTest() {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  folder_ = std::filesystem::temp_directory_path() /
            ("hooke_view_" + std::to_string(getpid()) + "_" + std::string(test.name()));
  std::filesystem::create_directories(folder_);
  write("scene.json", small_view_scene());
}

ViewTest::~ViewTest() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void ViewTest::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
}

std::string ViewTest::read(const std::string& name) const {
  std::ostringstream text;
  text << std::ifstream(path(name), std::ios::binary).rdbuf();
  return text.str();
}

view::SessionOptions ViewTest::options(int threads) const {
  view::SessionOptions options;
  options.scene.file = path("scene.json");
  options.device.threads = threads;
  options.paused = true;
  return options;
}

}  // namespace hooke::test
