// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The sums of attraction, written once and compiled once for each instruction set (HOOKE_ISA): one target per lane, the
// sources one after the other, so that no bit depends on the number of lanes.

#include "hooke/backends/cpu/attraction_pass.h"
#include "hooke/backends/cpu/packs.h"

namespace hooke::HOOKE_ISA {
namespace {

// Sums over the sources for kPacks packs of targets from `first` on; several packs hide each other's latency.
template <class Real, int kPacks, class Law>
HOOKE_HD void sum_for_packs(AttractionTargets<Real>& targets, std::size_t first, std::size_t source_count,
                            const Law& law) {
  using P = Pack<Real>;
  Vec3<P> at[kPacks], sum[kPacks];
  for (int k = 0; k < kPacks; ++k) {
    const std::size_t slot = first + static_cast<std::size_t>(k) * P::kLanes;
    at[k] = {load(targets.x + slot), load(targets.y + slot), load(targets.z + slot)};
    sum[k] = {P(Real(0)), P(Real(0)), P(Real(0))};
  }
  for (std::size_t s = 0; s < source_count; ++s) {
    for (int k = 0; k < kPacks; ++k) law(s, at[k], sum[k]);
  }
  for (int k = 0; k < kPacks; ++k) {
    const std::size_t slot = first + static_cast<std::size_t>(k) * P::kLanes;
    store(targets.ax + slot, load(targets.ax + slot) + sum[k].x);
    store(targets.ay + slot, load(targets.ay + slot) + sum[k].y);
    store(targets.az + slot, load(targets.az + slot) + sum[k].z);
  }
}

template <class Real, class Law>
HOOKE_HD void sum_for_all(AttractionTargets<Real>& targets, std::size_t source_count, const Law& law) {
  constexpr std::size_t kLanes = Pack<Real>::kLanes;
  std::size_t first = 0;
  for (; first + 2 * kLanes <= targets.count; first += 2 * kLanes) {
    sum_for_packs<Real, 2>(targets, first, source_count, law);
  }
  for (; first < targets.count; first += kLanes) sum_for_packs<Real, 1>(targets, first, source_count, law);
}

template <class Real, class Math>
void pull(const AttractionWork<Real>& work, const AttractionSource<Real>* sources) {
  using P = Pack<Real>;
  sum_for_all(*work.targets, work.source_count, [&](std::size_t s, const Vec3<P>& at, Vec3<P>& sum) {
    const AttractionSource<Real>& p = sources[s];
    const Vec3<P> towards{P(p.x) - at.x, P(p.y) - at.y, P(p.z) - at.z};
    const P factor = attraction<Math>(towards, P(p.mass), P(work.softening2));
    sum = {Math::multiply_add(factor, towards.x, sum.x), Math::multiply_add(factor, towards.y, sum.y),
           Math::multiply_add(factor, towards.z, sum.z)};
  });
}

template <class Real>
HOOKE_HD MassCloud<Pack<Real>> cloud_for_all(const MassCloud<Real>& c) {
  using P = Pack<Real>;
  return {P(c.mass), P(c.xx), P(c.xy), P(c.xz), P(c.yy), P(c.yz), P(c.zz), P(c.trace)};
}

template <class Real, class Math>
void pull(const AttractionWork<Real>& work, const AttractionCell<Real>* cells) {
  using P = Pack<Real>;
  sum_for_all(*work.targets, work.cell_count, [&](std::size_t s, const Vec3<P>& at, Vec3<P>& sum) {
    const AttractionCell<Real>& c = cells[s];
    const Vec3<P> towards{P(c.x) - at.x, P(c.y) - at.y, P(c.z) - at.z};
    sum += cloud_attraction<Math>(towards, cloud_for_all(c.cloud), P(work.softening2));
  });
}

template <class Real, class Law>
HOOKE_HD void potential_for_all(AttractionTargets<Real>& targets, std::size_t source_count, const Law& law) {
  using P = Pack<Real>;
  for (std::size_t slot = 0; slot < targets.count; slot += P::kLanes) {
    const Vec3<P> at{load(targets.x + slot), load(targets.y + slot), load(targets.z + slot)};
    P sum(Real(0));
    for (std::size_t s = 0; s < source_count; ++s) sum = sum + law(s, at);
    store(targets.potential + slot, load(targets.potential + slot) + sum);
  }
}

template <class Real>
void potential(const AttractionWork<Real>& work, const AttractionSource<Real>* sources) {
  using P = Pack<Real>;
  potential_for_all(*work.targets, work.source_count, [&](std::size_t s, const Vec3<P>& at) {
    const AttractionSource<Real>& p = sources[s];
    const Vec3<P> towards{P(p.x) - at.x, P(p.y) - at.y, P(p.z) - at.z};
    const P value = attraction_potential<ExactMath>(towards, P(p.mass), P(work.softening2));
    return select(dot(towards, towards) > P(Real(0)), value, P(Real(0)));
  });
}

template <class Real>
void potential(const AttractionWork<Real>& work, const AttractionCell<Real>* cells) {
  using P = Pack<Real>;
  potential_for_all(*work.targets, work.cell_count, [&](std::size_t s, const Vec3<P>& at) {
    const AttractionCell<Real>& c = cells[s];
    const Vec3<P> towards{P(c.x) - at.x, P(c.y) - at.y, P(c.z) - at.z};
    return cloud_potential<ExactMath>(towards, cloud_for_all(c.cloud), P(work.softening2));
  });
}

template <class Real, class Source>
void choose_math(const AttractionWork<Real>& work, const Source* sources) {
  if (work.exact) return pull<Real, ExactMath>(work, sources);
  return pull<Real, FastMath>(work, sources);
}

}  // namespace

void pull_by_particles(const AttractionWork<float>& work) { choose_math(work, work.sources); }
void pull_by_particles(const AttractionWork<double>& work) { choose_math(work, work.sources); }
void pull_by_cells(const AttractionWork<float>& work) { choose_math(work, work.cells); }
void pull_by_cells(const AttractionWork<double>& work) { choose_math(work, work.cells); }
void potential_of_particles(const AttractionWork<float>& work) { potential(work, work.sources); }
void potential_of_particles(const AttractionWork<double>& work) { potential(work, work.sources); }
void potential_of_cells(const AttractionWork<float>& work) { potential(work, work.cells); }
void potential_of_cells(const AttractionWork<double>& work) { potential(work, work.cells); }

}  // namespace hooke::HOOKE_ISA
