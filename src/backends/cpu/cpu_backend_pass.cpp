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
Condition CpuBackend<Real>::apply_forces() {
  Stopwatch forcing(times_.force);
  StepSums sums;
  AppliedSums applied;
  Departures removed;
  Condition condition;
  aim_pass(verlet() ? particles_.acceleration.data() : nullptr);
  const bool released = apply_others(true, applied.springs);
  run_pass(sums, applied, [&](std::size_t s, const SegmentReport& report) {
    std::optional<Departures> left;  // large, and seldom of use
    Condition found;
    for (std::size_t g = 0; g < kGroups; ++g) {
      if (report.far[g] != 0) list_.note_far(s * kGroups + g, report.far[g]);
      if (report.notes[g] == 0) continue;
      if ((report.notes[g] & kApproachTooFast) != 0) found = Condition::first(found, look_closely(s, g));
      if ((report.notes[g] & kLeftDomain) != 0) {
        if (!left) left.emplace();
        apply_boundaries_to_group(s, g, *left);
      }
    }
    if (left) collect(removed, *left);
    if (found.good()) return;
    const std::lock_guard lock(mutex_);
    condition = Condition::first(condition, found);
  });
  book_step(ledger_, sums, applied_.none() ? nullptr : &applied, scene_.gravity, particles_.mass(), scene_.time_step,
            scene_.integrator);
  particles_.records.swap(particles_.next);
  forcing.stop();
  if (!verlet()) {
    follow_motion();
  } else if (released) {  // nobody has moved; rows are mended before the next forces, but somebody may look
    threads_.run([&] { list_.mend_released(particles_.records.data()); });
  }
  let_go(removed, ledger_.removed);
  return condition;
}

// Accelerations a(x, v) of the particles that have none of a last step.
template <class Real>
Condition CpuBackend<Real>::evaluate_accelerations(std::uint64_t first_new_id) {
  if (const Condition found = build_neighbours(); !found.good()) return found;
  LargeVector<Vec3<Real>> evaluated(particles_.acceleration.size());
  StepSums sums;
  AppliedSums applied;
  aim_pass(evaluated.data());
  (void)apply_others(false, applied.springs);
  run_pass(sums, applied, [](std::size_t, const SegmentReport&) {});
  ledger_.last = first_rates(sums, applied_.none() ? nullptr : &applied, scene_.gravity, particles_.mass());
  for (std::size_t i = 0; i < particles_.slots.end(); ++i) {
    if (!is_nowhere(particles_.records[i]) && particles_.ids[rank_of(particles_.records[i].rank)] >= first_new_id)
      particles_.acceleration[i] = evaluated[i];
  }
  return {};
}

template <class Real>
void CpuBackend<Real>::aim_pass(Vec3<Real>* acceleration) {
  pass_.in = particles_.records.data();
  pass_.out = particles_.next.data();
  pass_.acceleration = acceleration;
  pass_.held = applied_.held().lanes();
  pass_.listed_at = list_.listed_at();
  pass_.anchors = list_.anchors();
  pass_.next_step = list_.next_step();
}

// Sums the forces that the pass adds. Returns whether pairs that springs kept apart may touch from the next step on.
template <class Real>
bool CpuBackend<Real>::apply_others(bool may_tear, SpringSums& sums) {
  bool released = false;
  if (!applied_.none()) {
    threads_.run([&] {
      const auto& pairs = applied_.apply(particles_.records, particles_.slots.end(), particles_.count(), particles_.ids,
                                         may_tear, sums);
      list_.release(pairs);
      released = !pairs.empty();
    });
  }
  pass_.applied = applied_.forces();
  return released;
}

template <class Real>
void CpuBackend<Real>::settle_segment(std::size_t s, AppliedSums& sums) {
  applied_.settle(s * kSegment, particles_.slots.end_of(s), particles_.records.data(), particles_.next.data(),
                  pass_.acceleration, sums);
}

template <class Real>
void CpuBackend<Real>::run_segment(std::size_t s, SegmentReport& report) const {
  const std::size_t groups = (particles_.slots.end_of(s) - s * kSegment + kLanes - 1) / kLanes;
  report.clear();
  if (particles_.slots.is_loose(s * kSegment)) return run_groups(s, 0, groups, nullptr, nullptr, report);
  for (std::size_t g = 0; g < groups;) {
    std::size_t end = g + 1;
    if (list_.is_mended(s, g)) {
      const auto rows = list_.rows(s, g);
      const std::uint32_t first_row[2] = {0, static_cast<std::uint32_t>(rows.size() / kLanes)};
      run_groups(s, g, end, rows.data(), first_row, report);
    } else {
      while (end < groups && !list_.is_mended(s, end)) ++end;
      run_groups(s, g, end, list_.segment(s).entries, list_.segment(s).first_row.data() + g, report);
    }
    g = end;
  }
}

template <class Real>
void CpuBackend<Real>::run_groups(std::size_t s, std::size_t g, std::size_t end, const std::uint32_t* rows,
                                  const std::uint32_t* first_row, SegmentReport& report) const {
  SegmentWork<Real> work;
  work.first = s * kSegment + g * kLanes;
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
Condition CpuBackend<Real>::look_closely(std::size_t s, std::size_t g) const {
  const ContactScan<Real> scan(pass_, particles_.records.data());
  const auto rows = rows_of(s, g);
  Condition found;
  const std::size_t first = s * kSegment + g * kLanes;
  for (std::size_t i = first; i < std::min(first + kLanes, particles_.slots.end_of(s)); ++i) {
    if (!is_nowhere(particles_.records[i])) {
      found =
          Condition::first(found, approach_too_fast(scan, i, rows, particles_.records.data(), scene_, particles_.ids));
    }
  }
  return found;
}

template <class Real>
void CpuBackend<Real>::apply_boundaries_to_group(std::size_t s, std::size_t g, Departures& left) {
  const std::size_t first = s * kSegment + g * kLanes;
  for (std::size_t i = first; i < std::min(first + kLanes, particles_.slots.end_of(s)); ++i) {
    if (!is_nowhere(particles_.next[i])) apply_boundaries(particles_.next[i], i, left);
  }
}

// All segments, and their sums; then look(s, report of segment s).
template <class Real>
template <class Look>
void CpuBackend<Real>::run_pass(StepSums& sums, AppliedSums& applied, const Look& look) {
  for_ranges(particles_.slots.segment_count(), 1, [&](std::size_t first, std::size_t last) {
    SegmentReport report;
    StepSums part;
    std::optional<AppliedSums> applied_part;  // large, and of no use to most scenes
    if (!applied_.none()) applied_part.emplace();
    for (std::size_t n = first; n < last; ++n) {
      const std::size_t s = particles_.slots.segment(n);
      run_segment(s, report);
      report.add_to(part);
      if (applied_part) settle_segment(s, *applied_part);
      look(s, report);
    }
    const std::lock_guard lock(mutex_);
    sums.add(part);
    if (applied_part) applied.add(*applied_part);
  });
}

template Condition CpuBackend<float>::apply_forces();
template Condition CpuBackend<double>::apply_forces();
template Condition CpuBackend<float>::evaluate_accelerations(std::uint64_t first_new_id);
template Condition CpuBackend<double>::evaluate_accelerations(std::uint64_t first_new_id);

}  // namespace hooke
