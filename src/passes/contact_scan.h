// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "hooke/core/contact_walk.h"
#include "hooke/core/rules.h"
#include "hooke/neighbours/layout.h"
#include "hooke/passes/force_pass.h"

namespace hooke {

/// Walks the contacts of single particles in double precision: for measurements, and to check what the force pass
/// noted. Not on the hot path.
template <class Real>
class ContactScan {
 public:
  /// `rules` and the data of `colliders` must outlive the scan.
  ContactScan(const Rules<Real>& rules, const CollidersView<Real>& colliders, const ParticleRecord<Real>* records)
      : rules_(rules),
        colliders_(colliders),
        records_(records) {
    const RulesView<Real>& view = rules.view();
    walls_.min = vec_cast<double>(view.min);
    walls_.max = vec_cast<double>(view.max);
    images_.period = vec_cast<double>(view.period);
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      walls_.across[a] = view.wall[axis];
      images_.most[a] = view.periodic_kind == PeriodicKind::images ? view.images[axis] : 0;
    }
  }

  /// visit(p, normal, overlap) for every neighbour p that acts on particle i, in order of id and image: it touches i,
  /// overlap > 0, or cohesion reaches across the gap. `rows` are the rows of i's slice in the neighbour list.
  template <class Visit>
  void for_each_contact(std::size_t i, std::span<const std::uint32_t> rows, const Visit& visit) const {
    for (std::size_t at = i % kSliceLanes; at < rows.size(); at += kSliceLanes) {
      const std::size_t p = rows[at] / record_offset<Real>(1);
      if (is_vacant(records_[p])) continue;
      const PairRow<Real>& row = pair(i, p);
      for_each_image(vec_cast<double>(records_[i].x), vec_cast<double>(records_[p].x), images_,
                     [&](const ImageIndex& image, const Vec3d& x_ip) {
                       if (i == p && image == ImageIndex{}) return;
                       const auto [overlap, normal] = pair_geometry(
                           x_ip, row.contact_distance, records_[i].id_index > records_[p].id_index ? 1.0 : -1.0);
                       if (overlap > -static_cast<double>(row.range)) visit(p, normal, overlap);
                     });
    }
  }

  /// visit(normal, overlap) for every wall that acts on particle i.
  template <class Visit>
  void for_each_wall(std::size_t i, const Visit& visit) const {
    hooke::for_each_wall(walls_, vec_cast<double>(records_[i].x), wall(i).contact_distance, wall(i).range,
                         [&](int, const Vec3d& normal, double overlap) { visit(normal, overlap); });
  }

  /// visit(index, collider, face, overlap) for every face of a collider that acts on particle i, in the scene's order;
  /// `index` is the collider's in the scene.
  template <class Visit>
  void for_each_collider(std::size_t i, const Visit& visit) const {
    const Vec3d x = vec_cast<double>(records_[i].x);
    for (std::size_t c = 0; c < colliders_.count; ++c) {
      const PlacedCollider<Real>& collider = colliders_.placed[c];
      if (!collider.near.contains(records_[i].x)) continue;
      const std::size_t index = colliders_.index[c];
      const PairRow<Real>& row = this->collider(i, index);
      for_each_collider_face(collider, x, [&](const ColliderFace<double>& face) {
        const double overlap = static_cast<double>(row.contact_distance) - face.distance;
        if (overlap > -static_cast<double>(row.range)) visit(index, collider, face, overlap);
      });
    }
  }

  std::size_t material_of(std::size_t i) const { return static_cast<std::size_t>(records_[i].material); }
  const PairRow<Real>& pair(std::size_t i, std::size_t p) const { return rules_.pair(material_of(i), material_of(p)); }
  const PairRow<Real>& wall(std::size_t i) const { return rules_.wall(material_of(i)); }
  const PairRow<Real>& collider(std::size_t i, std::size_t c) const { return rules_.collider(material_of(i), c); }

 private:
  const Rules<Real>& rules_;
  CollidersView<Real> colliders_;
  const ParticleRecord<Real>* records_;
  PeriodicImages images_;
  Walls walls_;
};

}  // namespace hooke
