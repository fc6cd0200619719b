// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/backends/cpu/particle_slots.h"
#include "hooke/base/exact_sum.h"
#include "hooke/base/huge_pages.h"
#include "hooke/core/id_runs.h"
#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/passes/id_table.h"
#include "hooke/passes/particle_record.h"
#include "hooke/passes/pass_rules.h"

namespace hooke {

/// The particles in one precision: their records, the records' slots, and the particles' ids. Listed particles lie in
/// cell order as of the last reorder(); id indices lead back to ids. Vacant slots hold vacant records.
template <class Real>
class ParticleState {
  using Record = ParticleRecord<Real>;
  static constexpr std::size_t kTile = ParticleSlots::kTile;

 public:
  LargeVector<Record> records, next;  ///< the state, and where a pass writes the next; both end with a filler
  LargeVector<Vec3<Real>> acceleration;  ///< of the last evaluation, m/s^2; velocity Verlet only, else empty
  IdTable ids;  ///< by id index
  ParticleSlots slots;

  /// `scene` and `rules` must outlive this object.
  void configure(const Scene& scene, const PassRules<Real>& rules) {
    scene_ = &scene;
    rules_ = &rules;
  }

  bool verlet() const { return scene_->integrator == Integrator::velocity_verlet; }
  const Material& material_of(const Record& p) const { return scene_->materials[static_cast<std::size_t>(p.material)]; }

  std::size_t count() const { return count_; }  ///< particles
  std::uint64_t count_of(std::size_t material) const { return count_of_[material]; }
  std::size_t noninteracting_count() const { return noninteracting_count_; }  ///< particles that touch none
  const ExactSum& mass() const { return mass_; }  ///< of all, kg

  /// Replaces all particles by these, of the scene, laid out in order of their ids, with room for births, for `births`
  /// at least.
  void place(const ParticleSet& particles, std::size_t births = 0);
  /// The same for a part of the scene's particles; `all`: the ids of all of them.
  void place_part(const ParticleSet& particles, std::span<const IdRun> all);

  /// The buffer of the next state, as working memory; call end_scratch() before the next pass. reorder() works in it,
  /// too.
  std::span<std::byte> scratch() { return std::as_writable_bytes(std::span(next)); }
  void end_scratch() {
    fill_unused(next);
    copy_ghosts(records, next);
  }

  /// Backend::download().
  template <class Out>
  void download(const ParticleColumns<Out>& out) const;

  /// Moves the record in slot order[k] to listed slot k; vacant records come last. Noninteracting particles stay.
  void reorder(std::span<const std::uint32_t> order);

  /// How many more particles of a kind there should be slots for: the births still expected, or half the present number
  /// if that is more, so that a new layout of all particles is rare.
  std::size_t room_for_births(bool listed) const;
  bool has_room_for(const ParticleSet& newborn) const;

  /// Counts how often particles have left their slots.
  std::uint64_t changes() const { return changes_; }

  /// Particles have left whose slots must not be found any more.
  void forget_slots() {
    slot_of_id_index_.clear();
    known_slot_of_id_index_.clear();
  }

  static constexpr std::uint32_t kNoSlot = ~std::uint32_t{0};
  /// Finds the slot of each id. A pass over all particles where a layout or a sort has moved them; else nothing.
  void find_slots() const;
  /// The slots, by id index, as of find_slots() and of particles added since; kNoSlot where there was no particle. The
  /// slot of a particle removed since is vacant, or another particle's.
  const std::vector<std::uint32_t>& slots_by_id_index() const { return slot_of_id_index_; }
  /// The same with the slots of ghosts, after find_known_slots().
  void find_known_slots() const;
  const std::vector<std::uint32_t>& known_slots_by_id_index() const {
    return slots.has_ghosts() ? known_slot_of_id_index_ : slot_of_id_index_;
  }
  /// The slot of a particle by its id, after find_slots(); kNoSlot where there is none.
  std::size_t slot_of(std::uint64_t id) const;

  /// Gives the particle in a slot another position (m) and velocity (m/s).
  void set(std::size_t slot, const Vec3d& position, const Vec3d& velocity);

  /// A particle on its way to another rank, of the same ids.
  struct Traveller {
    Record record;
    Vec3<Real> acceleration{Real(0), Real(0), Real(0)};
  };
  Record record_of(const ParticleSet& particles, std::size_t k, std::size_t id_index) const;
  Traveller traveller(std::size_t slot) const {
    return verlet() ? Traveller{records[slot], acceleration[slot]} : Traveller{records[slot]};
  }
  /// Takes up particles from other ranks; recounts. Returns whether others have moved to make room: then there are no
  /// ghosts.
  bool take_in(std::span<const Traveller> arrivals);
  /// Replaces all ghosts, which lie in this order from slots.first_ghost() on, and are of both buffers.
  void put_ghosts(std::span<const Record> ghosts);
  /// Makes a ghost's slot vacant in both buffers.
  void remove_ghost(std::size_t slot) { records[slot] = next[slot] = vacant_record<Real>(records[slot].id_index); }
  /// Moves ghost order[k] to place k.
  void reorder_ghosts(std::span<const std::uint32_t> order);

  /// Puts the k-th newborn into a slot that was taken for it; call recount() after the last. Returns its id index.
  std::size_t add(std::size_t slot, const ParticleSet& newborn, std::size_t k);
  /// Makes a slot vacant; call recount() after the last.
  void remove(std::size_t slot);
  void recount();

  /// Backend::particles_hash().
  std::uint64_t hash() const;

 private:
  // Whether the particle of an id index is still in a slot that it had.
  bool is_at(std::uint32_t slot, std::size_t id_index) const {
    return slot != kNoSlot && !is_vacant(records[slot]) && id_index_of(records[slot].id_index) == id_index;
  }
  void put(std::size_t slot, std::size_t id_index, const ParticleSet& particles, std::size_t k);
  void count_anew(const ParticleSet& particles);
  void lay_out(const ParticleSet& particles, std::size_t more_interacting, std::size_t more_noninteracting);
  void size_buffers();
  static std::size_t room_for_arrivals(std::size_t beside) { return beside / 16 + kTile; }
  void make_room(std::size_t interacting, std::size_t noninteracting);
  void fill_unused(LargeVector<Record>& all) const;
  void copy_ghosts(const LargeVector<Record>& from, LargeVector<Record>& to) const;

  template <class T>
  void permute(LargeVector<T>& column, LargeVector<T>& scratch, std::span<const std::uint32_t> order) const;

  const Scene* scene_ = nullptr;
  const PassRules<Real>* rules_ = nullptr;
  std::vector<std::uint64_t> count_of_;  // particles by material
  std::size_t count_ = 0, noninteracting_count_ = 0;
  std::uint64_t changes_ = 0;
  ExactSum mass_;  // kg
  mutable std::vector<std::uint32_t> slot_of_id_index_;  // by find_slots(); empty where slots have changed since
  mutable std::vector<std::uint32_t> known_slot_of_id_index_;  // by find_known_slots(); likewise, or ghosts have
};

extern template class ParticleState<float>;
extern template class ParticleState<double>;

}  // namespace hooke
