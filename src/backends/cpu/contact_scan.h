// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "hooke/backends/cpu/force_pass.h"
#include "hooke/core/contact_walk.h"
#include "hooke/neighbours/neighbour_list.h"

namespace hooke {

/// A row's law.
template <class Real>
ContactLaw<double> law_of(const PairRow<Real>& row) {
  return {{row.stiffness, row.shear, row.damping}, {row.friction, row.tension, row.cohesion, row.range}};
}

/// Walks the contacts of single particles of a force pass in double precision: for figures, and to look closely at what
/// the pass noted. Not on the hot path.
template <class Real>
class ContactScan {
 public:
  ContactScan(const ForcePass<Real>& pass, const ParticleRecord<Real>* records) : pass_(pass), records_(records) {
    walls_.min = vec_cast<double>(pass.min);
    walls_.max = vec_cast<double>(pass.max);
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      walls_.across[a] = pass.wall[axis];
      if (!pass.periodic[axis]) continue;
      component(images_.period, axis) = component(pass.length, axis);
      images_.most[a] = pass.periodic_kind == PeriodicKind::images ? pass.images[axis] : 0;
    }
  }

  /// visit(p, normal, overlap) for every neighbour p that acts on particle i, by id and image: those touch it, overlap
  /// > 0, or cohesion reaches from one to the other. `rows` are those of its group in the neighbour list.
  template <class Visit>
  void for_each_contact(std::size_t i, std::span<const std::uint32_t> rows, const Visit& visit) const {
    constexpr std::size_t kLanes = NeighbourList::kLanes;
    for (std::size_t at = i % kLanes; at < rows.size(); at += kLanes) {
      const std::size_t p = rows[at] / record_offset<Real>(1);
      if (is_vacant(records_[p])) continue;
      const PairRow<Real>& row = pair(i, p);
      for_each_image(vec_cast<double>(records_[i].x), vec_cast<double>(records_[p].x), images_,
                     [&](const ImageIndex& image, const Vec3d& x_ip) {
                       if (i == p && image == ImageIndex{}) return;
                       const auto [overlap, normal] =
                           pair_geometry(x_ip, row.reach, records_[i].rank > records_[p].rank ? 1.0 : -1.0);
                       if (overlap > -static_cast<double>(row.range)) visit(p, normal, overlap);
                     });
    }
  }

  /// visit(normal, overlap) for every wall that acts on particle i.
  template <class Visit>
  void for_each_wall(std::size_t i, const Visit& visit) const {
    hooke::for_each_wall(walls_, vec_cast<double>(records_[i].x), wall(i).reach, wall(i).range,
                         [&](int, const Vec3d& normal, double overlap) { visit(normal, overlap); });
  }

  /// visit(collider, face, overlap) for every face of a collider that acts on particle i, in the scene's order.
  template <class Visit>
  void for_each_collider(std::size_t i, const Visit& visit) const {
    const Vec3d x = vec_cast<double>(records_[i].x);
    for (std::size_t c = 0; c < pass_.collider_count; ++c) {
      const PlacedCollider<Real>& collider = pass_.colliders[c];
      if (!is_between(records_[i].x, collider.near_from, collider.near_to)) continue;
      const std::size_t index = pass_.collider_of[c];
      const PairRow<Real>& row = this->collider(i, index);
      for_each_collider_face(collider, x, [&](const ColliderFace<double>& face) {
        const double overlap = static_cast<double>(row.reach) - face.distance;
        if (overlap > -static_cast<double>(row.range)) visit(index, face, overlap);
      });
    }
  }

  std::size_t material_of(std::size_t i) const { return static_cast<std::size_t>(records_[i].material); }
  const PairRow<Real>& pair(std::size_t i, std::size_t p) const {
    return pass_.pairs[material_of(i) * pass_.material_count + material_of(p)];
  }
  const PairRow<Real>& wall(std::size_t i) const { return pass_.wall_pairs[material_of(i)]; }
  const PairRow<Real>& collider(std::size_t i, std::size_t c) const {
    return pass_.collider_pairs[c * pass_.material_count + material_of(i)];
  }

 private:
  static bool is_between(const Vec3<Real>& x, const Vec3<Real>& from, const Vec3<Real>& to) {
    for (int axis = 0; axis < 3; ++axis) {
      const Real at = component(x, axis);
      if (!(at > component(from, axis) && at < component(to, axis))) return false;
    }
    return true;
  }

  const ForcePass<Real>& pass_;
  const ParticleRecord<Real>* records_;
  PeriodicImages images_;
  Walls walls_;
};

}  // namespace hooke
