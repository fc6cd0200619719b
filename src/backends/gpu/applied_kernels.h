// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "hooke/backends/gpu/list_kernels.h"
#include "hooke/backends/gpu/population_kernels.h"
#include "hooke/backends/gpu/step_kernels.h"
#include "hooke/core/attraction.h"
#include "hooke/core/placed_fields.h"
#include "hooke/passes/cloth_force.h"
#include "hooke/passes/cloth_triangles.h"
#include "hooke/passes/spring_pass.h"
#include "hooke/passes/spring_table.h"
#include "hooke/passes/work_sum.h"
#include "hooke/physics/attraction.h"
// After the packs.
#include "hooke/passes/spring_pass.inl"

namespace hooke::gpu {

// Forces beside those of the pass: springs, fields, attraction, the caller's, each a column by slot; what they do; and
// particles that are held.

/// A spring that tore, with the id indices of its ends.
struct TornSpring {
  std::uint32_t spring, a, b;
};

/// The springs of a scene, by id index: sides `first[i]` and on of id index i, in the order of their springs.
template <class Real>
struct SpringsView {
  const std::uint32_t* first = nullptr;
  const SpringSide* sides = nullptr;
  const std::uint32_t* kind = nullptr;  // by spring
  const Real* rest_length = nullptr;    // by spring, m
  std::uint8_t* broken = nullptr;       // by spring
};

/// Counts the rows of springs that each slice needs.
template <class Real>
struct CountSpringRows {
  const ParticleRecord<Real>* records;
  SpringsView<Real> springs;
  std::uint32_t* rows;  // by slice

  HOOKE_HD void operator()(std::uint32_t i) const {
    if (is_vacant(records[i])) return;
    const std::uint32_t id_index = id_index_of(records[i].id_index);
    raise_to(rows + i / kLanes, springs.first[id_index + 1] - springs.first[id_index]);
  }
};

/// Lays out each particle's springs in its lane. Items are all lanes of all slices.
template <class Real>
struct FillSpringRows {
  const ParticleRecord<Real>* records;
  SpringsView<Real> springs;
  const std::uint32_t* first_row;
  const std::uint32_t* slot_of_id_index;
  SpringRow<Real>* rows;
  std::uint32_t filler;  // entry of short lanes
  std::uint32_t end;     // slots in use

  HOOKE_HD void operator()(std::uint32_t i) const {
    const bool here = i < end && !is_vacant(records[i]);
    const std::uint32_t id_index = here ? id_index_of(records[i].id_index) : 0;
    const std::uint32_t to = here ? springs.first[id_index + 1] : 0;
    std::uint32_t k = here ? springs.first[id_index] : 0;
    const std::uint32_t g = i / kLanes, lane = i % kLanes;
    for (std::uint32_t r = first_row[g]; r < first_row[g + 1]; ++r, ++k) {
      SpringRow<Real>& row = rows[r];
      const bool ties = k < to && springs.broken[springs.sides[k].spring] == 0 &&
                        slot_of_id_index[springs.sides[k].partner] != kNoSlot;
      row.partner[lane] = ties ? record_offset<Real>(slot_of_id_index[springs.sides[k].partner]) : filler;
      row.kind[lane] = ties ? springs.kind[springs.sides[k].spring] : kNoSpring;
      row.rest_length[lane] = ties ? springs.rest_length[springs.sides[k].spring] : Real(1);
    }
  }
};

/// The springs of one particle, and what their dampers take out. Run on whole warps.
template <class Real>
struct PullBySprings {
  SpringPass<Real> pass;
  SpringRow<Real>* rows;
  const std::uint32_t* first_row;
  Real* power;  // W, by slot
  SumCopies<Real> sums;  // the dissipation comes first
  SumWindow window;
  SpringsView<Real> springs;
  DeviceReport* report;
  TornSpring* torn;

