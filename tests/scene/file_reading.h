// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "hooke/scene/particle_file.h"
#include "scratch_folder.h"

namespace hooke {

/// Reads texts as files of particles, for a scene with water and "salt water" of radius 0.5 and mass 2.
class FileReading : public testing::Test {
 protected:
  scene::FileParticles read(const std::string& name, std::string_view text) {
    findings_ = scene::Findings("scene.json");
    warnings_.clear();
    return scene::read_particle_file(folder_.write(name, text), name, rules_, findings_, warnings_);
  }
  /// The errors of the file that was read last, a finding a line.
  std::string complaints() { return Error{Error::Kind::bad_input, findings_.take()}.text(); }
  std::string warnings() const { return Error{Error::Kind::bad_input, warnings_}.text(); }
  /// The errors of this file.
  std::string refusal(const std::string& name, std::string_view text) {
    read(name, text);
    return complaints();
  }

  /// Reads every beginning of a valid file of `count` particles, and the file with each byte changed. The result is
  /// findings or all particles, and never a value that is not allowed in a file.
  void damage(const std::string& name, const std::string& text, std::size_t count) {
    const auto check = [&](const scene::FileParticles& p, bool complete) {
      if (complete && findings_.empty()) {
        EXPECT_EQ(p.position.size(), count);
      }
      ASSERT_EQ(p.material.size(), p.position.size());
      ASSERT_EQ(p.velocity.size(), p.position.size());
      for (std::size_t i = 0; i < p.position.size(); ++i) {
        ASSERT_LT(p.material[i], materials_.size());
        for (const Vec3d& v : {p.position[i], p.velocity[i]}) {
          ASSERT_TRUE(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
        }
      }
    };
    for (std::size_t length = 0; length < text.size(); ++length) {
      SCOPED_TRACE("the first " + std::to_string(length) + " bytes");
      check(read(name, std::string_view(text).substr(0, length)), true);
    }
    for (std::size_t i = 0; i < text.size(); ++i) {
      for (const int flipped : {0x01, 0x10, 0x80, 0xff}) {
        SCOPED_TRACE("byte " + std::to_string(i) + " changed by " + std::to_string(flipped));
        std::string other = text;
        other[i] = static_cast<char>(other[i] ^ flipped);
        check(read(name, other), false);
      }
    }
  }

  ScratchFolder folder_;
  std::vector<Material> materials_{{"water", 0.5, 2, {}, 0, ""}, {"salt water", 0.5, 2, {}, 0, ""}};
  scene::ParticleFileRules rules_{materials_, {}, {7, 8, 9}, {}, {}};
  scene::Findings findings_{"scene.json"};
  std::vector<Finding> warnings_;
};

}  // namespace hooke
