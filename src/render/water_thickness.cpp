// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/water_thickness.h"

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

constexpr float kPacking = 1.25f;  // 0.64 * 1.25^3: water's spheres in a Frame have 1.25 times the particles' radius
// Sums of whole numbers do not depend on their order, so thickness is summed in whole units.
constexpr float kUnits = 1 << 14;  // in a typical radius
constexpr float kSpread = 1.0f;    // of a sphere's radius: how far it spreads, at least a cell

// The cells along an axis over which a sphere spreads, and their weights, whose sum is 1.
struct Spread {
  static constexpr float kMost = 8;  // cells on each side
  int first = 0, count = 0;
  std::array<float, 2 * static_cast<std::size_t>(kMost) + 2> weight;

  // A tent around `middle`; what would fall beside the picture, of `cells` cells, counts inside.
  Spread(float middle, float reach, int cells) {
    first = std::max(0, static_cast<int>(std::ceil(middle - 0.5f - reach)));
    const int last = std::min(cells - 1, static_cast<int>(std::floor(middle - 0.5f + reach)));
    float sum = 0;
    for (int k = first; k <= last; ++k) {
      const float w = std::max(0.0f, 1 - std::abs(static_cast<float>(k) + 0.5f - middle) / reach);
      weight[static_cast<std::size_t>(count++)] = w;
      sum += w;
    }
    for (int k = 0; k < count; ++k) weight[static_cast<std::size_t>(k)] /= sum;
  }
};

// Each cell becomes combine(the one before, itself, the one after), along the rows and then along the columns.
template <class Combine>
void filter(WaterThickness& thickness, const Combine& combine) {
  const auto along = [&](int count, int lines, int step, int line_step) {
    std::vector<float> line(static_cast<std::size_t>(count) + 2);
    for (int l = 0; l < lines; ++l) {
      float* const cells = thickness.meters.data() + static_cast<std::ptrdiff_t>(l) * line_step;
      const auto cell = [&](int i) -> float& { return cells[static_cast<std::ptrdiff_t>(i) * step]; };
      for (int i = 0; i < count; ++i) line[static_cast<std::size_t>(i) + 1] = cell(i);
      line.front() = line[1];
      line.back() = line[static_cast<std::size_t>(count)];
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        cell(static_cast<int>(i)) = combine(line[i], line[i + 1], line[i + 2]);
      }
    }
  };
  along(thickness.columns, thickness.rows, 1, thickness.columns);
  along(thickness.rows, thickness.columns, thickness.columns, 1);
}

}  // namespace

WaterThickness water_thickness(std::span<const Sphere> spheres, const Projection& view) {
  HOOKE_ASSERT(view.width > 0 && view.height > 0, view.width, view.height);
  WaterThickness thickness;
  thickness.columns = static_cast<int>(std::ceil(view.width / WaterThickness::kCell));
  thickness.rows = static_cast<int>(std::ceil(view.height / WaterThickness::kCell));
  const std::size_t cells = static_cast<std::size_t>(thickness.columns) * static_cast<std::size_t>(thickness.rows);
  thickness.meters.resize(cells);
  const auto first_water = std::find_if(spheres.begin(), spheres.end(), [](const Sphere& s) { return s.foam > 0; });
  if (first_water == spheres.end()) return thickness;

  const float unit = first_water->radius / kUnits;
  std::vector<std::uint64_t> sums(cells);
  parallel_ranges(spheres.size(), 8192, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Sphere& sphere = spheres[i];
      if (sphere.foam == 0) continue;
      const Vec3f to{sphere.x - view.eye.x, sphere.y - view.eye.y, sphere.z - view.eye.z};
      const float depth = -dot(to, view.back);
      if (depth < view.nearest) continue;
      const float scale = view.parallel ? view.scale : view.scale / depth;
      const float x = (0.5f * view.width + scale * dot(to, view.right)) / WaterThickness::kCell;
      const float y = (0.5f * view.height + scale * dot(to, view.up)) / WaterThickness::kCell;
      if (!(x >= 0 && y >= 0 && x < static_cast<float>(thickness.columns) && y < static_cast<float>(thickness.rows))) {
        continue;
      }
      const float side = WaterThickness::kCell / scale;  // of a cell at this depth, m
      const float volume = 4 * std::numbers::pi_v<float> / 3 * sphere.radius * sphere.radius * sphere.radius;
      const float meters = std::min(volume / kPacking / (side * side), 100 * sphere.radius);
      const float reach = std::clamp(kSpread * sphere.radius / side, 1.0f, Spread::kMost);
      const Spread across(x, reach, thickness.columns), along(y, reach, thickness.rows);
      for (int row = 0; row < along.count; ++row) {
        for (int column = 0; column < across.count; ++column) {
          const float share =
              along.weight[static_cast<std::size_t>(row)] * across.weight[static_cast<std::size_t>(column)];
          const auto cell = static_cast<std::size_t>((along.first + row) * thickness.columns + across.first + column);
          std::atomic_ref(sums[cell])
              .fetch_add(static_cast<std::uint64_t>(share * meters / unit), std::memory_order_relaxed);
        }
      }
    }
  });
  for (std::size_t c = 0; c < cells; ++c) thickness.meters[c] = unit * static_cast<float>(sums[c]);
  // Cells at the water's rim are only partly filled, so each takes the maximum around it. Then blur, to hide the cells.
  filter(thickness, [](float before, float own, float after) { return std::max({before, own, after}); });
  filter(thickness, [](float before, float own, float after) { return 0.25f * (before + after) + 0.5f * own; });
  filter(thickness, [](float before, float own, float after) { return 0.25f * (before + after) + 0.5f * own; });
  return thickness;
}

}  // namespace hooke::render
