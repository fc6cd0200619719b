// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// One rank's part of a scene's particles, and its ghosts (core/shared_particles.h).

#include <algorithm>
#include <cstring>

#include "hooke/backends/cpu/cpu_backend_impl.h"
#include "hooke/base/assert.h"
#include "hooke/base/bytes.h"

namespace hooke {
namespace {

// The parcel for a rank, among those begun; there are few.
std::vector<std::byte>& parcel_to(int rank, std::vector<Parcel>& out) {
  const auto begun = std::find_if(out.begin(), out.end(), [&](const Parcel& p) { return p.rank == rank; });
  return begun != out.end() ? begun->bytes : out.emplace_back(Parcel{rank, {}}).bytes;
}

// x and v, which change in every step: each is copied by itself, for a processor that has just written two numbers
// waits before it can load parts of both at once.
template <class Real>
constexpr std::size_t kMovingBytes = 2 * sizeof(Vec3<Real>);

// Records are far apart in memory: this many are on their way at the same time.
constexpr std::size_t kAhead = 64;

template <class Real>
void write_moving(const ParticleRecord<Real>& p, std::byte* to) {
  std::memcpy(to, &p.x, sizeof p.x);
  std::memcpy(to + sizeof p.x, &p.v, sizeof p.v);
}
template <class Real>
void read_moving(const std::byte* from, ParticleRecord<Real>& p) {
  std::memcpy(&p.x, from, sizeof p.x);
  std::memcpy(&p.v, from + sizeof p.x, sizeof p.v);
}

}  // namespace

template <class Real>
void CpuBackend<Real>::assign_part(const ParticleSet& own, std::span<const IdRun> all) {
  is_part_ = true;
  list_.share(true);
  particles_.place_part(own, all);
  forget_layout();
}

template <class Real>
void CpuBackend<Real>::sample(std::vector<WeightedPoint>& points) const {
  constexpr std::size_t kStride = 16;
  for (std::size_t i = 0; i < particles_.slots.end(); i += kStride) {
    if (!is_vacant(particles_.records[i])) points.push_back({vec_cast<double>(particles_.records[i].x), kStride});
  }
}

template <class Real>
void CpuBackend<Real>::move_out(const Decomposition& space, int here, std::vector<Parcel>& out) {
  particles_.put_ghosts({});
  copied_.clear();
  ghost_slots_.clear();
  std::mutex mutex;
  std::vector<std::uint32_t> leaving;
  for_ranges(particles_.slots.end(), kTile, [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> part;
    for (std::size_t i = first; i < last; ++i) {
      const Record& p = particles_.records[i];
      if (!is_vacant(p) && !space.owns(here, vec_cast<double>(p.x))) part.push_back(static_cast<std::uint32_t>(i));
    }
    const std::lock_guard lock(mutex);
    leaving.insert(leaving.end(), part.begin(), part.end());
  });
  for (const std::uint32_t i : leaving) {
    const int to = space.owner(vec_cast<double>(particles_.records[i].x));
    if (to == Decomposition::kNobody) continue;  // the list will say so
    append_bytes(parcel_to(to, out), particles_.traveller(i));
    particles_.remove(i);
  }
  particles_.forget_slots();
  particles_.recount();
}

template <class Real>
void CpuBackend<Real>::move_in(std::span<const Parcel> in) {
  std::vector<Traveller> arrivals;
  for (const Parcel& parcel : in) {
    const std::size_t before = arrivals.size(), count = parcel.bytes.size() / sizeof(Traveller);
    arrivals.resize(before + count);
    std::span<const std::byte> from = parcel.bytes;
    take_bytes(from, arrivals.data() + before, count);
  }
  particles_.take_in(arrivals);
  list_.invalidate();
  is_built_ = false;
}

template <class Real>
double CpuBackend<Real>::largest_radius() const {
  double largest = -1;
  for (std::size_t m = 0; m < rules_.material_count(); ++m) {
    if (rules_.interacts(m) && particles_.count_of(m) > 0) largest = std::max(largest, rules_.interaction_radius(m));
  }
  return largest;
}

template <class Real>
GhostWidth CpuBackend<Real>::next_width() {
  constexpr double kSlack = 0.5;  // of the smallest diameter
  return {list_.next_skin(), kSlack * 2 * rules_.smallest_touching()};
}

template <class Real>
std::vector<std::uint32_t> CpuBackend<Real>::wanted() const {
  std::vector<std::uint32_t> id_indices;
  threads_.run([&] { applied_.want_partners(particles_, id_indices); });
  return id_indices;
}

template <class Real>
void CpuBackend<Real>::copy_out(const GhostZones& zones, std::span<const WantedParticles> wanted,
                                std::vector<Parcel>& out) {
  const std::size_t ranks = zones.largest.size();
  std::vector<std::vector<std::uint32_t>> slots_for(ranks);
  const Box3d own_box = own_box_of(zones);
  list_.set_own_box(own_box);
  const double widest = *std::max_element(zones.largest.begin(), zones.largest.end());
  // Deep in its box, a particle is near to no other.
  const double deep =
      widest < 0 ? 0 : 1.001 * (rules_.largest_interaction_radius() + widest) + zones.width.skin + zones.width.slack;
  const auto is_deep = [&](const Vec3d& x) {
    for (int axis = 0; axis < 3; ++axis) {
      const double at = component(x, axis);
      if (!(at > component(own_box.min, axis) + deep && at < component(own_box.max, axis) - deep)) return false;
    }
    return true;
  };
  const std::size_t end = wants_all() ? particles_.slots.end() : particles_.slots.interacting_end();
  for (std::size_t i = 0; i < end; ++i) {
    const Record& p = particles_.records[i];
    const Vec3d x = vec_cast<double>(p.x);
    if (is_vacant(p) || (!wants_all() && is_deep(x))) continue;
    const double radius = rules_.interaction_radius(static_cast<std::size_t>(p.material));
    for (std::size_t k = 0; k < ranks; ++k) {
      const int rank = static_cast<int>(k);
      const bool near = zones.largest[k] >= 0 && zones.space->is_near(rank, x, zones.reach(rank, radius));
      if (rank != zones.here && (near || wants_all())) slots_for[k].push_back(static_cast<std::uint32_t>(i));
    }
  }
  if (!wanted.empty()) threads_.run([&] { particles_.find_slots(); });
  for (const WantedParticles& of_rank : wanted) {
    std::vector<std::uint32_t>& slots = slots_for[static_cast<std::size_t>(of_rank.rank)];
    const std::size_t near_count = slots.size();
    for (const std::uint32_t id_index : of_rank.id_indices) {
      const std::uint32_t slot = particles_.slots_by_id_index()[id_index];
      const auto near = std::span(slots).first(near_count);
      if (slot != particles_.kNoSlot && !std::binary_search(near.begin(), near.end(), slot)) slots.push_back(slot);
    }
  }
  for (std::size_t k = 0; k < ranks; ++k) {
    if (slots_for[k].empty()) continue;
    copied_.insert(copied_.end(), slots_for[k].begin(), slots_for[k].end());
    std::vector<Record> records;
    records.reserve(slots_for[k].size());
    for (const std::uint32_t i : slots_for[k]) records.push_back(particles_.records[i]);
    append_bytes(out.emplace_back(Parcel{static_cast<int>(k), {}}).bytes, records.data(), records.size());
  }
}

// Where a periodic axis ends, ghosts may follow from the other side.
template <class Real>
Box3d CpuBackend<Real>::own_box_of(const GhostZones& zones) const {
  Box3d box = zones.space->boxes[static_cast<std::size_t>(zones.here)];
  for (int axis = 0; axis < 3; ++axis) {
    if (!rules_.view().periodic[axis]) continue;
    component(box.min, axis) = std::max(component(box.min, axis), component(scene_.domain.min, axis));
    component(box.max, axis) = std::min(component(box.max, axis), component(scene_.domain.max, axis));
  }
  return box;
}

template <class Real>
void CpuBackend<Real>::take_ghosts(std::span<const Parcel> in) {
  std::vector<Record> ghosts;
  for (const Parcel& parcel : in) {
    const std::size_t before = ghosts.size(), count = parcel.bytes.size() / sizeof(Record);
    ghosts.resize(before + count);
    std::span<const std::byte> from = parcel.bytes;
    take_bytes(from, ghosts.data() + before, count);
  }
  particles_.put_ghosts(ghosts);
  ghost_slots_.resize(ghosts.size());
  for (std::size_t k = 0; k < ghosts.size(); ++k)
    ghost_slots_[k] = static_cast<std::uint32_t>(particles_.slots.first_ghost() + k);
  applied_.bind_pinned(particles_);
}

template <class Real>
std::size_t CpuBackend<Real>::copy_bytes() const {
  return sizeof(Record);
}

template <class Real>
std::size_t CpuBackend<Real>::packed_bytes() const {
  return kMovingBytes<Real>;
}

template <class Real>
void CpuBackend<Real>::pack(std::span<std::byte> out) const {
  HOOKE_ASSERT(out.size() == copied_.size() * kMovingBytes<Real>, out.size(), copied_.size());
  for_ranges(copied_.size(), kTile, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      if (k + kAhead < last) __builtin_prefetch(&particles_.records[copied_[k + kAhead]]);
      write_moving(particles_.records[copied_[k]], out.data() + k * kMovingBytes<Real>);
    }
  });
}

