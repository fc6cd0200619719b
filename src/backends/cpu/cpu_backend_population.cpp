// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/cpu_backend_impl.h"

#include <algorithm>

#include "hooke/base/assert.h"
#include "hooke/core/sums.h"
#include "hooke/passes/contact_reports.h"
#include "hooke/physics/integrate.h"

namespace hooke {

template <class Real>
std::optional<ParticleAt> CpuBackend<Real>::find(std::uint64_t id) const {
  threads_.run([&] { particles_.find_slots(); });
  const std::size_t slot = particles_.slot_of(id);
  if (slot == particles_.kNoSlot) return std::nullopt;
  const Record& p = particles_.records[slot];
  return ParticleAt{id, static_cast<std::size_t>(p.material), vec_cast<double>(p.x), vec_cast<double>(p.v)};
}

template <class Real>
void CpuBackend<Real>::edit(std::span<const ParticleAt> edited) {
  threads_.run([&] { particles_.find_slots(); });
  for (const ParticleAt& to : edited) {
    const std::size_t slot = particles_.slot_of(to.id);
    HOOKE_ASSERT(slot != particles_.kNoSlot, to.id);
    const Vec3<Real> before = particles_.records[slot].x;
    particles_.set(slot, to.position, to.velocity);
    if (!particles_.slots.is_noninteracting(slot) && particles_.records[slot].x != before) list_.note_moved(slot);
  }
}

template <class Real>
std::optional<std::uint64_t> CpuBackend<Real>::set_external_forces(std::span<const std::uint64_t> ids,
                                                                   std::span<const Vec3d> forces) {
  HOOKE_ASSERT(ids.size() == forces.size(), ids.size(), forces.size());
  std::optional<std::uint64_t> unknown;
  threads_.run([&] {
    particles_.find_slots();
    unknown = applied_.set_external(particles_, ids, forces);
  });
  return unknown;
}

template <class Real>
RemovalSums CpuBackend<Real>::insert(const ParticleSet& newborn) {
  RemovalSums born;
  if (newborn.empty()) return born;
  if (!particles_.has_room_for(newborn)) make_room(newborn.size() + particles_.count() / 16 + 256);
  std::vector<std::uint32_t> touching;
  for (std::size_t k = 0; k < newborn.size(); ++k) {
    const Material& m = scene_.materials[newborn.material[k]];
    const std::size_t slot = !m.interacts
                                 ? particles_.slots.take_noninteracting()
                                 : particles_.slots.take_interacting(list_.is_valid() ? list_.first_free() : 0);
    const std::size_t id_index = particles_.add(slot, newborn, k);
    applied_.add(particles_, slot, m.fixed);
    if (m.interacts) {
      list_.add(slot, static_cast<std::uint32_t>(id_index));
      touching.push_back(static_cast<std::uint32_t>(slot));
    }
    born.add_particle(m.mass, vec_cast<double>(particles_.records[slot].x),
                      vec_cast<double>(particles_.records[slot].v), scene_.gravity);
  }
  particles_.recount();
  // Newborn particles overlap no other, but cohesion may reach them.
  if (rules_.widest_range() > 0) add_elastic(touching, born.elastic);
  return born;
}

template <class Real>
Removal CpuBackend<Real>::remove(std::span<const std::uint64_t> ids) {
  Removal removal;
  removal.was_there.assign(ids.size(), 0);
  if (ids.empty()) return removal;
  threads_.run([&] { particles_.find_slots(); });
  Departures removed;
  for_ranges(ids.size(), 256, [&](std::size_t first, std::size_t last) {
    Departures part;
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t slot = particles_.slot_of(ids[k]);
      if (slot == particles_.kNoSlot) continue;
      removal.was_there[k] = 1;
      leave_at_end_of_step(slot, part);
    }
    collect(removed, part);
  });
  if (is_part_) leaving_ghosts_ = ghosts_of(ids);
  removal.sums = let_go(removed);
  return removal;
}

template <class Real>
RemovalSums CpuBackend<Real>::remove_sunk() {
  Departures sunk;
  for_ranges(particles_.slots.end(), kTile, [&](std::size_t first, std::size_t last) {
    Departures part;
    for (std::size_t i = first; i < last; ++i) {
      if (!is_vacant(particles_.records[i]) && sinks_.take(vec_cast<double>(particles_.records[i].x)))
        leave_at_end_of_step(i, part);
    }
    collect(sunk, part);
  });
  for (std::size_t i = particles_.slots.first_ghost(); i < particles_.slots.ghost_end(); ++i) {
    const Record& p = particles_.records[i];
    if (!is_vacant(p) && sinks_.take(vec_cast<double>(p.x))) leaving_ghosts_.push_back(static_cast<std::uint32_t>(i));
  }
  return let_go(sunk);
}

template <class Real>
void CpuBackend<Real>::find_inside(const Box3d& box, std::vector<Occupant>& out) const {
  for_ranges(particles_.slots.interacting_end(), kTile, [&](std::size_t first, std::size_t last) {
    std::vector<Occupant> found;
    for (std::size_t i = first; i < last; ++i) {
      const Record& p = particles_.records[i];
      const Vec3d x = vec_cast<double>(p.x);
      if (!is_vacant(p) && box.contains(x)) found.push_back({x, particles_.material_of(p).radius});
    }
    const std::lock_guard lock(mutex_);
    out.insert(out.end(), found.begin(), found.end());
  });
}

