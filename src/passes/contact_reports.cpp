// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/passes/contact_reports.h"

#include <algorithm>

namespace hooke {

template <class Real>
Condition contact_too_fast(const ContactScan<Real>& scan, std::size_t i, std::span<const std::uint32_t> rows,
                           const ParticleRecord<Real>* records, const Scene& scene, const IdTable& ids, bool moved) {
  const auto radius_of = [&](std::size_t k) { return scene.materials[scan.material_of(k)].radius; };
  const auto id_of = [&](std::size_t k) { return ids[id_index_of(records[k].id_index)]; };
  const double dt = scene.time_step, radius = radius_of(i);
  const Vec3d x = vec_cast<double>(records[i].x), v = vec_cast<double>(records[i].v);
  Condition found;
  // look(kind, partner, overlap, approach speed, smaller radius, whether they have passed through each other)
  const auto look = [&](Condition::Kind kind, std::uint64_t partner, double overlap, double approach, double smaller,
                        const auto& passed) {
    if (overlap > 0 && (approaches_too_fast(approach * dt, smaller) || (moved && passed())))
      found = Condition::first(found, {kind, id_of(i), partner, approach});
  };
  scan.for_each_contact(i, rows, [&](std::size_t p, const Vec3d& normal, double overlap) {
    const double approach = dot(vec_cast<double>(records[p].v) - v, normal);
    const double smaller = std::min(radius, radius_of(p)), distance = radius + radius_of(p) - overlap;
    look(Condition::Kind::pair_too_fast, id_of(p), overlap, approach, smaller,
         [&] { return passed_through(approach * dt, smaller, distance); });
  });
  scan.for_each_wall(i, [&](const Vec3d& normal, double overlap) {
    look(Condition::Kind::wall_too_fast, 0, overlap, dot(-v, normal), radius, [] { return false; });
  });
  scan.for_each_collider(
      i, [&](std::size_t c, const PlacedCollider<Real>& collider, const ColliderFace<double>& face, double overlap) {
        const Vec3d w = face.velocity - v;
        look(Condition::Kind::collider_too_fast, c, overlap, dot(w, face.normal), radius,
             [&] { return passed_through(collider, face, x, -dt * w, radius); });
      });
  return found;
}

template <class Real>
void measure_particle(const ContactScan<Real>& scan, std::size_t i, std::span<const std::uint32_t> rows,
                      const ParticleRecord<Real>& p, const Scene& scene, MeasurementSums& sums) {
  const Vec3d v = vec_cast<double>(p.v);
  sums.add_particle(scene.materials[scan.material_of(i)].mass, vec_cast<double>(p.x), v, scene.gravity);
  scan.for_each_contact(i, rows, [&](std::size_t q, const Vec3d&, double overlap) {
    sums.add_contact_side(law_of(scan.pair(i, q)), overlap, scan.pair(i, q).contact_distance);
  });
  scan.for_each_wall(i, [&](const Vec3d& normal, double overlap) {
    const ContactLaw<double> law = law_of(scan.wall(i));
    sums.add_wall_contact(law, overlap, scan.wall(i).contact_distance, contact_force(overlap, normal, -v, law));
  });
  scan.for_each_collider(i, [&](std::size_t c, const auto&, const ColliderFace<double>& face, double overlap) {
    const ContactLaw<double> law = law_of(scan.collider(i, c));
    const Vec3d force = contact_force(overlap, face.normal, face.velocity - v, law);
    sums.add_collider_contact(c, face.point, law, overlap, scan.collider(i, c).contact_distance, force);
  });
}

template <class Real>
void add_contact_energy(const ContactScan<Real>& scan, std::size_t i, std::span<const std::uint32_t> rows,
                        std::span<const std::uint32_t> among, ExactSum& sum) {
  scan.for_each_contact(i, rows, [&](std::size_t p, const Vec3d&, double overlap) {
    const bool both = std::binary_search(among.begin(), among.end(), p);
    sum.add((both ? 0.5 : 1.0) * contact_energy(overlap, law_of(scan.pair(i, p))));
  });
}

template Condition contact_too_fast(const ContactScan<float>& scan, std::size_t i, std::span<const std::uint32_t> rows,
                                    const ParticleRecord<float>* records, const Scene& scene, const IdTable& ids,
                                    bool moved);
template Condition contact_too_fast(const ContactScan<double>& scan, std::size_t i, std::span<const std::uint32_t> rows,
                                    const ParticleRecord<double>* records, const Scene& scene, const IdTable& ids,
                                    bool moved);
template void measure_particle(const ContactScan<float>& scan, std::size_t i, std::span<const std::uint32_t> rows,
                               const ParticleRecord<float>& p, const Scene& scene, MeasurementSums& sums);
template void measure_particle(const ContactScan<double>& scan, std::size_t i, std::span<const std::uint32_t> rows,
                               const ParticleRecord<double>& p, const Scene& scene, MeasurementSums& sums);
template void add_contact_energy(const ContactScan<float>& scan, std::size_t i, std::span<const std::uint32_t> rows,
                                 std::span<const std::uint32_t> among, ExactSum& sum);
template void add_contact_energy(const ContactScan<double>& scan, std::size_t i, std::span<const std::uint32_t> rows,
                                 std::span<const std::uint32_t> among, ExactSum& sum);

}  // namespace hooke
