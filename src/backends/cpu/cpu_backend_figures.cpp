// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/cpu_backend_impl.h"

#include <algorithm>

#include "hooke/base/format.h"
#include "hooke/passes/contact_reports.h"

namespace hooke {

template <class Real>
Expected<MeasurementSums> CpuBackend<Real>::measure(const Instant& now) {
  place_at(now);
  if (const bool stale = neighbours_stale(); stale && !is_part_) {  // ranks build together, before
    if (const Condition found = build_neighbours(); !found.good()) {
      return fail(Error::Kind::run_failed, formatted("particle {}", found.particle), "is at no finite position");
    }
  }
  threads_.run([&] { particles_.find_known_slots(); });
  MeasurementSums total;
  for_ranges(particles_.slots.end(), kTile, [&](std::size_t first, std::size_t last) {
    const ContactScan<Real> scan = contact_scan();
    MeasurementSums part;
    for (std::size_t i = first; i < last; ++i) {
      if (is_vacant(particles_.records[i])) continue;
      measure_particle(scan, i, rows_of(i / kTile, i % kTile / kLanes), particles_.records[i], scene_, part);
    }
    const std::lock_guard lock(mutex_);
    total.add(part);
  });
  threads_.run([&] { applied_.measure(particles_, total); });
  return total;
}

template <class Real>
std::uint64_t CpuBackend<Real>::particles_hash() const {
  std::uint64_t hash = 0;
  threads_.run([&] { hash = particles_.hash(); });
  return hash;
}

template <class Real>
NeighbourStatistics CpuBackend<Real>::neighbour_statistics() const {
  const auto n = static_cast<double>(std::max<std::size_t>(particles_.slots.end(), 1));
  return {list_.build_count(), static_cast<double>(list_.entry_count()) / n, missed_contacts_};
}

template Expected<MeasurementSums> CpuBackend<float>::measure(const Instant& now);
template Expected<MeasurementSums> CpuBackend<double>::measure(const Instant& now);
template std::uint64_t CpuBackend<float>::particles_hash() const;
template std::uint64_t CpuBackend<double>::particles_hash() const;
template NeighbourStatistics CpuBackend<float>::neighbour_statistics() const;
template NeighbourStatistics CpuBackend<double>::neighbour_statistics() const;

}  // namespace hooke