template <class Real>
void CpuBackend<Real>::unpack(std::span<const std::byte> in) {
  HOOKE_ASSERT(in.size() == ghost_slots_.size() * kMovingBytes<Real>, in.size(), ghost_slots_.size());
  for_ranges(ghost_slots_.size(), kTile, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      if (k + kAhead < last) __builtin_prefetch(&particles_.records[ghost_slots_[k + kAhead]], 1);
      const std::size_t slot = ghost_slots_[k];
      if (is_vacant(particles_.records[slot])) continue;
      const std::byte* const moving = in.data() + k * kMovingBytes<Real>;
      read_moving(moving, particles_.records[slot]);
      // Its pass swaps buffers, and moves nobody.
      if (verlet()) read_moving(moving, particles_.next[slot]);
    }
  });
}

template <class Real>
FrameDisplacements CpuBackend<Real>::displacements() const {
  FrameDisplacements displacements;
  const Box3d box = list_.frame_displacements();
  if (box.is_none()) return displacements;
  for (int axis = 0; axis < 3; ++axis) {
    displacements.most[axis] = component(box.max, axis);
    displacements.most[axis + 3] = -component(box.min, axis);
  }
  return displacements;
}

// Beside the common displacement, what is near its frame has moved by half a skin and half a slack at most. What has
// moved further may touch what is now within that of another rank's moved box.
template <class Real>
bool CpuBackend<Real>::has_lost_outlier(const GhostZones& zones, const Vec3d& common) const {
  const double most = zones.width.skin + zones.width.slack, tame = 0.49 * most;
  for (const std::uint32_t i : list_.outliers()) {
    const Record& p = particles_.records[i];
    if (i >= particles_.slots.interacting_end() || is_vacant(p)) continue;
    const Vec3d strayed = vec_cast<double>(list_.moved_by(p, i)) - common;
    if (dot(strayed, strayed) < tame * tame) continue;
    const Vec3d at = vec_cast<double>(p.x) - common;
    const double radius = rules_.interaction_radius(static_cast<std::size_t>(p.material));
    for (int rank = 0; rank < static_cast<int>(zones.largest.size()); ++rank) {
      if (rank == zones.here) continue;
      const double largest = std::max(0.0, zones.largest[static_cast<std::size_t>(rank)]);
      if (zones.space->is_near(rank, at, 1.001 * (radius + largest) + 0.51 * most)) return true;
    }
  }
  return false;
}

