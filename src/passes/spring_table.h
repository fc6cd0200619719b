// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "hooke/base/huge_pages.h"
#include "hooke/core/springs.h"
#include "hooke/passes/exclusions.h"
#include "hooke/passes/id_table.h"
#include "hooke/passes/particle_record.h"
#include "hooke/passes/spring_pass.h"

namespace hooke {

/// One end's side of a spring.
struct SpringSide {
  std::uint32_t spring, partner;  // index, id index
};

/// The springs of a scene as back ends keep them on the host: what each one is, which ones broke, the sides of each
/// particle by ascending index of their springs, and the pairs that springs keep from touching.
template <class Real>
class SpringTable {
 public:
  /// Takes a structure, or none; no spring of it is broken. `period`: lengths of periodic axes, m, else 0.
  void configure(const std::shared_ptr<const Structure>& structure, const Vec3<Real>& period);

  bool empty() const { return kind_.empty(); }
  std::size_t size() const { return kind_.size(); }
  bool is_tearable() const { return is_tearable_; }  ///< whether any spring can break

  /// From now on these springs (indices, ascending) are broken, and no others.
  void break_springs(const std::vector<std::uint64_t>& broken);
  std::vector<std::uint64_t> broken_springs() const;  ///< ascending
  bool is_broken(std::uint32_t spring) const { return broken_[spring] != 0; }

  /// Finds the springs' ends among the particles of these ids.
  void bind(const IdTable& ids);
  /// There are more id indices now; no spring ties the new ones.
  void grow(std::size_t id_indices);

  /// A spring between these two id indices breaks. Returns whether it has kept them from touching: they may, from now
  /// on.
  bool tear(std::uint32_t spring, std::uint32_t a, std::uint32_t b);

  /// The same for a spring that has torn elsewhere; nothing where it is broken already.
  void tear(std::uint32_t spring);

  /// The energy of a spring between two records, J.
  double energy_of(std::uint32_t spring, const ParticleRecord<Real>& i, const ParticleRecord<Real>& p) const;

  /// visit(side) for each spring of an id index that holds.
  template <class Visit>
  void for_each_side(std::size_t id_index, const Visit& visit) const {
    if (empty()) return;
    for (std::uint32_t k = first_side_[id_index]; k < first_side_[id_index + 1]; ++k) {
      if (broken_[sides_[k].spring] == 0) visit(sides_[k]);
    }
  }

  // By spring, and the kinds.
  const std::vector<SpringKind<Real>>& kinds() const { return kinds_; }
  const LargeVector<std::uint32_t>& kind() const { return kind_; }
  const LargeVector<Real>& rest_length() const { return rest_length_; }  ///< m
  const std::vector<std::uint8_t>& broken() const { return broken_; }

  /// Sides first_side()[r] and on, to first_side()[r + 1], are of id index r.
  const std::vector<std::uint32_t>& first_side() const { return first_side_; }
  const LargeVector<SpringSide>& sides() const { return sides_; }
  const Exclusions& exclusions() const { return exclusions_; }

 private:
  void take(const std::shared_ptr<const Structure>& structure);

  std::shared_ptr<const Structure> structure_;
  IdTable ids_;  // of the last bind()
  Vec3<Real> period_{};  // m
  std::vector<SpringKind<Real>> kinds_;
  bool is_tearable_ = false;
  LargeVector<std::uint32_t> kind_;
  LargeVector<Real> rest_length_;
  std::vector<std::uint8_t> broken_;
  LargeVector<SpringSide> sides_;
  std::vector<std::uint32_t> first_side_;
  Exclusions exclusions_;
};

extern template class SpringTable<float>;
extern template class SpringTable<double>;

}  // namespace hooke