  HOOKE_HD void operator()(std::uint32_t i) const {
    const std::uint32_t g = i / kLanes, lane = i % kLanes;
    SpringWork<Real> work;
    work.rows = rows;
    work.first_row = first_row;
    work.power = power;
    unsigned has_torn = 0;
    if (pass.any_periodic) {
      run_spring_pack<Real, true>(pass, work, g, lane, has_torn);
    } else {
      run_spring_pack<Real, false>(pass, work, g, lane, has_torn);
    }
    if (has_torn != 0) finish_torn(i);
    add_term(*sums.of_item(i), window, power[i]);
  }

 private:
  // Removes the springs of particle i that tore. Both ends do so; the lower one counts the spring.
  HOOKE_HD void finish_torn(std::uint32_t i) const {
    const std::uint32_t g = i / kLanes, lane = i % kLanes, id_index = id_index_of(pass.records[i].id_index);
    for (std::uint32_t r = first_row[g]; r < first_row[g + 1]; ++r) {
      if (rows[r].kind[lane] != kTornSpring) continue;
      rows[r].kind[lane] = kNoSpring;
      const SpringSide side = springs.sides[springs.first[id_index] + (r - first_row[g])];
      if (side.partner < id_index) continue;
      springs.broken[side.spring] = 1;
      torn[add_to(&report->torn, 1)] = {side.spring, id_index, side.partner};
    }
  }
};

/// The force of one field on each corner of a triangle of cloth.
template <class Real>
struct BlowOnTriangles {
  FieldView<Real> field;
  const ParticleRecord<Real>* records;
  const std::uint32_t* slot_of_id_index;
  const ClothTriangles::Triangle* triangles;
  Vec3<Real> period;
  Vec3<Real>* force;  // N, by triangle

  HOOKE_HD void operator()(std::uint32_t t) const {
    force[t] = {Real(0), Real(0), Real(0)};
    ParticleRecord<Real> corner[3];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t slot = slot_of(records, slot_of_id_index, triangles[t].id_index[k]);
      if (slot == kNoSlot) return;
      corner[k] = records[slot];
    }
    force[t] = force_on_corner(field, period, corner[0], corner[1], corner[2]);
  }
};

/// The force of one field on each particle, added to those of the fields before.
template <class Real>
struct PushByField {
  FieldView<Real> field;
  const ParticleRecord<Real>* records;
  bool is_first;                            // of the fields
  const std::uint32_t* first_triangle;      // of each id index, and one more; null where the field blows on none
  const std::uint32_t* triangles;
  const Vec3<Real>* on_triangle;
  Vec3<Real>* force;  // N, by slot

  HOOKE_HD void operator()(std::uint32_t i) const {
    const ParticleRecord<Real> p = records[i];
    Vec3<Real> sum = is_first ? Vec3<Real>{Real(0), Real(0), Real(0)} : force[i];
    if (!is_vacant(p)) {
      const auto material = static_cast<std::size_t>(p.material);
      if (field.acts_on(material, p.x)) sum += field.force(material, p.x, p.v);
      if (first_triangle != nullptr) {
        const std::uint32_t id_index = id_index_of(p.id_index);
        for (std::uint32_t k = first_triangle[id_index]; k < first_triangle[id_index + 1]; ++k)
          sum += on_triangle[triangles[k]];
      }
    }
    force[i] = sum;
  }
};

/// A particle that pulls, in units of attraction.
template <class Real>
struct alignas(4 * sizeof(Real) > 16 ? 16 : 4 * sizeof(Real)) PullSource {
  Real x, y, z, mass;
};

/// Puts the particles that pull in order of their ids.
template <class Real>
struct GatherSources {
  const ParticleRecord<Real>* records;
  const std::uint32_t* slot_of_id_index;
  const std::uint32_t* rank;  // of each id index among those that have a particle, and one more
  const std::uint64_t* ids;
  const Real* mass;           // by material, in units
  Real inverse_length;        // units a metre
  PullSource<Real>* sources;
  std::uint64_t* block;  // of each source's id

  HOOKE_HD void operator()(std::uint32_t id_index) const {
    if (rank[id_index + 1] == rank[id_index]) return;
    const ParticleRecord<Real> p = records[slot_of_id_index[id_index]];
    const Vec3<Real> x = inverse_length * p.x;
    sources[rank[id_index]] = {x.x, x.y, x.z, mass[static_cast<std::size_t>(p.material)]};
    block[rank[id_index]] = ids[id_index] / kAttractionBlock;
  }
};

