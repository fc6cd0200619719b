// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "hooke/base/box3.h"
#include "hooke/core/communicator.h"

namespace hooke {

/// Cuts space into boxes whose points weigh about as much each, by Zoltan's recursive coordinate bisection. All ranks
/// make one, between MPI's start and end, and call it together.
class ZoltanCuts {
 public:
  ZoltanCuts();
  ~ZoltanCuts();
  ZoltanCuts(const ZoltanCuts&) = delete;
  ZoltanCuts& operator=(const ZoltanCuts&) = delete;

  /// Communicator::cut().
  std::vector<Box3d> cut(std::span<const WeightedPoint> points, int ranks);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hooke
