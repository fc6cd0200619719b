// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "hooke/backends/cpu/particle_state.h"
#include "hooke/base/huge_pages.h"
#include "hooke/core/scene.h"
#include "hooke/core/sums.h"
#include "hooke/passes/force_pass.h"
#include "hooke/passes/id_table.h"
#include "hooke/passes/spring_pass.h"
#include "hooke/passes/spring_table.h"

namespace hooke {

/// The springs of a scene in the layout of the spring pass. Each particle has one side of every spring that ties it, by
/// ascending index. After each sort of the particles, the sides are laid out in rows like a neighbour list: row k of a
/// slice of 16 particles holds the k-th side of each particle.
template <class Real>
class SpringLists {
  using Record = ParticleRecord<Real>;
  static constexpr std::size_t kLanes = kSliceLanes, kSlices = kTile / kLanes;

 public:
  static constexpr std::uint32_t kVacant = ParticleState<Real>::kNoSlot;

  void configure(const Scene& scene, const RulesView<Real>& rules, SpringPassFunction<Real> run);

  bool empty() const { return table_.empty(); }

  /// From now on these springs (indices, ascending) are broken, and no others.
  void break_springs(const std::vector<std::uint64_t>& broken) { table_.break_springs(broken); }
  std::vector<std::uint64_t> broken() const { return table_.broken_springs(); }

  /// Finds the springs' ends among the particles of these ids.
  void bind(const IdTable& ids) { table_.bind(ids); }

  /// There are more particles now; no spring ties the new ones.
  void grow(std::size_t id_indices) { table_.grow(id_indices); }

  /// visit(id index) for the other ends of the springs that tie a particle.
  template <class Visit>
  void for_each_partner(std::uint32_t id_index, const Visit& visit) const {
    table_.for_each_side(id_index, [&](const SpringSide& side) { visit(side.partner); });
  }

  /// Springs that tore since the last call, in any order; and springs that have torn elsewhere.
  std::vector<std::uint32_t> take_torn() { return std::exchange(torn_, {}); }
  void tear(std::uint32_t spring) { table_.tear(spring); }

  /// Pairs that springs keep from touching.
  const Exclusions& exclusions() const { return table_.exclusions(); }

  /// Lays the springs out for the first `count` particles in their present order; others that they tie are known too:
  /// `slot_of` is the slot of each id index, kVacant where a particle is gone. The last of `size` records fills short
  /// rows.
  void lay_out(const Record* records, std::size_t count, std::size_t size, const std::vector<std::uint32_t>& slot_of);

  /// Forces on every particle, N: the column that apply() fills.
  const Vec3<Real>* forces() const { return force_.data(); }

  /// Sums the spring forces on every particle at the positions of `records`. With `may_tear`, springs that are
  /// stretched too far break. Returns the pairs (indices) that broken springs kept apart: they may touch from now on.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& apply(const Record* records, bool may_tear,
                                                                    SpringSums& sums);

  /// Adds the number and the energy of the springs that hold.
  void measure(const Record* records, const std::vector<std::uint32_t>& slot_of, MeasurementSums& sums) const;

  /// Adds the energy (J) of the springs that tie the particle of an id index; a spring whose other end is one of
  /// `among` (indices, ascending) counts half.
  void add_energy(const Record* records, const std::vector<std::uint32_t>& slot_of, std::size_t id_index,
                  std::span<const std::uint32_t> among, ExactSum& sum) const;

 private:
  template <class Visit>
  void for_each_side(const Record* records, const std::vector<std::uint32_t>& slot_of, std::size_t id_index,
                     const Visit& visit) const;
  void finish_torn(const Record* records, std::size_t g, SpringSums& sums);

  SpringPassFunction<Real> run_ = nullptr;
  SpringPass<Real> pass_;
  SpringTable<Real> table_;

  std::vector<std::uint32_t> torn_;  // since take_torn()
  std::vector<std::pair<std::uint32_t, std::uint32_t>> released_;  // by the last apply(): indices of both particles

  std::size_t count_ = 0;  // particles laid out
  LargeVector<SpringRow<Real>> rows_;
  std::vector<std::uint32_t> first_row_;  // by slice
  LargeVector<Vec3<Real>> force_;  // by slot, N
  mutable std::mutex mutex_;  // guards totals
};

extern template class SpringLists<float>;
extern template class SpringLists<double>;

}  // namespace hooke
