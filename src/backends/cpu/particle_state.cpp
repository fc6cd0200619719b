// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/particle_state.h"

#include <algorithm>
#include <atomic>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"
#include "hooke/core/emitters.h"
#include "hooke/core/state_hash.h"

namespace hooke {

template <class Real>
void ParticleState<Real>::place(const ParticleSet& particles, std::size_t births) {
  HOOKE_ASSERT(are_particles_of(particles, *scene_), particles.size(), scene_->materials.size());
  ids = IdTable(particles.id, !scene_->emitters.empty());
  count_anew(particles);
  lay_out(particles, room_for_births(true) + births, room_for_births(false) + births);
}

template <class Real>
void ParticleState<Real>::place_part(const ParticleSet& particles, std::span<const IdRun> all) {
  HOOKE_ASSERT(are_particles_of(particles, *scene_), particles.size(), scene_->materials.size());
  ids = {};
  for (const IdRun& run : all) ids.append(run.first, static_cast<std::size_t>(run.count));
  count_anew(particles);
  lay_out(particles, room_for_arrivals(count_ - noninteracting_count_), room_for_arrivals(noninteracting_count_));
}

template <class Real>
void ParticleState<Real>::count_anew(const ParticleSet& particles) {
  count_of_.assign(scene_->materials.size(), 0);
  for (const std::uint16_t m : particles.material) ++count_of_[m];
  recount();
}

// Puts the particles in order of their ids, with so much room for more.
template <class Real>
void ParticleState<Real>::lay_out(const ParticleSet& particles, std::size_t more_interacting,
                                  std::size_t more_noninteracting) {
  ++changes_;
  forget_slots();
  const bool tied = scene_->structure != nullptr;  // the structure refers to slots, until the next layout
  slots.lay_out(count_ - noninteracting_count_, more_interacting, noninteracting_count_, more_noninteracting, tied);
  size_buffers();
  acceleration.assign(verlet() ? records.size() : 0, {Real(0), Real(0), Real(0)});
  const bool all_are_here = ids.size() == particles.size();
  std::size_t next_interacting = 0, next_noninteracting = slots.first_noninteracting();
  for (std::size_t k = 0; k < particles.size(); ++k) {
    const std::size_t slot =
        scene_->materials[particles.material[k]].interacts ? next_interacting++ : next_noninteracting++;
    put(slot, all_are_here ? k : ids.find(particles.id[k]), particles, k);
    if (verlet() && !particles.acceleration.empty()) acceleration[slot] = vec_cast<Real>(particles.acceleration[k]);
  }
  fill_unused(records);
  fill_unused(next);
}

// Room for all slots, a pack more for searches to read, and the filler, the last.
template <class Real>
void ParticleState<Real>::size_buffers() {
  records.resize(std::max(slots.room(), slots.ghost_end()) + ParticleSlots::kLanes);
  next.resize(records.size());
}

// Others' particles
// -----------------------------------------------------------------------------------------------------

template <class Real>
bool ParticleState<Real>::take_in(std::span<const Traveller> arrivals) {
  std::size_t noninteracting = 0;
  for (const Traveller& arrival : arrivals) noninteracting += material_of(arrival.record).interacts ? 0 : 1;
  const bool crowded = !slots.has_room(arrivals.size() - noninteracting, noninteracting);
  if (crowded) make_room(arrivals.size() - noninteracting, noninteracting);
  // Tables that are known stay so.
  for (std::vector<std::uint32_t>* table : {&slot_of_id_index_, &known_slot_of_id_index_}) {
    if (!table->empty()) table->resize(ids.size(), kNoSlot);
  }
  for (const Traveller& arrival : arrivals) {
    const std::size_t slot = material_of(arrival.record).interacts ? slots.take_interacting(slots.interacting_end())
                                                                   : slots.take_noninteracting();
    records[slot] = arrival.record;
    if (verlet()) acceleration[slot] = arrival.acceleration;
    ++count_of_[static_cast<std::size_t>(arrival.record.material)];
    for (std::vector<std::uint32_t>* table : {&slot_of_id_index_, &known_slot_of_id_index_}) {
      if (!table->empty()) (*table)[id_index_of(arrival.record.id_index)] = static_cast<std::uint32_t>(slot);
    }
  }
  ++changes_;
  recount();
  return crowded;
}

// Moves all particles to a layout with room for so many more.
template <class Real>
void ParticleState<Real>::make_room(std::size_t interacting, std::size_t noninteracting) {
  std::vector<Traveller> there;
  for (std::size_t i = 0; i < slots.end(); ++i) {
    if (!is_vacant(records[i])) there.push_back(traveller(i));
  }
  const std::size_t listed = count_ - noninteracting_count_;
  slots.lay_out(0, listed + interacting + room_for_arrivals(listed + interacting), 0,
                noninteracting_count_ + noninteracting + room_for_arrivals(noninteracting_count_ + noninteracting),
                scene_->structure != nullptr);
  size_buffers();
  if (verlet()) acceleration.resize(records.size());
  fill_unused(records);
  fill_unused(next);
  count_of_.assign(count_of_.size(), 0);
  forget_slots();
  take_in(there);
}

template <class Real>
void ParticleState<Real>::put_ghosts(std::span<const Record> ghosts) {
  slots.lay_out_ghosts(ghosts.size());
  known_slot_of_id_index_.clear();
  if (records.size() < slots.ghost_end() + ParticleSlots::kLanes) size_buffers();
  std::copy(ghosts.begin(), ghosts.end(), records.begin() + static_cast<std::ptrdiff_t>(slots.first_ghost()));
  fill_unused(records);
  end_scratch();
}

template <class Real>
void ParticleState<Real>::reorder_ghosts(std::span<const std::uint32_t> order) {
  known_slot_of_id_index_.clear();
  const Record* const before = records.data() + slots.first_ghost();
  Record* const after = next.data() + slots.first_ghost();
  for (std::size_t k = 0; k < order.size(); ++k) after[k] = before[order[k]];
  std::copy(after, after + order.size(), records.data() + slots.first_ghost());
}

template <class Real>
template <class Out>
void ParticleState<Real>::download(const ParticleColumns<Out>& out) const {
  find_slots();
  constexpr std::size_t kBlock = std::size_t{1} << 14U;  // of id indices
  const std::vector<std::uint32_t>& at = slot_of_id_index_;
  const std::size_t blocks = (ids.size() + kBlock - 1) / kBlock;
  const auto for_blocks = [&](const auto& visit) {
    parallel_ranges(blocks, 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t b = first; b < last; ++b) visit(b, b * kBlock, std::min((b + 1) * kBlock, ids.size()));
    });
  };
  std::vector<std::size_t> start(blocks + 1, 0);  // each block's first particle
  const bool all_there = count_ == ids.size();
  if (!all_there) {
    for_blocks([&](std::size_t b, std::size_t first, std::size_t last) {
      for (std::size_t id_index = first; id_index < last; ++id_index)
        start[b + 1] += is_at(at[id_index], id_index) ? 1 : 0;
    });
  }
  for (std::size_t b = 0; b < blocks; ++b) start[b + 1] = all_there ? (b + 1) * kBlock : start[b] + start[b + 1];

  for_blocks([&](std::size_t b, std::size_t first, std::size_t last) {
    std::size_t k = start[b];
    for (std::size_t id_index = first; id_index < last; ++id_index) {
      if (!is_at(at[id_index], id_index)) continue;
      const Record& record = records[at[id_index]];
      if (out.id != nullptr) out.id[k] = ids[id_index];
      if (out.material != nullptr) out.material[k] = static_cast<std::uint16_t>(record.material);
      if (out.position != nullptr) out.position[k] = vec_cast<Out>(record.x);
      if (out.velocity != nullptr) out.velocity[k] = vec_cast<Out>(record.v);
      if (verlet() && out.acceleration != nullptr) out.acceleration[k] = vec_cast<Out>(acceleration[at[id_index]]);
      ++k;
    }
  });
}

