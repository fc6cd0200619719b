// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
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
  /// The rank of an id; size() where there is none.
  std::size_t find(std::uint64_t id) const {
    if (ids_.empty()) return id >= first_ && id - first_ < count_ ? static_cast<std::size_t>(id - first_) : count_;
    const auto found = std::lower_bound(ids_.begin(), ids_.end(), id);
    return found != ids_.end() && *found == id ? static_cast<std::size_t>(found - ids_.begin()) : count_;
  }
  std::uint64_t operator[](std::size_t rank) const { return ids_.empty() ? first_ + rank : ids_[rank]; }

 private:
  std::size_t count_ = 0;
  std::uint64_t first_ = 0;
  std::vector<std::uint64_t> ids_;
};

}  // namespace hooke
