// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/gl/seen_spheres.h"

#include <algorithm>

namespace hooke::render {

void SeenSpheres::find(std::span<const Sphere> spheres, const Projection& from) {
  spheres_ = spheres;
  solid_.clear();
  water_.clear();
  const auto is_water = [](const Sphere& sphere) { return kind_of(sphere) == SphereKind::water; };
  const auto waters = static_cast<std::size_t>(std::count_if(spheres.begin(), spheres.end(), is_water));
  const bool mixed = waters > 0 && waters < spheres.size();
  for (const std::uint32_t i : visible_spheres(spheres, from)) {
    if (is_water(spheres[i])) {
      water_.push_back(i);
    } else if (!mixed) {
      solid_.push_back(i);
    }
  }
  if (!mixed) return;
  std::vector<Sphere> others;
  std::vector<std::uint32_t> index;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (is_water(spheres[i])) continue;
    others.push_back(spheres[i]);
    index.push_back(static_cast<std::uint32_t>(i));
  }
  for (const std::uint32_t k : visible_spheres(others, from)) solid_.push_back(index[k]);
}

void SeenSpheres::upload() {
  for (SphereBuffer& buffer : buffers_) buffer.clear();
  for (const std::vector<std::uint32_t>* chosen : {&solid_, &water_}) {
    for (const std::uint32_t i : *chosen) {
      buffers_[static_cast<std::size_t>(kind_of(spheres_[i]))].add(spheres_[i]);
    }
  }
  for (const SphereBuffer& buffer : buffers_) buffer.upload();
}

}  // namespace hooke::render