template <class Real>
void ParticleState<Real>::reorder(std::span<const std::uint32_t> order) {
  HOOKE_ASSERT(order.size() >= count_ - noninteracting_count_, order.size(), count_, noninteracting_count_);
  slots.set_interacting(count_ - noninteracting_count_);
  ++changes_;
  forget_slots();
  permute(records, next, order);
  copy_ghosts(next, records);
  fill_unused(records);
  if (verlet()) {
    LargeVector<Vec3<Real>> scratch(acceleration.size());
    permute(acceleration, scratch, order);
  }
}

template <class Real>
std::size_t ParticleState<Real>::room_for_births(bool listed) const {
  constexpr double kMost = 1U << 21U;  // births ahead: more take a while
  double expected = 0;
  bool any = false;
  for (const Emitter& e : scene_->emitters) {
    if (scene_->materials[e.material].interacts != listed) continue;
    any = true;
    expected += expected_population(e, static_cast<double>(scene_->steps) * scene_->time_step);
  }
  if (!any) return 0;
  const std::size_t there = listed ? count_ - noninteracting_count_ : noninteracting_count_;
  const auto wanted = static_cast<std::size_t>(std::min(kMost, 1.1 * expected)) + kTile;
  return std::max(there / 2, wanted - std::min(wanted, there)) + kTile;
}

