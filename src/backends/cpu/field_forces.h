// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hooke/backends/cpu/id_table.h"
#include "hooke/backends/cpu/particle_record.h"
#include "hooke/base/huge_pages.h"
#include "hooke/base/parallel.h"
#include "hooke/core/placed_fields.h"
#include "hooke/core/scene.h"
#include "hooke/physics/periodic.h"

namespace hooke {

/// The fields of a scene for the CPU back end. Wind on cloths takes two passes: what each triangle feels, then what
/// each particle gets from its triangles, in their order.
template <class Real>
class FieldForces {
  using Record = ParticleRecord<Real>;
  static constexpr std::size_t kRange = 1024;

 public:
  void configure(const Scene& scene) {
    scene_.materials = scene.materials;
    scene_.fields = scene.fields;
    scene_.structure = scene.structure;
    period_ = vec_cast<Real>(scene.domain.period());
    blows_on_sheets_ = false;
    for (const PlacedField<Real>& field : place_fields<Real>(scene_, 0)) {
      blows_on_sheets_ = blows_on_sheets_ || field.blows_on_sheets();
    }
  }

  bool empty() const { return scene_.fields.empty(); }
  /// Whether apply() asks where particles are by their rank.
  bool needs_places() const { return !triangles_.empty(); }

  /// Finds the triangles that the particles of these ids span; those that lack a corner are none.
  void bind(const IdTable& ids) {
    triangles_.clear();
    if (!blows_on_sheets_ || !scene_.structure) return;
    for (const Surface& surface : scene_.structure->surfaces) {
      for (std::size_t t = 0; t < surface.triangles.size(); t += 3) {
        Triangle ranks;
        for (std::size_t k = 0; k < 3; ++k) {
          ranks[k] = static_cast<std::uint32_t>(ids.find(surface.particles[surface.triangles[t + k]]));
        }
        if (std::max({ranks[0], ranks[1], ranks[2]}) < ids.size()) triangles_.push_back(ranks);
      }
    }
    on_triangle_.resize(triangles_.size());
    first_.assign(ids.size() + 1, 0);
    for (const Triangle& ranks : triangles_) {
      for (const std::uint32_t rank : ranks) ++first_[rank + 1];
    }
    for (std::size_t rank = 0; rank < ids.size(); ++rank) first_[rank + 1] += first_[rank];
    own_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (const std::uint32_t rank : triangles_[t]) own_[next[rank]++] = static_cast<std::uint32_t>(t);
    }
  }

  void set_time(double seconds) { time_ = seconds; }

  /// Sums the forces on the first `count` records; `place` tells where each rank is (needs_places()).
  void apply(const LargeVector<Record>& records, std::size_t count, const std::vector<std::uint32_t>& place) {
    force_.resize(records.size());
    bool none_yet = true;
    for (const PlacedField<Real>& field : place_fields<Real>(scene_, time_)) {
      const bool on_sheets = field.blows_on_sheets() && !triangles_.empty();
      if (on_sheets) apply_to_triangles(field, records, place);
      parallel_ranges(count, kRange, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          const Record& p = records[i];
          if (none_yet) force_[i] = {Real(0), Real(0), Real(0)};
          if (is_nowhere(p)) continue;
          const auto material = static_cast<std::size_t>(p.material);
          if (field.acts_on(material, p.x)) force_[i] += field.force(material, p.x, p.v);
          if (!on_sheets) continue;
          const std::uint32_t rank = rank_of(p.rank);
          for (std::uint32_t k = first_[rank]; k < first_[rank + 1]; ++k) force_[i] += on_triangle_[own_[k]];
        }
      });
      none_yet = false;
    }
  }

  /// N, in the order of the records; as many as there are, those in no use included.
  const Vec3<Real>* forces() const { return force_.data(); }

 private:
  using Triangle = std::array<std::uint32_t, 3>;  // ranks

  void apply_to_triangles(const PlacedField<Real>& field, const LargeVector<Record>& records,
                          const std::vector<std::uint32_t>& place) {
    constexpr Real kThird = Real(1.0 / 3);
    parallel_ranges(triangles_.size(), kRange, [&](std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t) {
        on_triangle_[t] = {Real(0), Real(0), Real(0)};
        const Record* corner[3];
        bool whole = true;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t at = place[triangles_[t][k]];
          whole = whole && at < records.size() && !is_nowhere(records[at]);
          corner[k] = &records[whole ? at : 0];
        }
        if (!whole) continue;
        const Vec3<Real> edge_1 = nearest_displacement(corner[1]->x, corner[0]->x, period_);
        const Vec3<Real> edge_2 = nearest_displacement(corner[2]->x, corner[0]->x, period_);
        const Vec3<Real> middle = corner[0]->x + kThird * (edge_1 + edge_2);
        if (!field.acts_on(static_cast<std::size_t>(corner[0]->material), middle)) continue;
        const Vec3<Real> v = kThird * ((corner[0]->v + corner[1]->v) + corner[2]->v);
        on_triangle_[t] = field.force_on_corner(middle, edge_1, edge_2, v);
      }
    });
  }

  Scene scene_;  // what fields go by
  Vec3<Real> period_{};  // m
  bool blows_on_sheets_ = false;
  double time_ = 0;                       // s
  std::vector<Triangle> triangles_;       // of cloths, where wind blows on them
  LargeVector<std::uint32_t> own_;        // triangles of rank r: own_[first_[r]] to own_[first_[r + 1] - 1]
  std::vector<std::uint32_t> first_;
  LargeVector<Vec3<Real>> on_triangle_;   // N on each corner, of one field
  LargeVector<Vec3<Real>> force_;         // N
};

}  // namespace hooke
