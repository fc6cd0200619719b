// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <span>

#include "hooke/backends/cpu/force_pass.h"
#include "hooke/neighbours/neighbour_list.h"
#include "hooke/physics/contact.h"
#include "hooke/physics/periodic.h"
#include "hooke/physics/wall.h"

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
  ContactScan(const ForcePass<Real>& pass, const ParticleRecord<Real>* records) : pass_(pass), records_(records) {}

  /// visit(p, normal, overlap) for every neighbour p that acts on particle i, by id and image: those touch it, overlap
  /// > 0, or cohesion reaches from one to the other. `rows` are those of its group in the neighbour list.
  template <class Visit>
  void for_each_contact(std::size_t i, std::span<const std::uint32_t> rows, const Visit& visit) const {
    constexpr std::size_t kLanes = NeighbourList::kLanes;
    for (std::size_t at = i % kLanes; at < rows.size(); at += kLanes) {
      const std::size_t p = rows[at] / record_offset<Real>(1);
      if (!is_nowhere(records_[p])) visit_images(i, p, visit);
    }
  }

  /// visit(normal, overlap) for every wall that acts on particle i.
  template <class Visit>
  void for_each_wall(std::size_t i, const Visit& visit) const {
    const double radius = wall(i).reach, range = wall(i).range;
    for (int axis = 0; axis < 3; ++axis) {
      if (!pass_.wall[axis]) continue;
      const double x = component(records_[i].x, axis);
      const double lower = lower_wall_overlap<double>(x, component(pass_.min, axis), radius);
      const double upper = upper_wall_overlap<double>(x, component(pass_.max, axis), radius);
      if (lower > -range) visit(wall_normal(axis, 1.0), lower);
      if (upper > -range) visit(wall_normal(axis, -1.0), upper);
    }
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

  template <class Visit>
  void visit_images(std::size_t i, std::size_t p, const Visit& visit) const {
    int from[3] = {0, 0, 0};
    int to[3] = {0, 0, 0};
    for (int axis = 0; axis < 3; ++axis) {
      if (!pass_.periodic[axis]) continue;
      if (pass_.periodic_kind == PeriodicKind::images) {
        from[axis] = -pass_.images[axis];
        to[axis] = pass_.images[axis];
      } else {
        from[axis] = to[axis] = static_cast<int>(nearest_image(
            component(records_[i].x, axis), component(records_[p].x, axis), component(pass_.length, axis)));
      }
    }
    for (int sx = from[0]; sx <= to[0]; ++sx) {
      for (int sy = from[1]; sy <= to[1]; ++sy) {
        for (int sz = from[2]; sz <= to[2]; ++sz) {
          if (i != p || sx != 0 || sy != 0 || sz != 0) visit_image(i, p, {double(sx), double(sy), double(sz)}, visit);
        }
      }
    }
  }

  template <class Visit>
  void visit_image(std::size_t i, std::size_t p, const Vec3d& s, const Visit& visit) const {
    const Vec3d x_i = vec_cast<double>(records_[i].x);
    const Vec3d x_p = vec_cast<double>(records_[p].x);
    const Vec3d length = vec_cast<double>(pass_.length);
    const Vec3d x_ip{image_displacement(x_i.x, x_p.x, s.x, length.x), image_displacement(x_i.y, x_p.y, s.y, length.y),
                     image_displacement(x_i.z, x_p.z, s.z, length.z)};
    const double distance = std::sqrt(dot(x_ip, x_ip));
    const double overlap = static_cast<double>(pair(i, p).reach) - distance;
    if (overlap > -static_cast<double>(pair(i, p).range))
      visit(p, contact_normal(x_ip, distance, records_[i].rank > records_[p].rank ? 1.0 : -1.0), overlap);
  }

  const ForcePass<Real>& pass_;
  const ParticleRecord<Real>* records_;
};

}  // namespace hooke
