// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hooke {

/// The ids of all ranks. Most often they are consecutive numbers, and then take no memory.
class IdTable {
 public:
  IdTable() = default;
  /// `ids` ascend.
  explicit IdTable(const std::vector<std::uint64_t>& ids) : count_(ids.size()), first_(ids.empty() ? 0 : ids.front()) {
    if (count_ > 0 && ids.back() - first_ != count_ - 1) ids_ = ids;
  }

  std::size_t size() const { return count_; }
  std::uint64_t operator[](std::size_t rank) const { return ids_.empty() ? first_ + rank : ids_[rank]; }

 private:
  std::size_t count_ = 0;
  std::uint64_t first_ = 0;
  std::vector<std::uint64_t> ids_;
};

}  // namespace hooke
