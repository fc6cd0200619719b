// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hooke/base/huge_pages.h"
#include "hooke/core/springs.h"
#include "hooke/passes/id_table.h"

namespace hooke {

/// The triangles of a structure's cloths by the id indices of their corners, and the triangles of each particle.
class ClothTriangles {
 public:
  struct Triangle {
    std::uint32_t id_index[3];  ///< of its corners
  };

  void clear() {
    all_.clear();
    first_.clear();
    own_.clear();
  }
  /// Finds the triangles whose three corners are particles of these ids; the others are left out.
  void bind(const Structure& structure, const IdTable& ids);
  /// There are more id indices now; the new ones belong to no triangle.
  void grow(std::size_t id_indices) {
    if (!empty()) first_.resize(id_indices + 1, first_.back());
  }

  bool empty() const { return all_.empty(); }
  const std::vector<Triangle>& all() const { return all_; }
  /// Triangles own()[first()[r]] and on, to own()[first()[r + 1]], are of id index r, in their order.
  const std::vector<std::uint32_t>& first() const { return first_; }
  const LargeVector<std::uint32_t>& own() const { return own_; }

 private:
  std::vector<Triangle> all_;
  std::vector<std::uint32_t> first_;
  LargeVector<std::uint32_t> own_;
};

}  // namespace hooke
