// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hooke/core/particle_slices.h"

namespace hooke::test {

/// Those of a set, in slices of few rows, however many are asked for. The visit of this number, from 1, fails halfway.
class SmallSlices final : public ParticleSlices {
 public:
  SmallSlices(const ParticleSet& set, std::size_t rows, int failing = 0) : set_(set), rows_(rows), failing_(failing) {}

  std::uint64_t size() const override { return set_.size(); }
  std::uint64_t identity() const override { return SlicesOfSet(set_).identity(); }
  bool has_accelerations() const override { return !set_.acceleration.empty(); }
  Expected<void> visit(std::size_t, const Take& take) const override {
    const bool fails = ++visits_ == failing_;
    for (std::size_t first = 0; first < set_.size(); first += rows_) {
      if (fails && first >= set_.size() / 2) return fail(Error::Kind::io, "slices", "can't be read");
      take(ParticleSlice(set_, first, std::min(rows_, set_.size() - first)));
    }
    return {};
  }
  int visits() const { return visits_; }

 private:
  const ParticleSet& set_;
  std::size_t rows_;
  int failing_;
  mutable int visits_ = 0;
};

}  // namespace hooke::test
