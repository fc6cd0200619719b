// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/field_forces.h"

#include <algorithm>

#include "hooke/base/parallel.h"
#include "hooke/passes/cloth_force.h"

namespace hooke {

template <class Real>
void FieldForces<Real>::configure(const Scene& scene) {
  scene_.materials = scene.materials;
  scene_.fields = scene.fields;
  scene_.structure = scene.structure;
  period_ = vec_cast<Real>(scene.domain.period());
  blows_on_sheets_ = false;
  for (const PlacedField<Real>& field : place_fields<Real>(scene_, 0)) {
    blows_on_sheets_ = blows_on_sheets_ || field.blows_on_sheets();
  }
}

template <class Real>
void FieldForces<Real>::bind(const IdTable& ids) {
  triangles_.clear();
  if (!blows_on_sheets_ || !scene_.structure) return;
  triangles_.bind(*scene_.structure, ids);
  on_triangle_.resize(triangles_.all().size());
}

template <class Real>
void FieldForces<Real>::apply(const LargeVector<Record>& records, std::size_t count,
                              const std::vector<std::uint32_t>& slot_of) {
  force_.resize(records.size());
  bool none_yet = true;
  for (const PlacedField<Real>& field : place_fields<Real>(scene_, time_)) {
    const bool on_sheets = field.blows_on_sheets() && !triangles_.empty();
    if (on_sheets) apply_to_triangles(field, records, slot_of);
    parallel_ranges(count, kTile, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const Record& p = records[i];
        if (none_yet) force_[i] = {Real(0), Real(0), Real(0)};
        if (is_vacant(p)) continue;
        const auto material = static_cast<std::size_t>(p.material);
        if (field.acts_on(material, p.x)) force_[i] += field.force(material, p.x, p.v);
        if (!on_sheets) continue;
        const std::uint32_t id_index = id_index_of(p.id_index);
        for (std::uint32_t k = triangles_.first()[id_index]; k < triangles_.first()[id_index + 1]; ++k)
          force_[i] += on_triangle_[triangles_.own()[k]];
      }
    });
    none_yet = false;
  }
}

template <class Real>
void FieldForces<Real>::apply_to_triangles(const PlacedField<Real>& field, const LargeVector<Record>& records,
                                           const std::vector<std::uint32_t>& slot_of) {
  parallel_ranges(triangles_.all().size(), kTile, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      on_triangle_[t] = {Real(0), Real(0), Real(0)};
      const Record* corner[3];
      bool whole = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t at = slot_of[triangles_.all()[t].id_index[k]];
        whole = whole && at < records.size() && !is_vacant(records[at]);
        corner[k] = &records[whole ? at : 0];
      }
      if (!whole) continue;
      on_triangle_[t] = force_on_corner(field, period_, *corner[0], *corner[1], *corner[2]);
    }
  });
}

template class FieldForces<float>;
template class FieldForces<double>;

}  // namespace hooke
