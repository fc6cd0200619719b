// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/visible_spheres.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"

namespace hooke::render {

namespace {

constexpr std::size_t kGrain = 8192;
constexpr std::size_t kBuckets = 16384;  // for sorting by distance
constexpr std::size_t kBands = 4;        // of rows of the picture, one thread each

// A sphere hides what is behind the middle of its disc, out to kHidingShare of its radius. Its surface there lies at
// least sqrt(1 - 0.9^2) = 0.436 of the radius before its centre; kHidingDepth is less, to allow for perspective.
constexpr float kHidingShare = 0.9f;
constexpr float kHidingDepth = 0.4f;

// A sphere on the picture.
struct Disc {
  float x, y;       // pixels
  float inner;      // radius of a circle inside the outline, pixels
  float outer;      // radius of a circle around the outline, pixels
  float distance;   // from the eye to the centre, m; where parallel, the depth
  float radius;     // m
  std::uint32_t sphere;
};

// Whether a sphere is beyond one of two opposite sides of the picture (left and right, or lower and upper). Rays
// through these sides are `tangent` metres off the middle a metre of depth.
bool beyond_side(float across, float depth, float radius, float tangent) {
  return std::abs(across) - depth * tangent > radius * std::sqrt(1 + tangent * tangent);
}

// outer < 0 where the sphere is outside the picture or behind the eye.
Disc project(const Sphere& sphere, std::uint32_t index, const Projection& view) {
  constexpr float kRounding = 0.01f;  // pixels
  const Vec3f to{sphere.x - view.eye.x, sphere.y - view.eye.y, sphere.z - view.eye.z};
  const float depth = -dot(to, view.back), right = dot(to, view.right), up = dot(to, view.up);
  const float radius = sphere.radius;
  Disc disc{0.5f * view.width, 0.5f * view.height, 0, -1, depth, radius, index};
  if (!(depth + radius >= view.nearest)) return disc;
  float scale = view.scale, stretch = 1;
  if (!view.parallel) {
    disc.distance = std::sqrt(dot(to, to));
    // The outline is an ellipse. It extends farthest from the sphere's centre on the side away from the picture's
    // middle, where the angle of the centre and the angle of the sphere's radius add up.
    const float sine = radius / disc.distance;
    const float tangent = std::sqrt(right * right + up * up) / depth;
    const float cosine = std::sqrt(std::max(0.0f, 1 - sine * sine)) - tangent * sine;  // of the sum, over the centre's
    if (!(depth > view.nearest && cosine > 0.05f)) {  // the sphere extends beside the eye, or around it
      const bool outside = beyond_side(right, depth, radius, 0.5f * view.width / view.scale) ||
                           beyond_side(up, depth, radius, 0.5f * view.height / view.scale);
      if (!outside) disc.outer = view.width + view.height;
      return disc;
    }
    scale = view.scale / depth;
    stretch = std::sqrt(1 + tangent * tangent) / cosine;
  }
  disc.x += scale * right;
  disc.y += scale * up;
  const float outer = scale * radius * stretch + kRounding;
  const bool outside =
      disc.x + outer < 0 || disc.y + outer < 0 || disc.x - outer > view.width || disc.y - outer > view.height;
  if (outside) return disc;
  disc.outer = outer;
  // A sphere cut by the nearest depth hides nothing.
  if (depth - radius >= view.nearest) disc.inner = scale * radius;
  return disc;
}

// Which pixels of a band of rows are covered: a word for each tile of 8 x 8 pixels, a byte for each row of a tile.
class Coverage {
 public:
  static constexpr int kTile = 8;  // pixels

  /// Rows [first_row, last_row); first_row a multiple of kTile.
  Coverage(int width, int first_row, int last_row)
      : columns_((width + kTile - 1) / kTile),
        first_tile_(first_row / kTile),
        last_tile_((last_row + kTile - 1) / kTile),
        bits_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(last_tile_ - first_tile_)) {
    // Pixels outside the picture count as covered.
    for (int y = first_tile_; y < last_tile_; ++y) {
      for (int row = 0; row < kTile; ++row) {
        const std::uint64_t byte =
            y * kTile + row >= last_row ? 0xff : 0xff & ~((1u << (kTile - columns_ * kTile + width)) - 1);
        bits_[index(columns_ - 1, y)] |= byte << (8 * row);
        if (y * kTile + row < last_row) continue;
        for (int x = 0; x + 1 < columns_; ++x) bits_[index(x, y)] |= std::uint64_t{0xff} << (8 * row);
      }
    }
  }

