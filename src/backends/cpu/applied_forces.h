// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "hooke/backends/cpu/attraction_forces.h"
#include "hooke/backends/cpu/field_forces.h"
#include "hooke/backends/cpu/held_particles.h"
#include "hooke/backends/cpu/id_table.h"
#include "hooke/backends/cpu/isa.h"
#include "hooke/backends/cpu/particle_record.h"
#include "hooke/backends/cpu/spring_lists.h"
#include "hooke/base/assert.h"
#include "hooke/base/huge_pages.h"
#include "hooke/base/parallel.h"
#include "hooke/core/scene.h"
#include "hooke/core/sums.h"
#include "hooke/physics/integrate.h"

namespace hooke {

/// What acts on the particles of a scene beside the force pass: springs, fields and attraction, summed before the pass
/// into one column of forces that it adds, and what holds particles still after it. A scene that has nothing of it pays
/// nothing.
template <class Real>
class AppliedForces {
  using Record = ParticleRecord<Real>;
  using Records = LargeVector<Record>;
  static constexpr std::size_t kSegment = 1024;

 public:
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  void configure(const Scene& scene, const ForcePass<Real>& rules, const Loops<Real>& loops) {
    structure_ = scene.structure;
    births_ = !scene.emitters.empty();
    kick_ = scene.integrator == Integrator::velocity_verlet ? scene.time_step / 2 : scene.time_step;
    mass_.clear();
    fixed_.clear();
    any_fixed_ = false;
    for (const Material& m : scene.materials) {
      mass_.push_back(m.mass);
      fixed_.push_back(m.fixed);
      any_fixed_ = any_fixed_ || m.fixed;
    }
    springs_.configure(scene, rules, loops.spring_pass);
    fields_.configure(scene);
    attraction_.configure(scene, loops.attraction);
    work_pass_ = loops.work_pass;
  }

  SpringLists<Real>& springs() { return springs_; }
  const SpringLists<Real>& springs() const { return springs_; }
  const HeldParticles& held() const { return held_; }

  /// Whether the scene has nothing of it.
  bool none() const { return springs_.empty() && fields_.empty() && attraction_.empty() && held_.none(); }

  /// Ties and holds the particles of these ids, which lie in the first `count` records.
  void bind(const IdTable& ids, const Records& records, std::size_t count) {
    springs_.bind(ids);
    fields_.bind(ids);
    held_ranks_.clear();
    held_ = {};
    std::vector<std::uint32_t>& held = held_ranks_;
    if (structure_) {
      for (const std::uint64_t id : structure_->held) {
        const std::size_t rank = ids.find(id);
        if (rank < ids.size()) held.push_back(static_cast<std::uint32_t>(rank));
      }
    }
    for (std::size_t i = 0; any_fixed_ && i < count; ++i) {
      const Record& p = records[i];
      if (!is_nowhere(p) && fixed_[static_cast<std::size_t>(p.material)]) {
        held.push_back(static_cast<std::uint32_t>(rank_of(p.rank)));
      }
    }
    if (!held.empty() || births_) find_places(records, count, ids.size());
    if (!held.empty()) find_held(count);
  }

  /// A particle is born into `slot` with the last of `ranks`: nothing ties or holds it.
  void add(std::size_t slot, std::size_t ranks) {
    place_.resize(ranks, SpringLists<Real>::kNowherePlace);
    place_.back() = static_cast<std::uint32_t>(slot);
    springs_.grow(ranks);
  }

  bool needs_layout() const { return !springs_.empty() || fields_.needs_places() || !held_.none() || births_; }

  /// After a sort: where the particles of the first `count` records are now, of `ranks` that there have been.
  void lay_out(const Records& records, std::size_t count, std::size_t ranks) {
    find_places(records, count, ranks);
    if (!springs_.empty()) springs_.lay_out(records.data(), count, records.size(), place_);
    if (!held_.none()) find_held(count);
  }

  /// Where the particle of a rank was laid out or born, in a scene with births.
  std::size_t place(std::size_t rank) const {
    HOOKE_ASSERT(rank < place_.size(), rank, place_.size());
    return place_[rank];
  }

  /// The scene's clock, s.
  void set_time(double seconds) { fields_.set_time(seconds); }

