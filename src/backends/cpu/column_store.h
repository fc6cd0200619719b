// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "hooke/base/huge_pages.h"
#include "hooke/base/vec3.h"
#include "hooke/neighbours/window_search.h"

namespace hooke {

/// Vectors, one column per component, for searches that read packs.
template <class Real>
class ColumnStore {
 public:
  void resize(std::size_t count) {
    for (auto* column : {&x_, &y_, &z_}) column->resize(count);
  }
  void put(std::size_t i, const Vec3<Real>& value) {
    x_[i] = value.x;
    y_[i] = value.y;
    z_[i] = value.z;
  }
  Vec3<Real> operator[](std::size_t i) const { return {x_[i], y_[i], z_[i]}; }
  Vec3Columns<Real> columns() const { return {x_.data(), y_.data(), z_.data()}; }

 private:
  LargeVector<Real> x_, y_, z_;
};

}  // namespace hooke