  // Whether every pixel with its centre in the disc is covered.
  bool covers(float x, float y, float radius) const {
    return each_tile(x, y, radius, [&](std::size_t tile, int column, int row) {
      const std::uint64_t bits = bits_[tile];
      return ~bits == 0 ||
             (disc_in_tile(x - static_cast<float>(column), y - static_cast<float>(row), radius) & ~bits) == 0;
    });
  }
  void cover(float x, float y, float radius) {
    each_tile(x, y, radius, [&](std::size_t tile, int column, int row) {
      bits_[tile] |= disc_in_tile(x - static_cast<float>(column), y - static_cast<float>(row), radius);
      return true;
    });
  }

 private:
  // Calls body(tile, its first column, its first row) for the tiles that the disc may reach, until it returns false.
  // Returns whether it always returned true.
  template <class Body>
  bool each_tile(float x, float y, float radius, const Body& body) const {
    const auto tile_of = [](float pixel) { return static_cast<int>(std::floor(pixel / kTile)); };
    const int left = std::max(0, tile_of(x - radius)), right = std::min(columns_ - 1, tile_of(x + radius));
    const int low = std::max(first_tile_, tile_of(y - radius)), high = std::min(last_tile_ - 1, tile_of(y + radius));
    for (int row = low; row <= high; ++row) {
      for (int column = left; column <= right; ++column) {
        if (!body(index(column, row), column * kTile, row * kTile)) return false;
      }
    }
    return true;
  }

  // The pixels of a tile whose centres are in a disc; x, y are relative to the tile's corner.
  static std::uint64_t disc_in_tile(float x, float y, float radius) {
    std::uint64_t bits = 0;
    for (int row = 0; row < kTile; ++row) {
      const float away = static_cast<float>(row) + 0.5f - y;
      const float square = radius * radius - away * away;
      if (square < 0) continue;
      const float half = std::sqrt(square);
      const int left = static_cast<int>(std::ceil(std::max(x - half - 0.5f, 0.0f)));
      const int right = static_cast<int>(std::floor(std::min(x + half - 0.5f, kTile - 1.0f)));
      if (left <= right) bits |= (std::uint64_t{0xff} >> (kTile - 1 - right + left) << left) << (8 * row);
    }
    return bits;
  }

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row - first_tile_) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int columns_, first_tile_, last_tile_;
  std::vector<std::uint64_t> bits_;
};

// Discs sorted into buckets by the distance of their nearest point.
struct Buckets {
  std::vector<Disc> discs;  // by bucket
  std::vector<std::size_t> first;  // first disc of each bucket, and the end
  float nearest = 0, per_meter = 0;

  // The first bucket that lies wholly behind `distance`.
  std::size_t behind(float distance) const { return of(distance) + 1; }
  std::size_t of(float distance) const {
    return static_cast<std::size_t>(std::clamp((distance - nearest) * per_meter, 0.0f, kBuckets - 1.0f));
  }
};

float front(const Disc& disc) { return disc.distance - disc.radius; }

Buckets sort_by_front(const std::vector<Disc>& discs) {
  Buckets buckets;
  float nearest = std::numeric_limits<float>::max(), farthest = std::numeric_limits<float>::lowest();
  for (const Disc& disc : discs) {
    if (disc.outer < 0) continue;
    nearest = std::min(nearest, front(disc));
    farthest = std::max(farthest, front(disc));
  }
  buckets.nearest = nearest;
  buckets.per_meter = farthest > nearest ? kBuckets / (farthest - nearest) : 0;
  buckets.first.assign(kBuckets + 1, 0);
  for (const Disc& disc : discs) {
    if (disc.outer >= 0) ++buckets.first[buckets.of(front(disc)) + 1];
  }
  for (std::size_t b = 0; b < kBuckets; ++b) buckets.first[b + 1] += buckets.first[b];
  buckets.discs.resize(buckets.first.back());
  std::vector<std::size_t> next(buckets.first.begin(), buckets.first.end() - 1);
  for (const Disc& disc : discs) {
    if (disc.outer >= 0) buckets.discs[next[buckets.of(front(disc))]++] = disc;
  }
  return buckets;
}

