// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "hooke/backends/cpu/bounding_box.h"
#include "hooke/backends/cpu/cpu_backend_impl.h"
#include "hooke/base/stopwatch.h"
#include "hooke/physics/integrate.h"

namespace hooke {

template <class Real>
void CpuBackend<Real>::half_kick_and_drift() {
  const Stopwatch drifting(times_.drift);
  const Real dt = rules_.view().dt;
  for_ranges(particles_.slots.end(), kTile, [&](std::size_t first, std::size_t last) {
    Departures left;
    for (std::size_t start = first; start < last; start += kLanes) {
      unsigned far = 0;
      for (std::size_t i = start; i < std::min(start + kLanes, last); ++i) {
        Record& p = particles_.records[i];
        if (is_vacant(p)) continue;
        const bool pinned = applied_.pinned().holds(i);
        if (!pinned) {
          p.v = kick(p.v, particles_.acceleration[i], Real(0.5) * dt);
          p.x = drift(p.x, p.v, dt);
        }
        if (list_.is_valid() && !particles_.slots.is_noninteracting(i) && list_.is_far(p, i))
          far |= 1U << i % kLanes;  // checked for all: a removal must not hide a NaN
        if (!pinned) apply_boundaries(p, i, left);
      }
      if (far != 0) list_.note_far(start / kLanes, far);
    }
    collect(leaving_, left);
  });
}

template <class Real>
void CpuBackend<Real>::remove_departed(RemovalSums& left) {
  left.add(let_go(leaving_));
  leaving_ = {};
}

template <class Real>
bool CpuBackend<Real>::neighbours_stale() {
  threads_.run([&] { list_.patch_if_due(particles_.records.data()); });
  return !list_.is_valid();
}

template <class Real>
Condition CpuBackend<Real>::build_neighbours() {
  Condition condition;
  threads_.run([&] {
    condition = sort_by_cell();
    if (!condition.good()) return;
    if (is_part_) sort_ghosts_by_cell();
    lay_out_structure();
    list_neighbours();
  });
  if (!is_part_) return condition;
  is_built_ = condition.good();
  leaving_ = {};  // their slots have changed: find_departures()
  leaving_ghosts_.clear();
  return condition;
}

template <class Real>
Condition CpuBackend<Real>::sort_by_cell() {
  const Stopwatch sorting(times_.sort);
  Box3d box;
  Condition condition = bounding_box(
      particles_.records.data(), particles_.slots.interacting_end(), particles_.ids, [](const Record&) { return true; },
      box);
  if (is_part_) {
    Box3d of_ghosts;
    const std::size_t first = particles_.slots.first_ghost();
    condition = Condition::first(
        condition, bounding_box(
                       particles_.records.data() + first, particles_.slots.ghost_end() - first, particles_.ids,
                       [&](const Record& p) { return particles_.material_of(p).interacts; }, of_ghosts));
    box.add(of_ghosts);
  }
  if (!condition.good()) return condition;
  const bool empty = box.is_none();
  for (int axis = 0; axis < 3; ++axis) {
    if (!empty && !rules_.view().periodic[axis]) continue;
    component(box.min, axis) = component(rules_.view().min, axis);
    component(box.max, axis) = component(rules_.view().max, axis);
  }
  const std::span<const std::uint32_t> order =
      list_.sort(particles_.records.data(), particles_.slots.interacting_end(), box, particles_.scratch());
  particles_.reorder(order);
  renumber(copied_, 0, order);
  return {};
}

template <class Real>
void CpuBackend<Real>::sort_ghosts_by_cell() {
  const Stopwatch sorting(times_.sort);
  const std::size_t first = particles_.slots.first_ghost();
  const std::span<const std::uint32_t> order =
      list_.sort_ghosts(particles_.records.data(), first, particles_.slots.ghost_end());
  particles_.reorder_ghosts(order);
  renumber(ghost_slots_, first, order);
}

template <class Real>
void CpuBackend<Real>::list_neighbours() {
  const Stopwatch listing(times_.list);
  const std::size_t count = particles_.slots.interacting_end();
  const bool births = particles_.room_for_births(true) > 0;
  const std::size_t end = births ? std::min(particles_.slots.first_noninteracting(), count + count / 16 + 256) : count;
  list_.build(particles_.records.data(), count, end / kLanes * kLanes, particles_.records.size(), particles_.scratch());
  particles_.end_scratch();
}

template <class Real>
void CpuBackend<Real>::follow_motion() {
  const Stopwatch following(times_.motion);
  if (is_part_) follow_ghosts();
  threads_.run([&] { list_.moved(particles_.records.data()); });
  if (check_list_ && list_.is_valid()) missed_contacts_ += list_.count_missed(particles_.records.data());
}

template <class Real>
void CpuBackend<Real>::lay_out_structure() {
  particles_.slots.recycle();
  if (!applied_.needs_layout()) return;
  const Stopwatch sorting(times_.sort);
  applied_.lay_out(particles_);
}

template void CpuBackend<float>::half_kick_and_drift();
template void CpuBackend<double>::half_kick_and_drift();
template bool CpuBackend<float>::neighbours_stale();
template bool CpuBackend<double>::neighbours_stale();
template Condition CpuBackend<float>::build_neighbours();
template Condition CpuBackend<double>::build_neighbours();
template void CpuBackend<float>::follow_motion();
template void CpuBackend<double>::follow_motion();
template void CpuBackend<float>::remove_departed(RemovalSums& left);
template void CpuBackend<double>::remove_departed(RemovalSums& left);

}  // namespace hooke