template <class Real>
bool CpuBackend<Real>::has_departures() const {
  return !leaving_.slots.empty();
}

template <class Real>
RemovalSums CpuBackend<Real>::insert_part(const ParticleSet& newborn, const Decomposition& space, int here) {
  RemovalSums born;
  std::vector<Traveller> own;
  for (std::size_t k = 0; k < newborn.size(); ++k) {
    particles_.ids.append(newborn.id[k]);
    if (std::max(space.owner(newborn.position[k]), 0) != here) continue;
    own.push_back({particles_.record_of(newborn, k, particles_.ids.size() - 1), {Real(0), Real(0), Real(0)}});
    const Record& p = own.back().record;
    born.add_particle(particles_.material_of(p).mass, vec_cast<double>(p.x), vec_cast<double>(p.v), scene_.gravity);
  }
  const bool touching = std::any_of(own.begin(), own.end(),
                                    [&](const Traveller& t) { return particles_.material_of(t.record).interacts; });
  const bool moved = particles_.take_in(own);
  if (moved || touching) list_.invalidate();
  if (moved) {
    is_built_ = false;
    copied_.clear();
    ghost_slots_.clear();
  }
  applied_.grow(particles_.ids.size());
  applied_.bind_pinned(particles_);
  return born;
}

template <class Real>
void CpuBackend<Real>::add_elastic_of(std::span<const std::uint64_t> ids, ExactSum& sum) {
  threads_.run([&] { particles_.find_slots(); });
  std::vector<std::uint32_t> slots;
  for (const std::uint64_t id : ids) {
    const std::size_t slot = particles_.slot_of(id);
    if (slot != particles_.kNoSlot) slots.push_back(static_cast<std::uint32_t>(slot));
  }
  leaving_ghosts_ = ghosts_of(ids);
  add_elastic(slots, sum);
  leaving_ghosts_.clear();
}

