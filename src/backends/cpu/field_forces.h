// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hooke/base/huge_pages.h"
#include "hooke/core/placed_fields.h"
#include "hooke/core/scene.h"
#include "hooke/neighbours/layout.h"
#include "hooke/passes/cloth_triangles.h"
#include "hooke/passes/id_table.h"
#include "hooke/passes/particle_record.h"

namespace hooke {

/// The fields of a scene for the CPU back end. Wind on cloths takes two passes: the force on each triangle, then the
/// sum over each particle's triangles, in their order.
template <class Real>
class FieldForces {
  using Record = ParticleRecord<Real>;

 public:
  void configure(const Scene& scene);

  bool empty() const { return scene_.fields.empty(); }
  /// Whether apply() reads `slot_of`.
  bool needs_places() const { return !triangles_.empty(); }

  /// Finds the triangles whose three corners are particles of these ids; the others are left out.
  void bind(const IdTable& ids);

  /// There are more ids now, with id indices below `id_indices`; the new ones belong to no triangle.
  void grow(std::size_t id_indices) { triangles_.grow(id_indices); }

  /// visit(id index) for all corners of the triangles that a particle is a corner of.
  template <class Visit>
  void for_each_corner(std::uint32_t id_index, const Visit& visit) const {
    if (triangles_.empty()) return;
    for (std::uint32_t k = triangles_.first()[id_index]; k < triangles_.first()[id_index + 1]; ++k) {
      for (const std::uint32_t corner : triangles_.all()[triangles_.own()[k]].id_index) visit(corner);
    }
  }

  void set_time(double seconds) { time_ = seconds; }

  /// Sums the forces on the first `count` records; `slot_of` is the slot of each id index (needs_places()).
  void apply(const LargeVector<Record>& records, std::size_t count, const std::vector<std::uint32_t>& slot_of);

  /// N, in the order of the records; one for each record, unused records included.
  const Vec3<Real>* forces() const { return force_.data(); }

 private:
  void apply_to_triangles(const PlacedField<Real>& field, const LargeVector<Record>& records,
                          const std::vector<std::uint32_t>& slot_of);

  Scene scene_;  // the parts that fields need
  Vec3<Real> period_{};  // m
  bool blows_on_sheets_ = false;
  double time_ = 0;                       // s
  ClothTriangles triangles_;  // where wind blows on them
  LargeVector<Vec3<Real>> on_triangle_;   // N on each corner, by one field
  LargeVector<Vec3<Real>> force_;         // N
};

extern template class FieldForces<float>;
extern template class FieldForces<double>;

}  // namespace hooke
