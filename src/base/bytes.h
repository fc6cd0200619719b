// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "hooke/base/assert.h"

namespace hooke {

// Values as the bytes of messages between processes of the same program.

template <class T>
void append_bytes(std::vector<std::byte>& to, const T* values, std::size_t count) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (count == 0) return;
  const std::size_t at = to.size();
  to.resize(at + count * sizeof(T));
  std::memcpy(to.data() + at, values, count * sizeof(T));
}
template <class T>
void append_bytes(std::vector<std::byte>& to, const T& value) {
  append_bytes(to, &value, 1);
}
inline void append_bytes(std::vector<std::byte>& to, const std::vector<std::byte>& bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

/// Reads `count` values, which must be there; what follows them is left in `from`.
template <class T>
void take_bytes(std::span<const std::byte>& from, T* values, std::size_t count) {
  static_assert(std::is_trivially_copyable_v<T>);
  HOOKE_ASSERT(from.size() >= count * sizeof(T), from.size(), count, sizeof(T));
  if (count > 0) std::memcpy(values, from.data(), count * sizeof(T));
  from = from.subspan(count * sizeof(T));
}
template <class T>
void take_bytes(std::span<const std::byte>& from, T& value) {
  take_bytes(from, &value, 1);
}

/// A column with its length in front.
template <class T>
void append_column(std::vector<std::byte>& to, const std::vector<T>& column) {
  append_bytes(to, column.size());
  append_bytes(to, column.data(), column.size());
}
template <class T>
void take_column(std::span<const std::byte>& from, std::vector<T>& column) {
  std::size_t count = 0;
  take_bytes(from, count);
  column.resize(count);
  take_bytes(from, column.data(), count);
}

}  // namespace hooke