// The slots of the ghosts of these ids, ascending.
template <class Real>
std::vector<std::uint32_t> CpuBackend<Real>::ghosts_of(std::span<const std::uint64_t> ids) const {
  std::vector<std::uint64_t> sorted(ids.begin(), ids.end());
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint32_t> slots;
  for (std::size_t i = particles_.slots.first_ghost(); i < particles_.slots.ghost_end(); ++i) {
    const Record& p = particles_.records[i];
    if (is_vacant(p)) continue;
    if (std::binary_search(sorted.begin(), sorted.end(), particles_.ids[id_index_of(p.id_index)]))
      slots.push_back(static_cast<std::uint32_t>(i));
  }
  return slots;
}

// Ghosts leave when the particles do that they are copies of.
template <class Real>
void CpuBackend<Real>::follow_ghosts() {
  leaving_ghosts_.clear();
  const RulesView<Real>& rules = rules_.view();
  const bool any_open = has_open_face();
  for (std::size_t i = particles_.slots.first_ghost(); any_open && i < particles_.slots.ghost_end(); ++i) {
    const Record& p = particles_.records[i];
    if (is_vacant(p) || !is_outside_open_face(rules, p.x)) continue;
    if (!particles_.material_of(p).fixed && !applied_.pins(id_index_of(p.id_index)))
      leaving_ghosts_.push_back(static_cast<std::uint32_t>(i));
  }
  list_.note_far_ghosts(particles_.records.data());
}

template <class Real>
void CpuBackend<Real>::find_departures() {
  leaving_ = {};
  if (!is_built_ || !has_open_face()) return;
  for_ranges(particles_.slots.end(), kTile, [&](std::size_t first, std::size_t last) {
    Departures part;
    for (std::size_t i = first; i < last; ++i) {
      const Record& p = particles_.records[i];
      if (is_vacant(p) || !is_outside_open_face(rules_.view(), p.x) || applied_.pinned().holds(i)) continue;
      leave(p, i, p.v, part);
    }
    collect(leaving_, part);
  });
  follow_ghosts();
}

template <class Real>
bool CpuBackend<Real>::has_open_face() const {
  const auto& boundary = scene_.domain.boundary;
  return std::find(boundary.begin(), boundary.end(), Boundary::open) != boundary.end();
}

// Particles have been sorted: `order` has the former slot of each, relative to `first`. Copied particles and ghosts
// keep their places in messages.
template <class Real>
void CpuBackend<Real>::renumber(std::vector<std::uint32_t>& slots, std::size_t first,
                                std::span<const std::uint32_t> order) {
  if (slots.empty()) return;
  std::vector<std::uint32_t> now(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) now[order[k]] = static_cast<std::uint32_t>(first + k);
  for (std::uint32_t& slot : slots) {
    if (slot - first < now.size()) slot = now[slot - first];
  }
}

