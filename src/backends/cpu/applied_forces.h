// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
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
#include "hooke/core/scene.h"
#include "hooke/core/sums.h"

namespace hooke {

/// What acts on the particles of a scene beside the force pass: springs, fields and attraction, summed before the pass
/// into one column of forces that it adds, and what holds particles still after it. A scene that has nothing of it pays
/// nothing.
template <class Real>
class AppliedForces {
  using Record = ParticleRecord<Real>;
  using Records = LargeVector<Record>;

 public:
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  void configure(const Scene& scene, const ForcePass<Real>& rules, const Loops<Real>& loops);

  SpringLists<Real>& springs() { return springs_; }
  const SpringLists<Real>& springs() const { return springs_; }
  const HeldParticles& held() const { return held_; }

  /// Whether the scene has nothing of it.
  bool none() const { return springs_.empty() && fields_.empty() && attraction_.empty() && held_.none(); }

  /// Ties and holds the particles of these ids, which lie in the first `count` records.
  void bind(const IdTable& ids, const Records& records, std::size_t count);

  /// A particle comes into `slot`, one of `room`, with the last of `ranks`: no spring ties it, but it may be fixed.
  void add(std::size_t slot, std::size_t ranks, bool fixed, std::size_t room);

  bool needs_layout() const { return !springs_.empty() || fields_.needs_places() || !held_.none(); }

  /// After a sort: where the particles of the first `count` records are now, of `ranks` that there have been.
  void lay_out(const Records& records, std::size_t count, std::size_t ranks);

  /// The scene's clock, s.
  void set_time(double seconds) { fields_.set_time(seconds); }

  /// Sums up the forces on the first `count` records, of which `alive` are somewhere. With `may_tear`, springs that are
  /// stretched too far break. Returns the pairs (indices) that springs kept apart and that may touch from now on.
  const Pairs& apply(const Records& records, std::size_t count, std::size_t alive, const IdTable& ids, bool may_tear,
                     SpringSums& sums);

  /// N, in the order of the records; null where nothing acts.
  const Vec3<Real>* forces() const {
    return acting_.empty() ? nullptr : acting_.size() == 1 ? acting_.front().force : total_.data();
  }

  /// After the pass over particles `first` to `last` - 1, of one tile: puts held ones back to where they were, and
  /// adds up what all of this did. `acceleration` (velocity Verlet, else null) is that of the half kick to come.
  void finish(std::size_t first, std::size_t last, const Record* before, Record* after, Vec3<Real>* acceleration,
              AppliedSums& sums) const;
  void measure(const Records& records, std::size_t count, std::size_t alive, const IdTable& ids, Measurements& m);

  /// Adds the energy (J) of the springs that tie record i; half of it where the other end is one of `among` (indices,
  /// ascending). Once laid out.
  void add_spring_energy(const Records& records, std::size_t i, std::span<const std::uint32_t> among,
                         ExactSum& sum) const {
    springs_.add_energy(records.data(), place_, rank_of(records[i].rank), among, sum);
  }

 private:
  struct Acting {
    Cause cause;
    const Vec3<Real>* force;  // N
  };

  void find_places(const Records& records, std::size_t count, std::size_t ranks);
  void find_held(std::size_t count);
  void hold_still(std::size_t first, std::size_t last, const Record* before, Record* after, Vec3<Real>* acceleration,
                  AppliedSums& sums) const;
  void add_work(const Acting& acting, std::size_t first, std::size_t last, const Record* before, const Record* after,
                const Vec3<Real>* acceleration, AppliedSums& sums) const;

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
  std::vector<std::uint32_t> place_;  // by rank, of the last sort, or of a birth since
};

extern template class AppliedForces<float>;
extern template class AppliedForces<double>;

}  // namespace hooke