template <class Real>
bool ParticleState<Real>::has_room_for(const ParticleSet& newborn) const {
  std::size_t noninteracting = 0;
  for (const std::uint16_t m : newborn.material) noninteracting += scene_->materials[m].interacts ? 0 : 1;
  // Ids of removed particles stay in the table until it is mostly theirs.
  const bool many_gone = ids.size() + newborn.size() > 4 * count_ + 65536;
  return !many_gone && slots.has_room(newborn.size() - noninteracting, noninteracting);
}

template <class Real>
void ParticleState<Real>::find_slots() const {
  if (slot_of_id_index_.size() == ids.size()) return;
  slot_of_id_index_.assign(ids.size(), kNoSlot);
  parallel_ranges(slots.end(), kTile, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (!is_vacant(records[i])) slot_of_id_index_[id_index_of(records[i].id_index)] = static_cast<std::uint32_t>(i);
    }
  });
}

template <class Real>
void ParticleState<Real>::find_known_slots() const {
  find_slots();
  if (!slots.has_ghosts() || known_slot_of_id_index_.size() == ids.size()) return;
  known_slot_of_id_index_ = slot_of_id_index_;
  for (std::size_t i = slots.first_ghost(); i < slots.ghost_end(); ++i) {
    if (!is_vacant(records[i]))
      known_slot_of_id_index_[id_index_of(records[i].id_index)] = static_cast<std::uint32_t>(i);
  }
}

template <class Real>
std::size_t ParticleState<Real>::slot_of(std::uint64_t id) const {
  HOOKE_ASSERT(slot_of_id_index_.size() == ids.size(), slot_of_id_index_.size(), ids.size());
  const std::size_t id_index = ids.find(id);
  return id_index < ids.size() && is_at(slot_of_id_index_[id_index], id_index) ? slot_of_id_index_[id_index] : kNoSlot;
}

template <class Real>
void ParticleState<Real>::set(std::size_t slot, const Vec3d& position, const Vec3d& velocity) {
  Record& p = records[slot];
  HOOKE_ASSERT(!is_vacant(p), slot);
  p.x = vec_cast<Real>(position);
  p.v = vec_cast<Real>(velocity);
  wrap_periodic(rules_->view(), p.x);
}

template <class Real>
std::size_t ParticleState<Real>::add(std::size_t slot, const ParticleSet& newborn, std::size_t k) {
  ids.append(newborn.id[k]);
  const std::size_t id_index = ids.size() - 1;
  put(slot, id_index, newborn, k);
  if (slot_of_id_index_.size() == id_index) slot_of_id_index_.push_back(static_cast<std::uint32_t>(slot));
  if (verlet()) acceleration[slot] = {Real(0), Real(0), Real(0)};
  ++count_of_[newborn.material[k]];
  return id_index;
}

