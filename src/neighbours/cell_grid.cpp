// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/neighbours/cell_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"

namespace hooke {

void CellGrid::lay_out(const Vec3d& min, const Vec3d& max, const bool (&periodic)[3], const Vec3d& reach) {
  for (int i = 0; i < 3; ++i) {
    Axis& a = axes[i];
    const double length = component(max, i) - component(min, i);
    HOOKE_ASSERT(std::isfinite(length) && length >= 0, i, min, max);
    HOOKE_ASSERT(component(reach, i) > 0, i, reach);
    const double cells = std::floor(length / component(reach, i));
    a.periodic = periodic[i];
    a.origin = component(min, i);
    a.length = length;
    a.count = static_cast<std::int64_t>(std::clamp(cells, 1.0, static_cast<double>(kMaxCells)));
    a.cell = std::max(component(reach, i), length / static_cast<double>(a.count));
    inverse_cell[i] = 1 / a.cell;
    last_cell[i] = static_cast<double>(a.count - 1);
  }
  const std::array<int, 3> along = path_axes(min, max);
  std::copy(along.begin(), along.end(), GridGeometry::path);
  stride_y = axes[0].count + 2;
  stride_z = stride_y * (axes[1].count + 2);
}

std::size_t CellGrid::neighbour_ranges(std::uint64_t key, KeyRange (&out)[kMostRanges], int more) const {
  HOOKE_ASSERT(key < key_end() && more >= 0, key, key_end(), more);
  const auto k = static_cast<std::int64_t>(key);
  const std::int64_t rows_y = axes[1].count + 2;
  const std::int64_t row = k / stride_y;
  const std::int64_t at[3] = {k - row * stride_y, row % rows_y, row / rows_y};

  // As of GridGeometry, of cells around one.
  const auto stretches = [&](int i, std::int64_t first, std::int64_t last, Stretch(&to)[2]) {
    const std::int64_t n = axes[i].count;
    if (!axes[i].periodic || last - first + 1 >= n) {
      to[0] = axes[i].periodic ? Stretch{1, n} : Stretch{std::max<std::int64_t>(first, 1), std::min(last, n)};
      return 1;
    }
    to[0] = {std::max<std::int64_t>(first, 1), std::min(last, n)};
    if (first < 1) {
      to[1] = {first + n, n};
    } else if (last > n) {
      to[1] = {1, last - n};
    } else {
      return 1;
    }
    return 2;
  };
  Stretch xs[2], ys[2], zs[2];
  const int nx = stretches(0, at[0] - 1, at[0] + more + 1, xs);
  const int ny = stretches(1, at[1] - 1, at[1] + 1, ys);
  const int nz = stretches(2, at[2] - 1, at[2] + 1, zs);

  std::size_t ranges = 0;
  for (int sz = 0; sz < nz; ++sz) {
    for (std::int64_t z = zs[sz].first; z <= zs[sz].last; ++z) {
      for (int sy = 0; sy < ny; ++sy) {
        for (std::int64_t y = ys[sy].first; y <= ys[sy].last; ++y) {
          const std::int64_t start = y * stride_y + z * stride_z;
          for (int sx = 0; sx < nx; ++sx) {
            out[ranges++] = {static_cast<std::uint64_t>(start + xs[sx].first),
                             static_cast<std::uint64_t>(start + xs[sx].last)};
          }
        }
      }
    }
  }
  return ranges;
}

namespace {

constexpr unsigned kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
constexpr std::size_t kBlock = 1U << 16U;

using Histogram = std::array<std::uint32_t, kDigits>;

}  // namespace

void sort_by_key(std::vector<std::uint64_t>& keys, std::vector<std::uint32_t>& order, std::span<std::byte> scratch) {
  const std::size_t n = keys.size();
  HOOKE_ASSERT(n <= std::uint64_t{1} << 32U, n);
  order.resize(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = static_cast<std::uint32_t>(i);

  // Digits in which all keys agree need no pass: usually all but the lowest two.
  std::uint64_t all_or = 0;
  std::uint64_t all_and = ~std::uint64_t{0};
  for (const std::uint64_t key : keys) {
    all_or |= key;
    all_and &= key;
  }
  const std::uint64_t varying = all_or ^ all_and;

  std::vector<std::uint64_t> own_scratch;
  const std::size_t needed = n * (sizeof(std::uint64_t) + sizeof(std::uint32_t));
  if (scratch.size() < needed || reinterpret_cast<std::uintptr_t>(scratch.data()) % alignof(std::uint64_t) != 0) {
    own_scratch.resize(needed / sizeof(std::uint64_t) + 1);
    scratch = std::as_writable_bytes(std::span(own_scratch));
  }
  std::uint64_t* from_keys = keys.data();
  std::uint32_t* from_order = order.data();
  auto* to_keys = reinterpret_cast<std::uint64_t*>(scratch.data());
  auto* to_order = reinterpret_cast<std::uint32_t*>(to_keys + n);

  const std::size_t blocks = (n + kBlock - 1) / kBlock;
  std::vector<Histogram> starts(blocks);
  for (unsigned shift = 0; shift < 64; shift += kDigitBits) {
    if (((varying >> shift) & (kDigits - 1)) == 0) continue;
    const auto digit = [&](std::size_t i) { return (from_keys[i] >> shift) & (kDigits - 1); };
    parallel_ranges(n, kBlock, [&](std::size_t first, std::size_t last) {
      for (std::size_t block = first; block < last; block += kBlock) {
        Histogram& h = starts[block / kBlock];
        h.fill(0);
        for (std::size_t i = block; i < std::min(block + kBlock, n); ++i) ++h[digit(i)];
      }
    });
    std::uint32_t start = 0;
    for (std::size_t d = 0; d < kDigits; ++d) {
      for (Histogram& h : starts) start += std::exchange(h[d], start);
    }
    parallel_ranges(n, kBlock, [&](std::size_t first, std::size_t last) {
      for (std::size_t block = first; block < last; block += kBlock) {
        Histogram& h = starts[block / kBlock];
        for (std::size_t i = block; i < std::min(block + kBlock, n); ++i) {
          const std::uint32_t to = h[digit(i)]++;
          to_keys[to] = from_keys[i];
          to_order[to] = from_order[i];
        }
      }
    });
    std::swap(from_keys, to_keys);
    std::swap(from_order, to_order);
  }
  if (from_keys != keys.data()) {
    std::copy(from_keys, from_keys + n, keys.data());
    std::copy(from_order, from_order + n, order.data());
  }
}

}  // namespace hooke
