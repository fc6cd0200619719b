// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/distance_field.h"

#include <algorithm>
#include <bit>

#include "hooke/base/assert.h"

namespace hooke {

void DistanceField::make_directory() {
  HOOKE_ASSERT(std::is_sorted(keys.begin(), keys.end()), keys.size());
  // At least half of the slots stay empty, so that few are looked at.
  const std::size_t count = std::bit_ceil(2 * keys.size() + 2), last = count - 1;
  slots.assign(count, BrickSlot{});
  hash_shift = 64 - static_cast<unsigned>(std::countr_zero(count));
  for (std::size_t i = 0; i < keys.size(); ++i) {
    std::size_t slot = first_slot(keys[i], hash_shift);
    while (slots[slot].brick >= 0) slot = (slot + 1) & last;
    slots[slot] = {keys[i], static_cast<std::int32_t>(i)};
  }
}

std::size_t DistanceField::bytes() const {
  return keys.size() * sizeof(std::uint64_t) + slots.size() * sizeof(BrickSlot) + samples.size() * sizeof(float);
}

}  // namespace hooke