/// The pull of all particles on one, block by block of sources: the sum of a block starts from 0.
template <class Real, class Math>
struct PullDirectly {
  const ParticleRecord<Real>* records;
  const PullSource<Real>* sources;
  const std::uint64_t* block;
  std::uint32_t count;
  const Real* force_of;  // by material: N per unit
  Real inverse_length, softening2;
  Vec3<Real>* force;  // N, by slot

  HOOKE_HD void operator()(std::uint32_t i) const {
    using P = Pack<Real>;
    const ParticleRecord<Real> p = records[i];
    force[i] = {Real(0), Real(0), Real(0)};
    if (is_vacant(p)) return;
    const Vec3<Real> x = inverse_length * p.x;
    const Vec3<P> at{P(x.x), P(x.y), P(x.z)};
    const P zero(Real(0));
    Vec3<P> total{zero, zero, zero}, sum{zero, zero, zero};
    for (std::uint32_t s = 0; s < count; ++s) {
      if (s > 0 && block[s] != block[s - 1]) {
        total = total + sum;
        sum = {zero, zero, zero};
      }
      const PullSource<Real> source = sources[s];
      const Vec3<P> towards{P(source.x) - at.x, P(source.y) - at.y, P(source.z) - at.z};
      const P factor = attraction<Math>(towards, P(source.mass), P(softening2));
      sum = {Math::multiply_add(factor, towards.x, sum.x), Math::multiply_add(factor, towards.y, sum.y),
             Math::multiply_add(factor, towards.z, sum.z)};
    }
    total = total + sum;
    const Real scale = force_of[static_cast<std::size_t>(p.material)];
    force[i] = scale * Vec3<Real>{total.x.v.number, total.y.v.number, total.z.v.number};
  }
};

/// The potential of all particles at one, in units, likewise.
template <class Real>
struct PotentialDirectly {
  const ParticleRecord<Real>* records;
  const PullSource<Real>* sources;
  const std::uint64_t* block;
  std::uint32_t count;
  Real inverse_length, softening2;
  Real* potential;  // by slot

  HOOKE_HD void operator()(std::uint32_t i) const {
    using P = Pack<Real>;
    const ParticleRecord<Real> p = records[i];
    potential[i] = Real(0);
    if (is_vacant(p)) return;
    const Vec3<Real> at = inverse_length * p.x;
    P total(Real(0)), sum(Real(0));
    for (std::uint32_t s = 0; s < count; ++s) {
      if (s > 0 && block[s] != block[s - 1]) {
        total = total + sum;
        sum = P(Real(0));
      }
      const PullSource<Real> source = sources[s];
      const Vec3<P> towards{P(source.x - at.x), P(source.y - at.y), P(source.z - at.z)};
      const P value = attraction_potential<ExactMath>(towards, P(source.mass), P(softening2));
      sum = sum + select(dot(towards, towards) > P(Real(0)), value, P(Real(0)));
    }
    potential[i] = (total + sum).v.number;
  }
};

/// Finds the slots of particles; kNoSlot where one is gone.
template <class Real>
struct FindSlots {
  const ParticleRecord<Real>* records;
  const std::uint32_t* slot_of_id_index;
  const std::uint32_t* id_index;
  std::uint32_t* found;

  HOOKE_HD void operator()(std::uint32_t k) const { found[k] = slot_of(records, slot_of_id_index, id_index[k]); }
};

/// The caller's forces.
template <class Real>
struct PutForces {
  const std::uint32_t* slot;  // kNoSlot where a particle is gone
  const Vec3<Real>* from;
  Vec3<Real>* force;  // N, by slot

  HOOKE_HD void operator()(std::uint32_t k) const {
    if (slot[k] != kNoSlot) force[slot[k]] = from[k];
  }
};

/// Adds one column to another.
template <class Real>
struct AddForces {
  const Vec3<Real>* force;
  Vec3<Real>* total;
  bool is_first;

  HOOKE_HD void operator()(std::uint32_t i) const { total[i] = is_first ? force[i] : total[i] + force[i]; }
};

