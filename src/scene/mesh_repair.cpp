// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/mesh_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include "hooke/base/box3.h"
#include "hooke/base/hash.h"

namespace hooke::scene {
namespace {

constexpr double kOfSize = 1e-5, kOfEdge = 0.1;  // the tolerance of a weld

struct HashOfThree {
  template <class T>
  std::size_t operator()(const std::array<T, 3>& key) const {
    std::uint64_t hash = 0;
    for (const T& part : key) {
      if constexpr (std::is_same_v<T, double>) {
        hash = combine64(hash, std::bit_cast<std::uint64_t>(part));
      } else {
        hash = combine64(hash, static_cast<std::uint64_t>(part));
      }
    }
    return hash;
  }
};

// Gives each triangle other vertices, and drops those that lose a corner by it.
void rename_vertices(TriangleMesh& mesh, const std::vector<std::uint32_t>& name) {
  auto kept = mesh.triangles.begin();
  for (auto t : mesh.triangles) {
    for (std::uint32_t& v : t) v = name[v];
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) *kept++ = t;
  }
  mesh.triangles.erase(kept, mesh.triangles.end());
}

std::vector<std::uint32_t> own_names(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> name(mesh.vertices.size());
  std::iota(name.begin(), name.end(), 0U);
  return name;
}

// Calls visit(a, b, count) for each edge, in ascending order, with the number of its triangles.
template <class Visit>
void for_each_edge(const TriangleMesh& mesh, const Visit& visit) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(t[k], t[(k + 1) % 3]);
      edges.push_back(std::uint64_t{a} << 32U | b);
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    while (last < edges.size() && edges[last] == edges[first]) ++last;
    visit(static_cast<std::uint32_t>(edges[first] >> 32U), static_cast<std::uint32_t>(edges[first]), last - first);
  }
}

double distance_of(const Vec3d& a, const Vec3d& b) { return std::sqrt(dot(a - b, a - b)); }

// The vertices on edges of one triangle, ascending, and how near to each other they may be.
struct Rim {
  std::vector<std::uint32_t> vertices;
  double tolerance = 0;
};

Rim rim_of(const TriangleMesh& mesh) {
  Rim rim;
  double shortest = std::numeric_limits<double>::infinity();
  for_each_edge(mesh, [&](std::uint32_t a, std::uint32_t b, std::size_t count) {
    if (count != 1) return;
    rim.vertices.insert(rim.vertices.end(), {a, b});
    const double length = distance_of(mesh.vertices[a], mesh.vertices[b]);
    if (length > 0) shortest = std::min(shortest, length);
  });
  if (rim.vertices.empty()) return rim;
  std::sort(rim.vertices.begin(), rim.vertices.end());
  rim.vertices.erase(std::unique(rim.vertices.begin(), rim.vertices.end()), rim.vertices.end());
  Box3d box = Box3d::none();
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) box.add(mesh.vertices[v]);
  }
  rim.tolerance = std::min(kOfSize * distance_of(box.min, box.max), kOfEdge * shortest);
  return rim;
}

// Points that are further apart than a tolerance, in cubes of this size: a cube holds few.
class SparsePoints {
 public:
  SparsePoints(const std::vector<Vec3d>& places, double tolerance) : places_(places), tolerance_(tolerance) {}

  // The first point that was added near `v`; else adds `v` and returns it.
  std::uint32_t find_or_add(std::uint32_t v) {
    const auto own = cube_of(places_[v]);
    for (int i = 0; i < 27; ++i) {
      const auto near = cubes_.find({own[0] + i % 3 - 1, own[1] + i / 3 % 3 - 1, own[2] + i / 9 - 1});
      if (near == cubes_.end()) continue;
      for (const std::uint32_t other : near->second) {
        if (distance_of(places_[other], places_[v]) <= tolerance_) return other;
      }
    }
    cubes_[own].push_back(v);
    return v;
  }

 private:
  // Whole numbers, as doubles so that none is too large.
  std::array<double, 3> cube_of(const Vec3d& x) const {
    const auto part = [this](double c) { return std::floor(c / tolerance_) + 0.0; };
    return {part(x.x), part(x.y), part(x.z)};
  }

  const std::vector<Vec3d>& places_;
  double tolerance_;
  std::unordered_map<std::array<double, 3>, std::vector<std::uint32_t>, HashOfThree> cubes_;
};

// Returns how many triangles were there already.
std::size_t drop_doubled_triangles(TriangleMesh& mesh) {
  std::unordered_set<std::array<std::uint32_t, 3>, HashOfThree> known;
  known.reserve(mesh.triangles.size());
  const std::size_t before = mesh.triangles.size();
  std::erase_if(mesh.triangles, [&](const std::array<std::uint32_t, 3>& t) {
    auto turned = t;  // its lowest corner first
    std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
    return !known.insert(turned).second;
  });
  return before - mesh.triangles.size();
}

// "1 vertex", "2 vertices"
std::string counted(std::size_t count, const char* one, const char* several) {
  return fmt::format("{} {}", count, count == 1 ? one : several);
}

}  // namespace

void merge_equal_vertices(TriangleMesh& mesh) {
  std::unordered_map<std::array<double, 3>, std::uint32_t, HashOfThree> first;
  std::vector<std::uint32_t> name = own_names(mesh);
  for (std::uint32_t& v : name) {
    const Vec3d& x = mesh.vertices[v];
    v = first.try_emplace({x.x + 0.0, x.y + 0.0, x.z + 0.0}, v).first->second;
  }
  rename_vertices(mesh, name);
}

std::vector<std::uint32_t> mend(TriangleMesh& mesh, std::vector<std::string>& warnings) {
  std::size_t doubled = drop_doubled_triangles(mesh);
  if (doubled > 0) {
    warnings.push_back(
        fmt::format("holds {} more than once; each counts once", counted(doubled, "triangle", "triangles")));
  }
  std::vector<std::uint32_t> name = own_names(mesh);
  const Rim rim = rim_of(mesh);
  if (!(rim.tolerance > 0)) return name;
  SparsePoints points(mesh.vertices, rim.tolerance);
  std::size_t welded = 0;
  for (const std::uint32_t v : rim.vertices) {
    name[v] = points.find_or_add(v);
    if (name[v] != v) ++welded;
  }
  if (welded == 0) return name;
  rename_vertices(mesh, name);
  drop_doubled_triangles(mesh);
  warnings.push_back(fmt::format("has open edges with {} within {:.2g} of others, in the file's unit; they are welded",
                                 counted(welded, "vertex", "vertices"), rim.tolerance));
  return name;
}

std::vector<std::uint32_t> drop_unused_vertices(TriangleMesh& mesh) {
  std::vector<std::uint32_t> name(mesh.vertices.size(), kUnused);
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) name[v] = 0;
  }
  std::uint32_t next = 0;
  for (std::size_t v = 0; v < name.size(); ++v) {
    if (name[v] == kUnused) continue;
    mesh.vertices[next] = mesh.vertices[v];
    name[v] = next++;
  }
  mesh.vertices.resize(next);
  for (auto& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = name[v];
  }
  return name;
}

OpenEdges open_edges(const TriangleMesh& mesh) {
  OpenEdges open;
  for_each_edge(mesh, [&open](std::uint32_t, std::uint32_t, std::size_t count) {
    if (count == 1) ++open.single;
    if (count > 1 && count % 2 == 1) ++open.odd;
  });
  return open;
}

}  // namespace hooke::scene