// Marks the spheres seen in the rows of one band, from the nearest to the farthest. A sphere is seen if a pixel of its
// disc is not yet covered. It then covers its pixels for all spheres that begin behind its surface.
void mark_seen(const Buckets& buckets, Coverage& coverage, float low, float high, std::vector<std::uint8_t>& seen) {
  constexpr std::uint32_t kNone = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> waiting(kBuckets, kNone);  // the last link of the discs that cover from this bucket on
  struct Link {
    std::uint32_t disc, previous;
  };
  std::vector<Link> links;
  for (std::size_t b = 0; b < kBuckets; ++b) {
    for (std::uint32_t link = waiting[b]; link != kNone; link = links[link].previous) {
      const Disc& disc = buckets.discs[links[link].disc];
      coverage.cover(disc.x, disc.y, kHidingShare * disc.inner);
    }
    for (std::size_t k = buckets.first[b]; k < buckets.first[b + 1]; ++k) {
      const Disc& disc = buckets.discs[k];
      if (disc.y + disc.outer < low || disc.y - disc.outer > high) continue;
      if (coverage.covers(disc.x, disc.y, disc.outer)) continue;
      seen[disc.sphere] = 1;
      const std::size_t from = std::max(b + 1, buckets.behind(disc.distance - kHidingDepth * disc.radius));
      if (from >= kBuckets || disc.inner <= 0) continue;
      links.push_back({static_cast<std::uint32_t>(k), waiting[from]});
      waiting[from] = static_cast<std::uint32_t>(links.size() - 1);
    }
  }
}

}  // namespace

Projection project(const Camera& camera, int width, int height) {
  HOOKE_ASSERT(width > 0 && height > 0, width, height);
  HOOKE_ASSERT(camera.field_of_view > 0 && camera.field_of_view < 180, camera.field_of_view);
  const CameraAxes own = axes(camera);
  const double half_angle = 0.5 * camera.field_of_view * std::numbers::pi / 180;
  Projection view;
  view.eye = vec_cast<float>(camera.eye);
  view.right = vec_cast<float>(own.right);
  view.up = vec_cast<float>(own.up);
  view.back = vec_cast<float>(own.back);
  view.width = static_cast<float>(width);
  view.height = static_cast<float>(height);
  view.scale = static_cast<float>(0.5 * height / std::tan(half_angle));
  view.nearest = static_cast<float>(1e-3 * std::sqrt(dot(camera.eye - camera.target, camera.eye - camera.target)));
  return view;
}

std::vector<std::uint32_t> visible_spheres(std::span<const Sphere> spheres, const Projection& view) {
  HOOKE_ASSERT(view.width > 0 && view.height > 0 && view.scale > 0, view.width, view.height, view.scale);
  HOOKE_ASSERT(view.parallel || view.nearest > 0, view.nearest);
  std::vector<Disc> discs(spheres.size());
  parallel_ranges(spheres.size(), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) discs[i] = project(spheres[i], static_cast<std::uint32_t>(i), view);
  });
  const Buckets buckets = sort_by_front(discs);

  // Bands share no pixel, so each band has its own coverage and marks.
  const int width = static_cast<int>(view.width), height = static_cast<int>(view.height);
  const int tiles = (height + Coverage::kTile - 1) / Coverage::kTile;
  const int rows = Coverage::kTile * ((tiles + static_cast<int>(kBands) - 1) / static_cast<int>(kBands));
  std::vector<std::vector<std::uint8_t>> seen(kBands, std::vector<std::uint8_t>(spheres.size()));
  parallel_ranges(kBands, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t band = first; band < last; ++band) {
      const int low = std::min(height, rows * static_cast<int>(band));
      const int high = std::min(height, low + rows);
      Coverage coverage(width, low, high);
      mark_seen(buckets, coverage, static_cast<float>(low), static_cast<float>(high), seen[band]);
    }
  });
  std::vector<std::uint32_t> visible;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (std::any_of(seen.begin(), seen.end(), [i](const auto& band) { return band[i] != 0; })) {
      visible.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return visible;
}

PixelRectangle bounds_on_picture(std::span<const Sphere> spheres, std::span<const std::uint32_t> chosen,
                                 const Projection& view) {
  float left = view.width, right = 0, low = view.height, high = 0;
  for (const std::uint32_t i : chosen) {
    HOOKE_ASSERT(i < spheres.size(), i, spheres.size());
    const Disc disc = project(spheres[i], i, view);
    left = std::min(left, disc.x - disc.outer);
    right = std::max(right, disc.x + disc.outer);
    low = std::min(low, disc.y - disc.outer);
    high = std::max(high, disc.y + disc.outer);
  }
  const auto pixel = [](float x, float most) { return static_cast<int>(std::clamp(x, 0.0f, most)); };
  PixelRectangle box{pixel(std::floor(left), view.width), pixel(std::floor(low), view.height), 0, 0};
  box.width = std::max(0, pixel(std::ceil(right), view.width) - box.x);
  box.height = std::max(0, pixel(std::ceil(high), view.height) - box.y);
  return box;
}

}  // namespace hooke::render