/// A bit for each held particle. Items are slices.
template <class Real>
struct MarkPinned {
  const ParticleRecord<Real>* records;
  const std::uint8_t* fixed;            // by material
  const std::uint8_t* held;             // by id index; null where the structure holds none
  std::uint16_t* bits;

  HOOKE_HD void operator()(std::uint32_t g) const {
    unsigned set = 0;
    for (unsigned lane = 0; lane < kSliceLanes; ++lane) {
      const ParticleRecord<Real> p = records[g * kSliceLanes + lane];
      if (is_vacant(p)) continue;
      const bool is_held =
          fixed[static_cast<std::size_t>(p.material)] != 0 || (held != nullptr && held[id_index_of(p.id_index)] != 0);
      set |= (is_held ? 1U : 0U) << lane;
    }
    bits[g] = static_cast<std::uint16_t>(set);
  }
};

/// What holding particles takes: impulse and work, in double precision.
struct HoldSum {
  enum { power, force, count = force + 3 };
};

/// Puts held particles back to where they were, with the velocities that they had, and sums what that took
/// (AppliedSums::add_pinned).
template <class Real>
struct HoldStill {
  const std::uint16_t* bits;  // by slice
  const ParticleRecord<Real>* before;
  ParticleRecord<Real>* after;
  Vec3<Real>* acceleration;  // of the coming half kick; null without
  const double* mass;        // by material, kg
  double kick;               // duration, s
  SumCopies<double> sums;    // HoldSum::count

  HOOKE_HD void operator()(std::uint32_t i) const {
    if ((bits[i / kLanes] >> i % kLanes & 1U) == 0 || is_vacant(before[i])) return;
    const Vec3d held = vec_cast<double>(before[i].v), kicked = vec_cast<double>(after[i].v);
    const Vec3d given = (mass[static_cast<std::size_t>(before[i].material)] / kick) * (held - kicked);
    FixedSum<double>* const own = sums.of_item(i);
    const auto add = [&](int sum, double term) {
      if (term != 0) add_to_digits(own[sum], term);
    };
    add(HoldSum::power, 2 * dot(given, held));
    add(HoldSum::force, given.x);
    add(HoldSum::force + 1, given.y);
    add(HoldSum::force + 2, given.z);
    after[i] = before[i];
    if (acceleration != nullptr) acceleration[i] = {Real(0), Real(0), Real(0)};
  }
};

/// The windows of an applied force's sums.
struct WorkWindows {
  SumWindow of[WorkSum::count];
};

/// Sums the work of an applied force. Run on whole warps.
template <class Real>
struct SumWork {
  const ParticleRecord<Real>* before;
  const ParticleRecord<Real>* after;
  const Vec3<Real>* force;         // N
  const Vec3<Real>* acceleration;  // velocity Verlet: of the coming kick, m/s^2; else null
  Real kick_time;                  // s
  bool has_resultant;              // the force itself is summed too
  std::uint32_t end;               // slots in use
  SumCopies<Real> sums;            // WorkSum::count of them from `first` on
  std::uint32_t first;
  WorkWindows windows;

  HOOKE_HD void operator()(std::uint32_t i) const {
    const Vec3<Real> zero{Real(0), Real(0), Real(0)};
    const Vec3<Real> f = i < end ? force[i] : zero;
    const Vec3<Real> v = after[i].v;
    FixedSum<Real>* const own = sums.of_item(i) + first;
    add_term(own[WorkSum::power], windows.of[WorkSum::power], dot(f, before[i].v + v));
    if (acceleration != nullptr) {
      const Vec3<Real> next = i < end ? kick(v, acceleration[i], kick_time) : zero;
      add_term(own[WorkSum::next_power], windows.of[WorkSum::next_power], dot(f, v + next));
    }
    if (!has_resultant) return;
    add_term(own[WorkSum::force], windows.of[WorkSum::force], f.x);
    add_term(own[WorkSum::force + 1], windows.of[WorkSum::force + 1], f.y);
    add_term(own[WorkSum::force + 2], windows.of[WorkSum::force + 2], f.z);
  }
};

}  // namespace hooke::gpu
