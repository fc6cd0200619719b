// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/polygon_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace hooke::scene {
namespace {

// Cutting ears takes time with the square of the corners.
constexpr std::size_t kMostCornersToClip = 1024;

using Flat = std::array<double, 2>;  // a corner in the plane of its face

double turn(const Flat& a, const Flat& b, const Flat& c) {
  return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]);
}

// The corners seen along the axis that the face is most square to, against the clock.
std::vector<Flat> flattened(std::span<const Vec3d> corners) {
  Vec3d normal{0, 0, 0};  // twice the area (Newell)
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    normal += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  }
  const Vec3d size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  int first = (axis + 1) % 3, second = (axis + 2) % 3;
  if (component(normal, axis) < 0) std::swap(first, second);
  std::vector<Flat> flat;
  flat.reserve(corners.size());
  for (const Vec3d& x : corners) {
    const Vec3d off = x - corners[0];
    flat.push_back({component(off, first), component(off, second)});
  }
  return flat;
}

bool is_convex(std::span<const Flat> corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (turn(corners[i], corners[(i + 1) % n], corners[(i + 2) % n]) < 0) return false;
  }
  return true;
}

// Cuts triangles off a polygon, an ear at a time (Meisters, "Polygons have ears", Amer. Math. Monthly 82, 648, 1975).
class EarClipper {
 public:
  explicit EarClipper(std::span<const Flat> corners) : at_(corners), links_(corners.size()), ear_(corners.size()) {
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) links_[i] = {(i + n - 1) % n, (i + 1) % n};
    for (std::size_t i = 0; i < n; ++i) ear_[i] = is_ear(i);
  }

  // Calls emit(a, b, c) for each triangle.
  template <class Emit>
  void clip(const Emit& emit) {
    std::size_t tip = 0;
    for (std::size_t left = at_.size(); left > 3; --left) {
      // A polygon that crosses itself may have no ear; then any corner is cut off.
      for (std::size_t tried = 0; tried < left && !ear_[tip]; ++tried) tip = links_[tip].after;
      const auto [before, after] = links_[tip];
      emit(before, tip, after);
      links_[before].after = after;
      links_[after].before = before;
      ear_[before] = is_ear(before);
      ear_[after] = is_ear(after);
      tip = after;
    }
    emit(links_[tip].before, tip, links_[tip].after);
  }

 private:
  struct Links {
    std::size_t before, after;
  };

  bool is_ear(std::size_t tip) const {
    const auto [before, after] = links_[tip];
    const Flat &a = at_[before], &b = at_[tip], &c = at_[after];
    if (!(turn(a, b, c) > 0)) return false;
    for (std::size_t i = links_[after].after; i != before; i = links_[i].after) {
      const Flat& x = at_[i];
      if (x == a || x == b || x == c) continue;
      if (turn(a, b, x) >= 0 && turn(b, c, x) >= 0 && turn(c, a, x) >= 0) return false;
    }
    return true;
  }

  std::span<const Flat> at_;
  std::vector<Links> links_;
  std::vector<char> ear_;
};

}  // namespace

TriangleMesh cut_into_triangles(PolygonMesh&& polygons) {
  TriangleMesh mesh;
  mesh.vertices = std::move(polygons.vertices);
  mesh.triangles.reserve(polygons.corners.size() - 2 * polygons.ends.size());
  std::vector<Vec3d> places;
  std::size_t begin = 0;
  for (const std::size_t end : polygons.ends) {
    const std::span<const std::uint32_t> face(polygons.corners.data() + begin, end - begin);
    begin = end;
    const auto emit = [&](std::size_t a, std::size_t b, std::size_t c) {
      mesh.triangles.push_back({face[a], face[b], face[c]});
    };
    if (face.size() == 3) {
      emit(0, 1, 2);
      continue;
    }
    places.clear();
    for (const std::uint32_t v : face) places.push_back(mesh.vertices[v]);
    const std::vector<Flat> flat = flattened(places);
    if (is_convex(flat)) {
      for (std::size_t k = 2; k < face.size(); ++k) emit(0, k - 1, k);
      continue;
    }
    if (face.size() > kMostCornersToClip) {
      throw FileFault(0, fmt::format("holds a face of {} corners that is not convex; it may have {} at most",
                                     face.size(), kMostCornersToClip));
    }
    EarClipper(flat).clip(emit);
  }
  return mesh;
}

}  // namespace hooke::scene