template void CpuBackend<float>::assign_part(const ParticleSet& own, std::span<const IdRun> all);
template void CpuBackend<double>::assign_part(const ParticleSet& own, std::span<const IdRun> all);
template void CpuBackend<float>::sample(std::vector<WeightedPoint>& points) const;
template void CpuBackend<double>::sample(std::vector<WeightedPoint>& points) const;
template void CpuBackend<float>::move_out(const Decomposition& space, int here, std::vector<Parcel>& out);
template void CpuBackend<double>::move_out(const Decomposition& space, int here, std::vector<Parcel>& out);
template void CpuBackend<float>::move_in(std::span<const Parcel> in);
template void CpuBackend<double>::move_in(std::span<const Parcel> in);
template double CpuBackend<float>::largest_radius() const;
template double CpuBackend<double>::largest_radius() const;
template GhostWidth CpuBackend<float>::next_width();
template GhostWidth CpuBackend<double>::next_width();
template std::vector<std::uint32_t> CpuBackend<float>::wanted() const;
template void CpuBackend<float>::copy_out(const GhostZones& zones, std::span<const WantedParticles> wanted,
                                          std::vector<Parcel>& out);
template Box3d CpuBackend<float>::own_box_of(const GhostZones& zones) const;
template std::vector<std::uint32_t> CpuBackend<double>::wanted() const;
template void CpuBackend<double>::copy_out(const GhostZones& zones, std::span<const WantedParticles> wanted,
                                           std::vector<Parcel>& out);
template Box3d CpuBackend<double>::own_box_of(const GhostZones& zones) const;
template void CpuBackend<float>::take_ghosts(std::span<const Parcel> in);
template void CpuBackend<double>::take_ghosts(std::span<const Parcel> in);
template std::size_t CpuBackend<float>::copy_bytes() const;
template std::size_t CpuBackend<double>::copy_bytes() const;
template std::size_t CpuBackend<float>::packed_bytes() const;
template std::size_t CpuBackend<double>::packed_bytes() const;
template void CpuBackend<float>::pack(std::span<std::byte> out) const;
template void CpuBackend<double>::pack(std::span<std::byte> out) const;
template void CpuBackend<float>::unpack(std::span<const std::byte> in);
template void CpuBackend<double>::unpack(std::span<const std::byte> in);
template FrameDisplacements CpuBackend<float>::displacements() const;
template FrameDisplacements CpuBackend<double>::displacements() const;
template bool CpuBackend<float>::has_lost_outlier(const GhostZones& zones, const Vec3d& common) const;
template bool CpuBackend<double>::has_lost_outlier(const GhostZones& zones, const Vec3d& common) const;
template bool CpuBackend<float>::has_departures() const;
template bool CpuBackend<double>::has_departures() const;
template RemovalSums CpuBackend<float>::insert_part(const ParticleSet& newborn, const Decomposition& space, int here);
template void CpuBackend<float>::add_elastic_of(std::span<const std::uint64_t> ids, ExactSum& sum);
template std::vector<std::uint32_t> CpuBackend<float>::ghosts_of(std::span<const std::uint64_t> ids) const;
template RemovalSums CpuBackend<double>::insert_part(const ParticleSet& newborn, const Decomposition& space, int here);
template void CpuBackend<double>::add_elastic_of(std::span<const std::uint64_t> ids, ExactSum& sum);
template std::vector<std::uint32_t> CpuBackend<double>::ghosts_of(std::span<const std::uint64_t> ids) const;
template void CpuBackend<float>::follow_ghosts();
template void CpuBackend<double>::follow_ghosts();
template void CpuBackend<float>::find_departures();
template bool CpuBackend<float>::has_open_face() const;
template void CpuBackend<double>::find_departures();
template bool CpuBackend<double>::has_open_face() const;
template void CpuBackend<float>::renumber(std::vector<std::uint32_t>& slots, std::size_t first,
                                          std::span<const std::uint32_t> order);
template void CpuBackend<double>::renumber(std::vector<std::uint32_t>& slots, std::size_t first,
                                           std::span<const std::uint32_t> order);

}  // namespace hooke
