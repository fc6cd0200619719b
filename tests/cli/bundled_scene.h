// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "program.h"

namespace hooke::test {

/// A scene that comes with Hooke, by its name.
class BundledScene : public ProgramTest, public testing::WithParamInterface<std::string> {
 protected:
  static std::filesystem::path folder() { return HOOKE_SOURCE_DIR "/scenes"; }
  std::string file() const { return (folder() / (GetParam() + ".json")).string(); }

 public:
  /// Names, ascending, of the big siblings or of all others.
  static std::vector<std::string> names(bool big) {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder())) {
      const std::string name = entry.path().stem().string();
      if (entry.path().extension() == ".json" && name.ends_with("-big") == big) found.push_back(name);
    }
    std::sort(found.begin(), found.end());
    return found;
  }
  static std::string test_name(const testing::TestParamInfo<std::string>& instance) {
    std::string name = instance.param;
    std::replace_if(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
  }
};

}  // namespace hooke::test
