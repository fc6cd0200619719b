// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The force pass over a tile, compiled once for each instruction set (HOOKE_ISA) and precision (HOOKE_REAL).

#include "hooke/backends/cpu/packs.h"
#include "hooke/backends/cpu/tile_pass.h"
// After the packs.
#include "hooke/passes/force_pass.inl"

namespace hooke::HOOKE_ISA {
namespace {

// Mask of lanes further from their expected position than their reference frame allows; NaN counts as far.
template <class Real, PeriodicKind kPeriodic>
HOOKE_HD Mask<Real> is_far(const TilePass<Real>& pass, const Vec3<Pack<Real>>& x, std::size_t first) {
  using P = Pack<Real>;
  const ReferenceFrame<Real>& frame = pass.motion.frames[first / kWindow];
  const Vec3<Real> moved = frame.at(pass.motion.next_step);
  const Vec3<P> expected{load(pass.motion.position_at_build.x + first) + P(moved.x),
                         load(pass.motion.position_at_build.y + first) + P(moved.y),
                         load(pass.motion.position_at_build.z + first) + P(moved.z)};
  Vec3<P> off = x - expected;
  if constexpr (kPeriodic != PeriodicKind::none) {
    const auto displacement = [&](const P& now, const P& then, bool periodic, Real length) {
      if (!periodic) return now - then;
      return image_displacement(now, then, nearest_image(now, then, P(length)), P(length));
    };
    off = {displacement(x.x, expected.x, pass.forces.rules.periodic[0], pass.forces.rules.length.x),
           displacement(x.y, expected.y, pass.forces.rules.periodic[1], pass.forces.rules.length.y),
           displacement(x.z, expected.z, pass.forces.rules.periodic[2], pass.forces.rules.length.z)};
  }
  return !(dot(off, off) <= P(frame.limit2(pass.motion.next_step)));
}

// What is summed over a tile's particles, one column each. A pack that touches nothing of a kind is left out of the
// kind's columns.
template <class Real>
struct SumColumns {
  std::size_t count = 0, contact_count = 0, wall_count = 0, collider_count = 0;
  alignas(64) Real of[PassSum::kCount][ExactParts::kMost];

  HOOKE_HD std::size_t count_of(int sum) const {
    const int power = sum < 2 * PassSum::kPowers ? sum % PassSum::kPowers : PassSum::kPowers;
    if (power <= power_of(Cause::contact_friction)) return contact_count;
    if (power == power_of(Cause::wall) || (sum >= PassSum::kWallForce && sum < PassSum::kWallForce + 3))
      return wall_count;
    if (power == power_of(Cause::collider) || (sum >= PassSum::kColliderForce && sum < PassSum::kColliderForce + 3)) {
      return collider_count;
    }
    return count;
  }
  HOOKE_HD void put(int sum, const Pack<Real>& a) { store(of[sum] + count_of(sum), a); }
  HOOKE_HD void put(int sum, const Vec3<Pack<Real>>& a) {
    put(sum, a.x);
    put(sum + 1, a.y);
    put(sum + 2, a.z);
  }
  HOOKE_HD void end_pack(const TouchFlags& touches) {
    count += Pack<Real>::kLanes;
    if (touches.others) contact_count += Pack<Real>::kLanes;
    if (touches.wall) wall_count += Pack<Real>::kLanes;
    if (touches.collider) collider_count += Pack<Real>::kLanes;
  }
};

// What run_pack() reports to: the columns of a tile's sums, and the notes of one slice.
template <class Real>
struct SliceReport {
  const TilePass<Real>& tile;
  SumColumns<Real>& columns;
  unsigned char notes = 0;
  unsigned far = 0;

  template <class Term>
  HOOKE_HD void put(int sum, const Term& term) {
    columns.put(sum, term);
  }
  HOOKE_HD void end_pack(const TouchFlags& touches) { columns.end_pack(touches); }
  HOOKE_HD void note(SliceNote what) { notes |= what; }
  template <PeriodicKind kPeriodic>
  HOOKE_HD void moved(const ForcePass<Real>&, const Mask<Real>& present, const Vec3<Pack<Real>>& x, std::size_t first) {
    far |= bits(present & is_far<Real, kPeriodic>(tile, x, first)) << first % kSliceLanes;
  }
};

template <class Real, Materials kMaterials, PeriodicKind kPeriodic>
void run_tile(const TilePass<Real>& pass, const TileWork<Real>& work) {
  SumColumns<Real> columns;
  for (std::size_t g = 0; g < work.slice_count; ++g) {
    SliceReport<Real> report{pass, columns};
    for (std::size_t lane = 0; lane < kSliceLanes; lane += Pack<Real>::kLanes) {
      PackRows rows;
      if (!work.alone) {
        rows = {work.rows + std::size_t{work.first_row[g]} * kSliceLanes + lane,
                work.rows + std::size_t{work.first_row[g + 1]} * kSliceLanes + lane};
      }
      run_pack<Real, kMaterials, kPeriodic, true>(pass.forces, work.first + g * kSliceLanes + lane, rows, report);
    }
    work.notes[g] = report.notes;
    work.far[g] = static_cast<std::uint16_t>(report.far);
  }
  for (int sum = 0; sum < PassSum::kCount; ++sum) {
    if (is_summed(pass.forces, sum)) add_parts(columns.of[sum], columns.count_of(sum), work.sums[sum]);
  }
}

}  // namespace

void force_pass(const TilePass<HOOKE_REAL>& pass, const TileWork<HOOKE_REAL>& work) {
  choose_loop(pass.forces.rules, [&](auto materials, auto periodic) {
    run_tile<HOOKE_REAL, decltype(materials)::value, decltype(periodic)::value>(pass, work);
  });
}

}  // namespace hooke::HOOKE_ISA
