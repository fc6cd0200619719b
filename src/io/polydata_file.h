// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/base/vec3.h"
#include "hooke/io/export_format.h"

namespace hooke::io {

/// A .vtp file of VTK: points with data, and cells with data, either all vertices or all lines. Arrays are base64
/// within the XML: with a recent Expat, ParaView up to 5.12.0 (VTK 9.3.0) can't read data appended after it.
class PolyDataFile {
 public:
  enum class Cells { vertices, lines };

  /// Cell by cell, the points are used in order: one for a vertex, two for a line.
  PolyDataFile(Cells cells, std::size_t point_count, double time);

  /// `values` has `components` numbers per point or cell; a vector of the points becomes the default input of VTK's
  /// filters. T: float, double, std::int64_t, std::uint16_t, std::uint8_t.
  template <class T>
  void add_point_data(const char* name, const std::vector<T>& values, int components = 1) {
    HOOKE_ASSERT(values.size() == point_count_ * static_cast<std::size_t>(components), name, values.size(),
                 point_count_, components);
    point_data_ += array(name, values, components);
    if (components == 3) vectors_ = name;
  }
  template <class T>
  void add_cell_data(const char* name, const std::vector<T>& values, int components = 1) {
    const std::size_t cell_count = point_count_ / (cells_ == Cells::lines ? 2 : 1);
    HOOKE_ASSERT(values.size() == cell_count * static_cast<std::size_t>(components), name, values.size(), cell_count,
                 components);
    cell_data_ += array(name, values, components);
  }
  /// Three numbers per point, m, float or double. To be called before write().
  template <class T>
  void set_points(const std::vector<T>& values) {
    HOOKE_ASSERT(values.size() == 3 * point_count_, values.size(), point_count_);
    points_ = array("Points", values, 3);
  }

  void write(const std::filesystem::path& file);

 private:
  template <class T>
  static std::string array(const char* name, const std::vector<T>& values, int components);

  Cells cells_;
  std::size_t point_count_;
  double time_;
  std::string point_data_, cell_data_, points_;  // XML
  std::string vectors_;  // name of the points' vector array
};

/// The components of all vectors in one list.
template <class Real>
std::vector<Real> flatten(const std::vector<Vec3d>& vectors) {
  std::vector<Real> values;
  values.reserve(3 * vectors.size());
  for (const Vec3d& v : vectors) {
    for (const double c : {v.x, v.y, v.z}) values.push_back(static_cast<Real>(c));
  }
  return values;
}

/// Calls write(index, file) for each snapshot of the job. A job of one snapshot writes that .vtp file; a longer one
/// writes a .vtp per snapshot and a .pvd that lists them, which is the first file returned.
std::vector<std::filesystem::path> export_polydata(
    const ExportJob& job, const std::function<void(std::size_t, const std::filesystem::path&)>& write);

}  // namespace hooke::io