  /// Sums up the forces on the first `count` records, of which `alive` are somewhere. With `may_tear`, springs that are
  /// stretched too far break. Returns the pairs (indices) that springs kept apart and that may touch from now on.
  const Pairs& apply(const Records& records, std::size_t count, std::size_t alive, const IdTable& ids, bool may_tear,
                     SpringSums& sums) {
    static const Pairs kNone;
    const Pairs* released = &kNone;
    acting_.clear();
    if (!springs_.empty()) {
      released = &springs_.apply(records.data(), may_tear, sums);
      acting_.push_back({Cause::springs, springs_.forces()});
    }
    if (!fields_.empty()) {
      fields_.apply(records, count, place_);
      acting_.push_back({Cause::field, fields_.forces()});
    }
    if (!attraction_.empty()) {
      attraction_.apply(records, count, alive, ids);
      acting_.push_back({Cause::attraction, attraction_.forces()});
    }
    if (acting_.size() > 1) {
      total_.resize(records.size());
      parallel_ranges(count, kSegment, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          total_[i] = acting_[0].force[i];
          for (std::size_t k = 1; k < acting_.size(); ++k) total_[i] += acting_[k].force[i];
        }
      });
    }
    return *released;
  }

  /// N, in the order of the records; null where nothing acts.
  const Vec3<Real>* forces() const {
    return acting_.empty() ? nullptr : acting_.size() == 1 ? acting_.front().force : total_.data();
  }

  /// After the pass over particles `first` to `last` - 1, of one segment: puts held ones back to where they were, and
  /// adds up what all of this did. `acceleration` (velocity Verlet, else null) is that of the half kick to come.
  void settle(std::size_t first, std::size_t last, const Record* before, Record* after, Vec3<Real>* acceleration,
              AppliedSums& sums) const {
    HOOKE_ASSERT(last - first <= kSegment, first, last);
    hold_still(first, last, before, after, acceleration, sums);
    for (const Acting& acting : acting_) add_work(acting, first, last, before, after, acceleration, sums);
  }

  void measure(const Records& records, std::size_t count, std::size_t alive, const IdTable& ids, Measurements& m) {
    springs_.measure(records.data(), place_, m);
    if (!attraction_.empty()) m.attraction_energy = attraction_.energy(records, count, alive, ids);
  }

  /// Adds the energy (J) of the springs that tie record i; half of it where among(other) says that the other end adds
  /// it too. Once laid out.
  template <class Among>
  void add_spring_energy(const Records& records, std::size_t i, const Among& among, ExactSum& sum) const {
    springs_.add_energy(records.data(), place_, rank_of(records[i].rank), among, sum);
  }

 private:
  struct Acting {
    Cause cause;
    const Vec3<Real>* force;  // N
  };

  void find_places(const Records& records, std::size_t count, std::size_t ranks) {
    place_.assign(ranks, SpringLists<Real>::kNowherePlace);
    parallel_ranges(count, kSegment, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        if (!is_nowhere(records[i])) place_[rank_of(records[i].rank)] = static_cast<std::uint32_t>(i);
      }
    });
  }

  void find_held(std::size_t count) {
    held_.clear(count);
    for (const std::uint32_t rank : held_ranks_) {
      if (place_[rank] != SpringLists<Real>::kNowherePlace) held_.hold(place_[rank]);
    }
  }

  void hold_still(std::size_t first, std::size_t last, const Record* before, Record* after, Vec3<Real>* acceleration,
                  AppliedSums& sums) const {
    if (held_.none()) return;
    for (std::size_t i = first; i < last; ++i) {
      if (!held_.holds(i)) continue;
      sums.add_held(mass_[static_cast<std::size_t>(before[i].material)], vec_cast<double>(before[i].v),
                    vec_cast<double>(after[i].v), kick_);
      after[i] = before[i];
      if (acceleration != nullptr) acceleration[i] = {Real(0), Real(0), Real(0)};
    }
  }

  void add_work(const Acting& acting, std::size_t first, std::size_t last, const Record* before, const Record* after,
                const Vec3<Real>* acceleration, AppliedSums& sums) const {
    const bool external = acting.cause != Cause::springs;  // they give each other what they take
    std::array<ExactParts, WorkSum::count> parts;
    for (ExactParts& part : parts) part.count = 0;
    work_pass_(
        {before + first, after + first, acting.force + first, acceleration == nullptr ? nullptr : acceleration + first,
         static_cast<Real>(kick_), last - first, external},
        parts.data());
    AppliedSums::Rates& rates = sums[acting.cause];
    const auto add = [&](int sum, ExactSum& to) {
      const ExactParts& part = parts[static_cast<std::size_t>(sum)];
      to.add(part.values, part.count);
    };
    add(WorkSum::power, rates.power);
    add(WorkSum::next_power, rates.next_power);
    for (int axis = 0; axis < 3; ++axis) add(WorkSum::force + axis, rates.force[axis]);
  }

  std::shared_ptr<const Structure> structure_;
  double kick_ = 0;  // s
  std::vector<double> mass_;  // by material, kg
  std::vector<bool> fixed_;  // likewise
  bool any_fixed_ = false;
  SpringLists<Real> springs_;
  FieldForces<Real> fields_;
  AttractionForces<Real> attraction_;
  WorkPassFunction<Real> work_pass_ = nullptr;
  std::vector<Acting> acting_;  // in the order of their sum
  LargeVector<Vec3<Real>> total_;  // where several act
  std::vector<std::uint32_t> held_ranks_;
  HeldParticles held_;
  bool births_ = false;
  std::vector<std::uint32_t> place_;  // by rank, of the last sort, or of a birth since
};

}  // namespace hooke
