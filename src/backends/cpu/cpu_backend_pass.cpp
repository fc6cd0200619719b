// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/cpu_backend_impl.h"

#include <algorithm>
#include <optional>

#include "hooke/backends/cpu/contact_reports.h"
#include "hooke/base/huge_pages.h"
#include "hooke/base/stopwatch.h"

namespace hooke {

template <class Real>
void CpuBackend<Real>::apply_forces(const Instant& now, StepReport& report) {
  const Stopwatch forcing(times_.force);
  place_at(now);
  aim_pass(verlet() ? particles_.acceleration.data() : nullptr);
  apply_others(true, report);
  run_pass(report, [&](std::size_t s, const TileReport& tile) {
    std::optional<Departures> left;  // large, and seldom of use
    Condition found;
    for (std::size_t g = 0; g < kGroups; ++g) {
      if (tile.far[g] != 0) list_.note_far(s * kGroups + g, tile.far[g]);
      if (tile.notes[g] == 0) continue;
      if ((tile.notes[g] & kApproachTooFast) != 0) found = Condition::first(found, check_approach(s, g));
      if ((tile.notes[g] & kLeftDomain) != 0) {
        if (!left) left.emplace();
        apply_boundaries_to_group(s, g, *left);
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
void CpuBackend<Real>::evaluate_accelerations(const Instant& now, std::uint64_t first_new_id, StepReport& report) {
  LargeVector<Vec3<Real>> evaluated(particles_.acceleration.size());
  place_at(now);
  aim_pass(evaluated.data());
  apply_others(false, report);
  run_pass(report, [](std::size_t, const TileReport&) {});
  for (std::size_t i = 0; i < particles_.slots.end(); ++i) {
    if (!is_vacant(particles_.records[i]) && particles_.ids[rank_of(particles_.records[i].rank)] >= first_new_id)
      particles_.acceleration[i] = evaluated[i];
  }
}

template <class Real>
void CpuBackend<Real>::place_at(const Instant& now) {
  applied_.set_time(now.time);
  if (scene_.colliders.empty()) return;
  colliders_.place(scene_, now.poses, rules_.largest_radius + rules_.widest_range, pass_);
}

template <class Real>
void CpuBackend<Real>::aim_pass(Vec3<Real>* acceleration) {
  pass_.in = particles_.records.data();
  pass_.out = particles_.next.data();
  pass_.acceleration = acceleration;
  pass_.held = applied_.held().lanes();
  pass_.position_at_build = list_.position_at_build();
  pass_.anchors = list_.anchors();
  pass_.next_step = list_.next_step();
}

// Sums the forces that the pass adds. Pairs that springs kept apart and no longer do may touch from the next step on.
template <class Real>
void CpuBackend<Real>::apply_others(bool may_tear, StepReport& report) {
  if (!applied_.none()) {
    report.applied.emplace();
    threads_.run([&] {
      list_.release(applied_.apply(particles_.records, particles_.slots.end(), particles_.count(), particles_.ids,
                                   may_tear, report.applied->springs));
    });
  }
  pass_.applied = applied_.forces();
}

template <class Real>
void CpuBackend<Real>::finish_tile(std::size_t s, AppliedSums& sums) {
  applied_.finish(s * kTile, particles_.slots.end_of(s), particles_.records.data(), particles_.next.data(),
                  pass_.acceleration, sums);
}

template <class Real>
void CpuBackend<Real>::run_tile(std::size_t s, TileReport& report) const {
  const std::size_t groups = (particles_.slots.end_of(s) - s * kTile + kLanes - 1) / kLanes;
  report.clear();
  if (particles_.slots.is_loose(s * kTile)) return run_groups(s, 0, groups, nullptr, nullptr, report);
  for (std::size_t g = 0; g < groups;) {
    std::size_t end = g + 1;
    if (list_.is_patched(s, g)) {
      const auto rows = list_.rows(s, g);
      const std::uint32_t first_row[2] = {0, static_cast<std::uint32_t>(rows.size() / kLanes)};
      run_groups(s, g, end, rows.data(), first_row, report);
    } else {
      while (end < groups && !list_.is_patched(s, end)) ++end;
      run_groups(s, g, end, list_.tile(s).entries, list_.tile(s).first_row.data() + g, report);
    }
    g = end;
  }
}

template <class Real>
void CpuBackend<Real>::run_groups(std::size_t s, std::size_t g, std::size_t end, const std::uint32_t* rows,
                                  const std::uint32_t* first_row, TileReport& report) const {
  TileWork<Real> work;
  work.first = s * kTile + g * kLanes;
  work.group_count = end - g;
  work.alone = rows == nullptr;
  work.rows = rows;
  work.first_row = first_row;
  work.notes = report.notes.data() + g;
  work.far = report.far.data() + g;
  work.sums = report.sums.data();
  loops_.force_pass(pass_, work);
}

// The approach that was too fast, if one was.
template <class Real>
Condition CpuBackend<Real>::check_approach(std::size_t s, std::size_t g) const {
  const ContactScan<Real> scan(pass_, particles_.records.data());
  const auto rows = rows_of(s, g);
  Condition found;
  const std::size_t first = s * kTile + g * kLanes;
  for (std::size_t i = first; i < std::min(first + kLanes, particles_.slots.end_of(s)); ++i) {
    if (!is_vacant(particles_.records[i])) {
      found =
          Condition::first(found, approach_too_fast(scan, i, rows, particles_.records.data(), scene_, particles_.ids));
    }
  }
  return found;
}

template <class Real>
void CpuBackend<Real>::apply_boundaries_to_group(std::size_t s, std::size_t g, Departures& left) {
  const std::size_t first = s * kTile + g * kLanes;
  for (std::size_t i = first; i < std::min(first + kLanes, particles_.slots.end_of(s)); ++i) {
    if (!is_vacant(particles_.next[i])) apply_boundaries(particles_.next[i], i, left);
  }
}

// All tiles, and their sums; then look(s, report of tile s).
template <class Real>
template <class Look>
void CpuBackend<Real>::run_pass(StepReport& total, const Look& look) {
  for_ranges(particles_.slots.tile_count(), 1, [&](std::size_t first, std::size_t last) {
    TileReport report;
    StepSums part;
    std::optional<AppliedSums> applied_part;  // large, and of no use to most scenes
    if (total.applied) applied_part.emplace();
    for (std::size_t n = first; n < last; ++n) {
      const std::size_t s = particles_.slots.tile(n);
      run_tile(s, report);
      report.add_to(part);
      if (applied_part) finish_tile(s, *applied_part);
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
template void CpuBackend<float>::evaluate_accelerations(const Instant& now, std::uint64_t first_new_id,
                                                        StepReport& report);
template void CpuBackend<double>::evaluate_accelerations(const Instant& now, std::uint64_t first_new_id,
                                                         StepReport& report);
template void CpuBackend<float>::place_at(const Instant& now);
template void CpuBackend<double>::place_at(const Instant& now);

}  // namespace hooke
