// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The springs of a pack of particles, row by row: compiled once for each instruction set like the force pass, and
// included after packs like it. What each lane computes is what ReferenceSprings spells out.

#include "hooke/passes/spring_pass.h"

#include "hooke/physics/contact.h"
#include "hooke/physics/periodic.h"
#include "hooke/physics/spring.h"

namespace hooke::HOOKE_ISA {

template <class Real>
HOOKE_HD void prefetch_partners(const SpringPass<Real>& pass, const SpringRow<Real>& row, std::size_t half) {
  for (std::size_t lane = 0; lane < Pack<Real>::kLanes; ++lane) {
    prefetch(reinterpret_cast<const char*>(pass.records) + std::size_t{row.partner[half + lane]} * 8);
  }
}

template <class Real, bool kPeriodic>
HOOKE_HD void run_spring_pack(const SpringPass<Real>& pass, const SpringWork<Real>& work, std::size_t slice,
                              std::size_t half, unsigned& torn) {
  using P = Pack<Real>;
  constexpr std::uint32_t kAhead = 6;  // rows
  const std::size_t slot = slice * kSliceLanes + half, first = work.first + slot;
  const char* base = reinterpret_cast<const char*>(pass.records);
  const auto own =
      load_two_quads(Real{}, [&](int lane) { return reinterpret_cast<const Real*>(pass.records + first + lane); });
  const P& x = own.first.a;
  const P& y = own.first.b;
  const P& z = own.first.c;
  const P nowhere(static_cast<Real>(kVacantPosition)), zero(Real(0));
  Vec3<P> force{zero, zero, zero};
  P power = zero;
  const std::uint32_t end = work.first_row[slice + 1], last = work.first_row[work.slice_count];
  for (std::uint32_t r = work.first_row[slice]; r < end; ++r) {
    SpringRow<Real>& row = work.rows[r];
    if (r + kAhead < last) prefetch_partners(pass, work.rows[r + kAhead], half);
    const auto other = load_two_quads(Real{}, [&](int lane) {
      return reinterpret_cast<const Real*>(base + std::size_t{row.partner[half + static_cast<std::size_t>(lane)]} * 8);
    });
    const Quad<Real> kind = load_quads(Real{}, [&](int lane) {
      return reinterpret_cast<const Real*>(pass.kinds + row.kind[half + static_cast<std::size_t>(lane)]);
    });
    Vec3<P> x_ip{x - other.first.a, y - other.first.b, z - other.first.c};
    if constexpr (kPeriodic) {
      const auto nearest = [&](const P& x_i, const P& x_p, bool periodic, Real length) {
        if (!periodic) return x_i - x_p;
        return image_displacement(x_i, x_p, nearest_image(x_i, x_p, P(length)), P(length));
      };
      x_ip = {nearest(x, other.first.a, pass.periodic[0], pass.length.x),
              nearest(y, other.first.b, pass.periodic[1], pass.length.y),
              nearest(z, other.first.c, pass.periodic[2], pass.length.z)};
    }
    const P distance = sqrt_of(dot(x_ip, x_ip)), rest_length = load(row.rest_length + half);
    const Vec3<P> normal =
        contact_normal(x_ip, distance, select(own.second.d > other.second.d, P(Real(1)), P(Real(-1))));
    const P extension = distance - rest_length;
    const Vec3<P> w{other.second.a - own.second.a, other.second.b - own.second.b, other.second.c - own.second.c};
    const Mask<Real> both = (x < nowhere) & (other.first.a < nowhere);
    const Mask<Real> acts = both & spring_acts(extension, kind.d);
    const SpringForce<P> f = spring_force(extension, normal, w, kind.a, kind.b);
    force = {add_where(acts, force.x, f.force.x), add_where(acts, force.y, f.force.y),
             add_where(acts, force.z, f.force.z)};
    power = add_where(acts, power, f.dissipation);
    if (!pass.may_tear) continue;
    const unsigned gone = bits(both & spring_tears(extension, rest_length, kind.c));
    if (gone == 0) continue;
    torn = 1;
    for (std::size_t lane = 0; lane < P::kLanes; ++lane) {
      if ((gone >> lane & 1U) != 0) row.kind[half + lane] = kTornSpring;
    }
  }
  store(work.power + slot, P(Real(0.5)) * power);
  for (std::size_t lane = 0; lane < P::kLanes; ++lane) {
    pass.force[first + lane] = {force.x.v[lane], force.y.v[lane], force.z.v[lane]};
  }
}

}  // namespace hooke::HOOKE_ISA
