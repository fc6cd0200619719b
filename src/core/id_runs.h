// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hooke/base/assert.h"

namespace hooke {

/// Consecutive ids: `first` and those after it. Many ids are few runs where hardly any has been taken away.
struct IdRun {
  std::uint64_t first = 0, count = 0;

  friend bool operator==(const IdRun&, const IdRun&) = default;
};

/// Adds ids, which ascend and are above all before, to runs: no two of these touch.
inline void append_ids(std::vector<IdRun>& runs, std::span<const std::uint64_t> ids) {
  for (const std::uint64_t id : ids) {
    if (!runs.empty() && id == runs.back().first + runs.back().count) {
      ++runs.back().count;
      continue;
    }
    HOOKE_ASSERT(runs.empty() || id > runs.back().first + runs.back().count, id, runs.size());
    runs.push_back({id, 1});
  }
}

}  // namespace hooke