template <class Real>
void ParticleState<Real>::remove(std::size_t slot) {
  Record& p = records[slot];
  HOOKE_ASSERT(!is_vacant(p), slot);
  --count_of_[static_cast<std::size_t>(p.material)];
  ++changes_;
  p = vacant_record<Real>(p.id_index);
  slots.leave(slot);
}

template <class Real>
void ParticleState<Real>::recount() {
  count_ = noninteracting_count_ = 0;
  mass_ = {};
  for (std::size_t m = 0; m < count_of_.size(); ++m) {
    count_ += count_of_[m];
    if (!scene_->materials[m].interacts) noninteracting_count_ += count_of_[m];
    mass_.add_product(static_cast<double>(count_of_[m]), scene_->materials[m].mass);
  }
}

template <class Real>
std::uint64_t ParticleState<Real>::hash() const {
  std::atomic<std::uint64_t> hash{0};
  parallel_ranges(slots.end(), kTile, [&](std::size_t first, std::size_t last) {
    std::uint64_t sum = 0;
    for (std::size_t i = first; i < last; ++i) {
      const Record& p = records[i];
      if (!is_vacant(p)) sum += particle_hash(ids[id_index_of(p.id_index)], p.x, p.v);
    }
    hash += sum;
  });
  return hash;
}

template <class Real>
void ParticleState<Real>::put(std::size_t slot, std::size_t id_index, const ParticleSet& particles, std::size_t k) {
  records[slot] = record_of(particles, k, id_index);
}

template <class Real>
auto ParticleState<Real>::record_of(const ParticleSet& particles, std::size_t k, std::size_t id_index) const -> Record {
  Record record{vec_cast<Real>(particles.position[k]), static_cast<Real>(particles.material[k]),
                vec_cast<Real>(particles.velocity[k]), sort_key<Real>(static_cast<std::uint32_t>(id_index))};
  wrap_periodic(rules_->view(), record.x);  // a coordinate may have been rounded up to the upper face
  return record;
}

template <class Real>
void ParticleState<Real>::fill_unused(LargeVector<Record>& all) const {
  const auto fill = [&](std::size_t first, std::size_t last) {
    std::fill(all.begin() + static_cast<std::ptrdiff_t>(first), all.begin() + static_cast<std::ptrdiff_t>(last),
              vacant_record<Real>(Real(0)));
  };
  fill(slots.interacting_end(), slots.first_noninteracting());
  fill(slots.noninteracting_end(), slots.first_ghost());
  fill(slots.ghost_end(), all.size() - 1);
  all.back() = filler_record<Real>();
}

template <class Real>
void ParticleState<Real>::copy_ghosts(const LargeVector<Record>& from, LargeVector<Record>& to) const {
  const auto first = static_cast<std::ptrdiff_t>(slots.first_ghost());
  std::copy(from.begin() + first, from.begin() + static_cast<std::ptrdiff_t>(slots.ghost_end()), to.begin() + first);
}

template <class Real>
template <class T>
void ParticleState<Real>::permute(LargeVector<T>& column, LargeVector<T>& scratch,
                                  std::span<const std::uint32_t> order) const {
  parallel_ranges(slots.interacting_end(), kTile, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) scratch[i] = column[order[i]];
  });
  parallel_ranges(slots.noninteracting_end() - slots.first_noninteracting(), kTile,
                  [&](std::size_t first, std::size_t last) {
                    const auto at = [&](auto& of, std::size_t i) {
                      return of.begin() + static_cast<std::ptrdiff_t>(slots.first_noninteracting() + i);
                    };
                    std::copy(at(column, first), at(column, last), at(scratch, first));
                  });
  column.swap(scratch);
}

template class ParticleState<float>;
template class ParticleState<double>;
template void ParticleState<float>::download(const ParticleColumns<float>& out) const;
template void ParticleState<float>::download(const ParticleColumns<double>& out) const;
template void ParticleState<double>::download(const ParticleColumns<float>& out) const;
template void ParticleState<double>::download(const ParticleColumns<double>& out) const;

}  // namespace hooke
