// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/passes/cloth_triangles.h"

#include <algorithm>

namespace hooke {

void ClothTriangles::bind(const Structure& structure, const IdTable& ids) {
  clear();
  for (const Surface& surface : structure.surfaces) {
    for (std::size_t t = 0; t < surface.triangles.size(); t += 3) {
      Triangle triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.id_index[k] = static_cast<std::uint32_t>(ids.find(surface.particles[surface.triangles[t + k]]));
      }
      const auto& [a, b, c] = triangle.id_index;
      if (std::max({a, b, c}) < ids.size()) all_.push_back(triangle);
    }
  }
  first_.assign(ids.size() + 1, 0);
  for (const Triangle& triangle : all_) {
    for (const std::uint32_t id_index : triangle.id_index) ++first_[id_index + 1];
  }
  for (std::size_t id_index = 0; id_index < ids.size(); ++id_index) first_[id_index + 1] += first_[id_index];
  own_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t t = 0; t < all_.size(); ++t) {
    for (const std::uint32_t id_index : all_[t].id_index) own_[next[id_index]++] = static_cast<std::uint32_t>(t);
  }
}

}  // namespace hooke
