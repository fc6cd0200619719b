// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/passes/placed_sinks.h"

#include "hooke/physics/enclosure.h"

namespace hooke {

PlacedSinks::PlacedSinks(const std::vector<Sink>& sinks) {
  for (const Sink& sink : sinks) sinks_.push_back({bounds_of(sink.shape), geometry_of(sink.shape, false, {0, 0, 0})});
}

bool PlacedSinks::encloses(const Placed& sink, const Vec3d& x) { return hooke::encloses(sink.shape, x); }

}  // namespace hooke
