// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hooke/base/ascending.h"
#include "hooke/base/assert.h"

namespace hooke {

/// the ids by id index, ascending. The consecutive ids at the end of the table, usually all, take no memory and
/// are found without a search. Where ids come and go, some of these id indices may have no particle.
class IdTable {
 public:
  IdTable() = default;
  /// `ids` ascend. With `with_gaps`, up to half of the consecutive ids have no particle; else id indices index `ids`.
  explicit IdTable(const std::vector<std::uint64_t>& ids, bool with_gaps = false) {
    if (ids.empty()) return;
    HOOKE_ASSERT(is_ascending(ids), ids.size());
    const std::uint64_t fewest = with_gaps ? 2 : 1;  // one in so many consecutive ids has a particle
    std::size_t from = ids.size() - 1;
    for (std::size_t k = from; k-- > 0;) {
      if (ids.back() - ids[k] < fewest * (ids.size() - k)) {
        from = k;
      } else if (!with_gaps) {
        break;
      }
    }
    ids_.assign(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(from));
    first_ = ids[from];
    consecutive_ = static_cast<std::size_t>(ids.back() - first_ + 1);
  }

  /// Adds an id above all others.
  void append(std::uint64_t id) { append(id, 1); }
  /// The same for `count` consecutive ids from this one on.
  void append(std::uint64_t id, std::size_t count) {
    HOOKE_ASSERT(size() == 0 || id > (*this)[size() - 1], id, size());
    if (count == 0) return;
    if (consecutive_ == 0) first_ = id;
    if (id != first_ + consecutive_) {
      for (std::size_t k = 0; k < consecutive_; ++k) ids_.push_back(first_ + k);
      first_ = id;
      consecutive_ = 0;
    }
    consecutive_ += count;
  }

  std::size_t size() const { return ids_.size() + consecutive_; }
  /// The id index of an id; size() where there is none.
  std::size_t find(std::uint64_t id) const {
    if (id >= first_ && id - first_ < consecutive_) return ids_.size() + static_cast<std::size_t>(id - first_);
    const auto found = std::lower_bound(ids_.begin(), ids_.end(), id);
    return found != ids_.end() && *found == id ? static_cast<std::size_t>(found - ids_.begin()) : size();
  }
  /// The id of an id index < size().
  std::uint64_t operator[](std::size_t id_index) const {
    HOOKE_ASSERT(id_index < size(), id_index, size());
    return id_index < ids_.size() ? ids_[id_index] : first_ + (id_index - ids_.size());
  }

 private:
  std::vector<std::uint64_t> ids_;
  std::uint64_t first_ = 0;  // of the consecutive ids
  std::size_t consecutive_ = 0;
};

}  // namespace hooke
