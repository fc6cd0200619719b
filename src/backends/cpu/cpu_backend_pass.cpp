// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/cpu_backend_impl.h"

#include <algorithm>
#include <optional>

#include "hooke/base/stopwatch.h"
#include "hooke/passes/contact_reports.h"

namespace hooke {

template <class Real>
void CpuBackend<Real>::apply_forces(const Instant& now, StepReport& report) {
  const Stopwatch forcing(times_.force);
  place_at(now);
  apply_others(true, report);
  const TilePass<Real> pass = make_pass(verlet() ? particles_.acceleration.data() : nullptr);
  run_pass(pass, report, [&](std::size_t s, const TileReport& tile) {
    std::optional<Departures> left;  // large, and seldom needed
    Condition found;
    for (std::size_t g = 0; g < kSlices; ++g) {
      if (tile.far[g] != 0) list_.note_far(s * kSlices + g, tile.far[g]);
      if (tile.notes[g] == 0) continue;
      if ((tile.notes[g] & kTooFast) != 0) found = Condition::first(found, check_contacts(s, g, now.moved));
      if ((tile.notes[g] & kLeftDomain) != 0) {
        if (!left) left.emplace();
        apply_boundaries_to_slice(s, g, *left);
      }
    }
    if (left) collect(leaving_, *left);
    if (found.good()) return;
    const std::lock_guard lock(mutex_);
    report.condition = Condition::first(report.condition, found);
  });
  particles_.records.swap(particles_.next);
}

template <class Real>
void CpuBackend<Real>::evaluate_accelerations(const Instant& now, StepReport& report) {
  place_at(now);
  apply_others(false, report);
  run_pass(make_pass(particles_.acceleration.data()), report, [](std::size_t, const TileReport&) {});
}

template <class Real>
void CpuBackend<Real>::place_at(const Instant& now) {
  applied_.set_time(now.time);
  if (scene_.colliders.empty()) return;
  colliders_ = place_colliders<Real>(scene_, now.poses, rules_.largest_body_distance());
}

template <class Real>
TilePass<Real> CpuBackend<Real>::make_pass(Vec3<Real>* acceleration) {
  return {
      {rules_.constants(),
       colliders_.view(),
       {particles_.records.data(), particles_.next.data(), acceleration, applied_.forces(), applied_.pinned().lanes()}},
      {list_.position_at_build(), list_.frames(), list_.next_step()}};
}

// Sums the forces that the pass adds. Pairs whose spring broke may touch from the next step on.
template <class Real>
void CpuBackend<Real>::apply_others(bool may_tear, StepReport& report) {
  if (applied_.none()) return;
  report.applied.emplace();
  threads_.run([&] { list_.release(applied_.apply(particles_, may_tear, report.applied->springs)); });
}

template <class Real>
void CpuBackend<Real>::finish_tile(std::size_t s, Vec3<Real>* acceleration, AppliedSums& sums) {
  applied_.finish(s * kTile, particles_.slots.end_of(s), particles_.records.data(), particles_.next.data(),
                  acceleration, sums);
}

template <class Real>
void CpuBackend<Real>::run_tile(const TilePass<Real>& pass, std::size_t s, TileReport& report) const {
  const std::size_t slices = (particles_.slots.end_of(s) - s * kTile + kLanes - 1) / kLanes;
  report.clear();
  if (particles_.slots.is_noninteracting(s * kTile)) return run_slices(pass, s, 0, slices, nullptr, nullptr, report);
  for (std::size_t g = 0; g < slices;) {
    std::size_t end = g + 1;
    if (list_.is_patched(s, g)) {
      const auto rows = list_.rows(s, g);
      const std::uint32_t first_row[2] = {0, static_cast<std::uint32_t>(rows.size() / kLanes)};
      run_slices(pass, s, g, end, rows.data(), first_row, report);
    } else {
      while (end < slices && !list_.is_patched(s, end)) ++end;
      run_slices(pass, s, g, end, list_.tile(s).entries, list_.tile(s).first_row.data() + g, report);
    }
    g = end;
  }
}

template <class Real>
void CpuBackend<Real>::run_slices(const TilePass<Real>& pass, std::size_t s, std::size_t g, std::size_t end,
                                  const std::uint32_t* rows, const std::uint32_t* first_row, TileReport& report) const {
  TileWork<Real> work;
  work.first = s * kTile + g * kLanes;
  work.slice_count = end - g;
  work.alone = rows == nullptr;
  work.rows = rows;
  work.first_row = first_row;
  work.notes = report.notes.data() + g;
  work.far = report.far.data() + g;
  work.sums = report.sums.data();
  loops_.force_pass(pass, work);
}

// The slice's first contact that was too fast, if there is one.
template <class Real>
Condition CpuBackend<Real>::check_contacts(std::size_t s, std::size_t g, bool moved) const {
  const ContactScan<Real> scan = contact_scan();
  const auto rows = rows_of(s, g);
  Condition found;
  const std::size_t first = s * kTile + g * kLanes;
  for (std::size_t i = first; i < std::min(first + kLanes, particles_.slots.end_of(s)); ++i) {
    if (!is_vacant(particles_.records[i])) {
      found = Condition::first(
          found, contact_too_fast(scan, i, rows, particles_.records.data(), scene_, particles_.ids, moved));
    }
  }
  return found;
}

template <class Real>
void CpuBackend<Real>::apply_boundaries_to_slice(std::size_t s, std::size_t g, Departures& left) {
  const std::size_t first = s * kTile + g * kLanes;
  for (std::size_t i = first; i < std::min(first + kLanes, particles_.slots.end_of(s)); ++i) {
    if (!is_vacant(particles_.next[i])) apply_boundaries(particles_.next[i], i, left);
  }
}

// Runs all tiles and adds their sums; calls look(s, report) after each tile s.
template <class Real>
template <class Look>
void CpuBackend<Real>::run_pass(const TilePass<Real>& pass, StepReport& total, const Look& look) {
  for_ranges(particles_.slots.tile_count(), 1, [&](std::size_t first, std::size_t last) {
    TileReport report;
    StepSums part;
    std::optional<AppliedSums> applied_part;  // large, and most scenes need none
    if (total.applied) applied_part.emplace();
    for (std::size_t n = first; n < last; ++n) {
      const std::size_t s = particles_.slots.tile(n);
      run_tile(pass, s, report);
      report.add_to(part);
      if (applied_part) finish_tile(s, pass.forces.buffers.acceleration, *applied_part);
      look(s, report);
    }
    const std::lock_guard lock(mutex_);
    total.sums.add(part);
    if (applied_part) total.applied->add(*applied_part);
  });
  total.mass = particles_.mass();
}

template void CpuBackend<float>::apply_forces(const Instant& now, StepReport& report);
template void CpuBackend<double>::apply_forces(const Instant& now, StepReport& report);
template void CpuBackend<float>::evaluate_accelerations(const Instant& now, StepReport& report);
template void CpuBackend<double>::evaluate_accelerations(const Instant& now, StepReport& report);
template void CpuBackend<float>::place_at(const Instant& now);
template void CpuBackend<double>::place_at(const Instant& now);

}  // namespace hooke
