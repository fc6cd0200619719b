// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/water_mixing.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"

namespace hooke::render {

namespace {

constexpr double kCell = 2.5;       // edge, in radii
constexpr double kMostCells = 4e6;  // cells grow until there are no more than this
constexpr double kPacked = 0.6;     // share of the space that particles of a pool fill

// Cells over the box of the particles' centres.
struct Cells {
  Vec3d origin{0, 0, 0};
  double edge = 1;
  std::array<std::size_t, 3> count{1, 1, 1};

  std::size_t along(double x, int axis) const {
    const double cell = std::floor((x - component(origin, axis)) / edge);
    return static_cast<std::size_t>(
        std::clamp(cell, 0.0, static_cast<double>(count[static_cast<std::size_t>(axis)] - 1)));
  }
  std::size_t of(const Vec3d& x) const { return (along(x.z, 2) * count[1] + along(x.y, 1)) * count[0] + along(x.x, 0); }
  std::size_t size() const { return count[0] * count[1] * count[2]; }
};

Cells make_cells(const ParticleSet& particles, double radius) {
  Vec3d low = particles.position.front(), high = low;
  for (const Vec3d& x : particles.position) {
    low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
    high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
  }
  Cells cells{low, kCell * radius, {}};
  const auto count_along = [&](int axis) {
    return std::max(1.0, std::ceil((component(high, axis) - component(low, axis)) / cells.edge + 1e-9));
  };
  while (count_along(0) * count_along(1) * count_along(2) > kMostCells) cells.edge *= 1.25;
  for (int axis = 0; axis < 3; ++axis)
    cells.count[static_cast<std::size_t>(axis)] = static_cast<std::size_t>(count_along(axis));
  return cells;
}

// Sums over the velocities of the particles of a cell and over their squares, in whole units, since sums of whole
// numbers do not depend on their order.
struct Sums {
  std::int32_t x = 0, y = 0, z = 0, square = 0;

  friend Sums operator+(const Sums& a, const Sums& b) { return {a.x + b.x, a.y + b.y, a.z + b.z, a.square + b.square}; }
};

void add_atomically(Sums& sums, const Vec3d& v, double units) {
  const auto add = [units](std::int32_t& sum, double value) {
    std::atomic_ref(sum).fetch_add(static_cast<std::int32_t>(std::lround(units * value)), std::memory_order_relaxed);
  };
  add(sums.x, v.x);
  add(sums.y, v.y);
  add(sums.z, v.z);
  add(sums.square, dot(v, v));
}

// Each cell becomes the sum of itself and its two neighbours along one axis, `count` cells long; neighbours are
// `stride` apart.
template <class T>
void add_neighbours(std::vector<T>& values, std::size_t count, std::size_t stride) {
  constexpr std::size_t kAbreast = 128;  // lines at once, which lie side by side
  const std::size_t pieces = (stride + kAbreast - 1) / kAbreast, planes = values.size() / (count * stride);
  parallel_ranges(pieces * planes, 4, [&](std::size_t first, std::size_t last) {
    std::vector<T> before(kAbreast), own(kAbreast);
    for (std::size_t piece = first; piece < last; ++piece) {
      const std::size_t from = piece % pieces * kAbreast, width = std::min(kAbreast, stride - from);
      T* const start = values.data() + piece / pieces * count * stride + from;
      std::fill_n(before.begin(), width, T{});
      for (std::size_t i = 0; i < count; ++i) {
        T* const row = start + i * stride;
        std::copy_n(row, width, own.begin());
        if (i + 1 < count) {
          for (std::size_t k = 0; k < width; ++k) row[k] = before[k] + own[k] + row[k + stride];
        } else {
          for (std::size_t k = 0; k < width; ++k) row[k] = before[k] + own[k];
        }
        std::swap(before, own);
      }
    }
  });
}

template <class T>
void add_all_neighbours(std::vector<T>& values, const Cells& cells) {
  add_neighbours(values, cells.count[0], 1);
  add_neighbours(values, cells.count[1], cells.count[0]);
  add_neighbours(values, cells.count[2], cells.count[0] * cells.count[1]);
}

// Length inside the domain of `cell` and its two neighbours along `axis`, m: beyond a wall is no space to fill.
double room(const Cells& cells, const Domain& domain, int axis, std::size_t cell) {
  const double low = component(cells.origin, axis) + (static_cast<double>(cell) - 1) * cells.edge;
  return std::min(low + 3 * cells.edge, component(domain.max, axis)) - std::max(low, component(domain.min, axis));
}

}  // namespace

std::vector<WaterMixing> water_mixing(const Scene& scene, const ParticleSet& particles, double radius, double fastest) {
  HOOKE_ASSERT(radius > 0, radius);
  HOOKE_ASSERT(fastest > 0, fastest);
  std::vector<WaterMixing> mixing(particles.size());
  if (particles.empty()) return mixing;
  const Cells cells = make_cells(particles, radius);
  std::vector<std::uint32_t> counts(cells.size());
  parallel_ranges(particles.size(), 8192, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      std::atomic_ref(counts[cells.of(particles.position[i])]).fetch_add(1, std::memory_order_relaxed);
    }
  });
  add_all_neighbours(counts, cells);
  // Squares of up to 4 that no sum of the fullest cell overflows.
  const double units = std::floor(2e9 / (4.0 * *std::max_element(counts.begin(), counts.end())));
  std::vector<Sums> sums(cells.size());
  parallel_ranges(particles.size(), 8192, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      Vec3d v = (1 / fastest) * particles.velocity[i];
      const double square = dot(v, v);
      if (square > 4) v = (2 / std::sqrt(square)) * v;
      add_atomically(sums[cells.of(particles.position[i])], v, units);
    }
  });
  add_all_neighbours(sums, cells);

  std::array<std::vector<double>, 3> rooms;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t c = 0; c < cells.count[axis]; ++c) {
      rooms[axis].push_back(std::max(room(cells, scene.domain, static_cast<int>(axis), c), cells.edge));
    }
  }
  const double particle = 4 * std::numbers::pi / 3 * radius * radius * radius / kPacked;
  parallel_ranges(particles.size(), 8192, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Vec3d& x = particles.position[i];
      const double space =
          rooms[0][cells.along(x.x, 0)] * rooms[1][cells.along(x.y, 1)] * rooms[2][cells.along(x.z, 2)];
      const std::size_t cell = cells.of(x);
      const Sums& around = sums[cell];
      const double n = counts[cell];
      const auto mean = [&](std::int32_t sum) { return sum / (units * n); };
      const Vec3d drift{mean(around.x), mean(around.y), mean(around.z)};
      const double variance = mean(around.square) - dot(drift, drift);
      mixing[i].filled = static_cast<float>(n * particle / space);
      mixing[i].churn = static_cast<float>(fastest * std::sqrt(std::max(0.0, variance)));
    }
  });
  return mixing;
}

}  // namespace hooke::render
