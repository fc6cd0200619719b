// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "hooke/backends/cpu/attraction_forces.h"
#include "hooke/backends/cpu/external_forces.h"
#include "hooke/backends/cpu/field_forces.h"
#include "hooke/backends/cpu/isa.h"
#include "hooke/backends/cpu/particle_state.h"
#include "hooke/backends/cpu/pinned_particles.h"
#include "hooke/backends/cpu/spring_lists.h"
#include "hooke/base/assert.h"
#include "hooke/base/huge_pages.h"
#include "hooke/core/scene.h"
#include "hooke/core/sums.h"
#include "hooke/passes/particle_record.h"

namespace hooke {

/// The forces on particles beside those of the force pass: springs, fields, attraction and the caller's forces. They
/// are summed before the pass into one column, which the pass adds. Held particles are put back after the pass. A scene
/// without any of this pays nothing.
template <class Real>
class AppliedForces {
  using Record = ParticleRecord<Real>;
  using Particles = ParticleState<Real>;

 public:
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  void configure(const Scene& scene, const RulesView<Real>& rules, const Loops<Real>& loops);

  SpringLists<Real>& springs() { return springs_; }
  const SpringLists<Real>& springs() const { return springs_; }
  const PinnedParticles& pinned() const { return pinned_; }

  /// Whether no such force acts and no particle is pinned.
  bool none() const {
    return springs_.empty() && fields_.empty() && attraction_.empty() && pinned_.none() && external_.empty();
  }

  /// Backend::set_external_forces().
  std::optional<std::uint64_t> set_external(const Particles& particles, std::span<const std::uint64_t> ids,
                                            std::span<const Vec3d> forces) {
    applied_.clear();
    return external_.set(particles, ids, forces);
  }

  /// After a new layout of all particles: finds the particles of springs and cloths, and those that are pinned.
  void bind(const Particles& particles);

  /// Other particles of the same ids are here: finds those that are pinned.
  void bind_pinned(const Particles& particles);
  /// There are more ids now; no spring and no cloth has the new ones.
  void grow(std::size_t id_indices) {
    springs_.grow(id_indices);
    fields_.grow(id_indices);
  }

  /// A new particle is in `slot`, with the last id index. No spring ties it, but it may be fixed.
  void add(const Particles& particles, std::size_t slot, bool fixed);

  /// Whether the structure pins the particle of an id index, here or on another rank. Takes a search.
  bool pins(std::uint32_t id_index) const {
    return std::find(pinned_id_indices_.begin(), pinned_id_indices_.end(), id_index) != pinned_id_indices_.end();
  }

  /// Adds the id indices that the forces on the particles here need to know, and that are not among these slots.
  void want_partners(const Particles& particles, std::vector<std::uint32_t>& id_indices) const;

  bool needs_layout() const { return !springs_.empty() || fields_.needs_places() || !pinned_.none(); }

  /// After a sort of the particles.
  void lay_out(const Particles& particles);

  /// The scene's clock, s.
  void set_time(double seconds) { fields_.set_time(seconds); }

  /// Sums the forces on the particles. With `may_tear`, springs that are stretched too far break. Returns the pairs
  /// (indices) that broken springs kept apart: they may touch from now on.
  const Pairs& apply(const Particles& particles, bool may_tear, SpringSums& sums);

  /// N, in the order of the records; null where nothing acts.
  const Vec3<Real>* forces() const {
    return applied_.empty() ? nullptr : applied_.size() == 1 ? applied_.front().force : total_.data();
  }

  /// After the pass over particles `first` to `last` - 1, of one tile: puts pinned particles back to where they were,
  /// and adds the work of each force. `acceleration` (velocity Verlet, else null) is that of the coming half kick.
  void finish(std::size_t first, std::size_t last, const Record* before, Record* after, Vec3<Real>* acceleration,
              AppliedSums& sums) const;
  void measure(const Particles& particles, MeasurementSums& sums);

  /// Adds the energy (J) of the springs that tie record i; a spring whose other end is one of `among` (indices,
  /// ascending) counts half. Call after lay_out().
  void add_spring_energy(const Particles& particles, std::size_t i, std::span<const std::uint32_t> among,
                         ExactSum& sum) const {
    if (springs_.empty()) return;
    springs_.add_energy(particles.records.data(), particles.known_slots_by_id_index(),
                        id_index_of(particles.records[i].id_index), among, sum);
  }

 private:
  struct AppliedForce {
    Cause cause;
    const Vec3<Real>* force;  // N
  };

  void find_pinned(const Particles& particles);
  void hold_still(std::size_t first, std::size_t last, const Record* before, Record* after, Vec3<Real>* acceleration,
                  AppliedSums& sums) const;
  void add_work(const AppliedForce& applied, std::size_t first, std::size_t last, const Record* before,
                const Record* after, const Vec3<Real>* acceleration, AppliedSums& sums) const;

  std::shared_ptr<const Structure> structure_;
  double kick_ = 0;  // s
  std::vector<double> mass_;  // by material, kg
  std::vector<bool> fixed_;  // likewise
  bool any_fixed_ = false;
  SpringLists<Real> springs_;
  FieldForces<Real> fields_;
  AttractionForces<Real> attraction_;
  ExternalForces<Real> external_;
  WorkPassFunction<Real> work_pass_ = nullptr;
  std::vector<AppliedForce> applied_;  // in the order of their sum
  LargeVector<Vec3<Real>> total_;  // their sum, where several act
  std::vector<std::uint32_t> pinned_id_indices_;
  PinnedParticles pinned_;
};

extern template class AppliedForces<float>;
extern template class AppliedForces<double>;

}  // namespace hooke