template <class Real>
void CpuBackend<Real>::make_room(std::size_t births) {
  ParticleSet all;
  hooke::download(*this, scene_.integrator, all);
  take(all, births);
}

// Under velocity Verlet, with the velocity after the coming half kick.
template <class Real>
void CpuBackend<Real>::leave_at_end_of_step(std::size_t slot, Departures& left) const {
  const Record& p = particles_.records[slot];
  leave(p, slot, verlet() ? kick(p.v, particles_.acceleration[slot], Real(0.5) * rules_.view().dt) : p.v, left);
}

template <class Real>
void CpuBackend<Real>::collect(Departures& total, const Departures& part) const {
  if (part.slots.empty()) return;
  const std::lock_guard lock(mutex_);
  total.add(part);
}

// Makes the slots of leaving particles vacant, and returns what the particles carry.
template <class Real>
RemovalSums CpuBackend<Real>::let_go(Departures& leaving) {
  if (!leaving.slots.empty()) {
    add_elastic(leaving.slots, leaving.sums.elastic);
    for (const std::uint32_t slot : leaving.slots) particles_.remove(slot);
    particles_.recount();
  }
  for (const std::uint32_t slot : leaving_ghosts_) particles_.remove_ghost(slot);
  leaving_ghosts_.clear();
  return leaving.sums;
}

// Adds the energy of the contacts and springs that end at one of these particles. Needs a valid list; if it must
// rebuild the list, `slots` is updated to the particles' new indices.
template <class Real>
void CpuBackend<Real>::add_elastic(std::vector<std::uint32_t>& slots, ExactSum& sum) {
  const auto is_listed = [&](std::uint32_t slot) { return !particles_.slots.is_noninteracting(slot); };
  if (applied_.springs().empty() && std::none_of(slots.begin(), slots.end(), is_listed)) return;
  // Ranks build together: each has a list of where its particles are now, or has failed.
  const bool stale = neighbours_stale();
  if (is_part_ ? !is_built_ : stale && !rebuild_under(slots)) return;
  if (!applied_.springs().empty()) threads_.run([&] { particles_.find_known_slots(); });
  std::sort(slots.begin(), slots.end());
  std::vector<std::uint32_t> among = slots;
  among.insert(among.end(), leaving_ghosts_.begin(), leaving_ghosts_.end());  // behind all own ones, ascending
  for_ranges(slots.size(), 64, [&](std::size_t first, std::size_t last) {
    const ContactScan<Real> scan = contact_scan();
    ExactSum part;
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t i = slots[k];
      add_contact_energy(scan, i, rows_of(i / kTile, i % kTile / kLanes), among, part);
      applied_.add_spring_energy(particles_, i, among, part);
    }
    const std::lock_guard lock(mutex_);
    sum.add(part);
  });
}

// Builds a list, and updates `slots` to the particles' new indices. Returns whether there is a list.
template <class Real>
bool CpuBackend<Real>::rebuild_under(std::vector<std::uint32_t>& slots) {
  std::vector<std::uint32_t> id_indices;
  for (const std::uint32_t slot : slots) id_indices.push_back(id_index_of(particles_.records[slot].id_index));
  std::sort(id_indices.begin(), id_indices.end());
  if (!build_neighbours().good()) return false;
  slots.clear();
  for (std::size_t i = 0; i < particles_.slots.end(); ++i) {
    if (!is_vacant(particles_.records[i]) &&
        std::binary_search(id_indices.begin(), id_indices.end(), id_index_of(particles_.records[i].id_index))) {
      slots.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return true;
}

template std::optional<ParticleAt> CpuBackend<float>::find(std::uint64_t id) const;
template std::optional<ParticleAt> CpuBackend<double>::find(std::uint64_t id) const;
template void CpuBackend<float>::edit(std::span<const ParticleAt> edited);
template void CpuBackend<double>::edit(std::span<const ParticleAt> edited);
template std::optional<std::uint64_t> CpuBackend<float>::set_external_forces(std::span<const std::uint64_t> ids,
                                                                             std::span<const Vec3d> forces);
template std::optional<std::uint64_t> CpuBackend<double>::set_external_forces(std::span<const std::uint64_t> ids,
                                                                              std::span<const Vec3d> forces);
template RemovalSums CpuBackend<float>::insert(const ParticleSet& newborn);
template RemovalSums CpuBackend<double>::insert(const ParticleSet& newborn);
template Removal CpuBackend<float>::remove(std::span<const std::uint64_t> ids);
template Removal CpuBackend<double>::remove(std::span<const std::uint64_t> ids);
template RemovalSums CpuBackend<float>::remove_sunk();
template RemovalSums CpuBackend<double>::remove_sunk();
template void CpuBackend<float>::find_inside(const Box3d& box, std::vector<Occupant>& out) const;
template void CpuBackend<double>::find_inside(const Box3d& box, std::vector<Occupant>& out) const;
template void CpuBackend<float>::collect(Departures& total, const Departures& part) const;
template void CpuBackend<double>::collect(Departures& total, const Departures& part) const;
template RemovalSums CpuBackend<float>::let_go(Departures& leaving);
template RemovalSums CpuBackend<double>::let_go(Departures& leaving);

}  // namespace hooke
