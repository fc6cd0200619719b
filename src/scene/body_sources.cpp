// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The scene's "bodies": shapes filled with a face-centred cubic lattice whose nearest neighbours springs tie.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <unordered_map>

#include "hooke/scene/json_path.h"
#include "hooke/scene/scene_builder.h"
#include "hooke/scene/structure_maker.h"

namespace hooke {
namespace {

// A box around a shape, and what of it the shape holds.
struct Filling {
  Vec3d min, max;
  double radius = 0;  // of a sphere; 0: all of the box

  bool holds(const Vec3d& x) const {
    if (radius == 0) return true;
    const Vec3d off = x - 0.5 * (min + max);
    return dot(off, off) <= radius * radius * (1 + 1e-12);
  }
};

// Sites of a face-centred cubic lattice: those points of a cubic one, half a cell apart, whose indices add up to an
// even number. One of them is in the middle of a sphere, and at the lower corner of a box.
class Lattice {
 public:
  Lattice(const Filling& filling, double spacing) : step_(spacing / std::sqrt(2.0)) {
    origin_ = filling.min;
    for (int axis = 0; axis < 3; ++axis) {
      const double length = component(filling.max, axis) - component(filling.min, axis);
      if (filling.radius > 0) {
        const double half = std::floor(filling.radius / step_ * (1 + 1e-12));
        count_[static_cast<std::size_t>(axis)] = 2 * half + 1;
        component(origin_, axis) = component(filling.min, axis) + filling.radius - half * step_;
        middle_ += static_cast<std::int64_t>(half);
      } else {
        count_[static_cast<std::size_t>(axis)] = std::floor(length / step_ * (1 + 1e-12)) + 1;
      }
    }
  }

  double expected() const { return count_[0] * count_[1] * count_[2] / 2; }
  std::array<std::int64_t, 3> count() const {
    return {static_cast<std::int64_t>(count_[0]), static_cast<std::int64_t>(count_[1]),
            static_cast<std::int64_t>(count_[2])};
  }
  bool is_site(std::int64_t x, std::int64_t y, std::int64_t z) const { return (x + y + z + middle_) % 2 == 0; }
  Vec3d at(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return origin_ + step_ * Vec3d{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
  }
  std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return static_cast<std::uint64_t>((z * count()[1] + y) * count()[0] + x);
  }

 private:
  double step_;
  Vec3d origin_{};
  std::array<double, 3> count_{};
  std::int64_t middle_ = 0;
};

Filling filling_of(const Json& shape) {
  if (shape.contains("box")) return {vec3_or(shape.at("box").at("min"), {}), vec3_or(shape.at("box").at("max"), {})};
  const Vec3d center = vec3_or(shape.at("sphere").at("center"), {});
  const double r = shape.at("sphere").at("radius").get<double>();
  return {center - Vec3d{r, r, r}, center + Vec3d{r, r, r}, r};
}

// Six of the twelve nearest neighbours; the others see it from their side.
constexpr int kForward[6][3] = {{1, 1, 0}, {-1, 1, 0}, {1, 0, 1}, {-1, 0, 1}, {0, 1, 1}, {0, -1, 1}};

void fill(StructureMaker& maker, const Json& entry, const Filling& filling, std::uint16_t material,
          const std::string& path) {
  const double spacing = entry.at("spacing").get<double>();
  const Lattice lattice(filling, spacing);
  if (!maker.fits(lattice.expected(), 6 * lattice.expected(), path)) return;
  const auto [nx, ny, nz] = lattice.count();
  std::unordered_map<std::uint64_t, std::uint64_t> index;  // of sites
  std::vector<Vec3d> centres;
  std::vector<std::array<std::int64_t, 3>> sites;
  for (std::int64_t z = 0; z < nz; ++z) {
    for (std::int64_t y = 0; y < ny; ++y) {
      for (std::int64_t x = 0; x < nx; ++x) {
        if (!lattice.is_site(x, y, z) || !filling.holds(lattice.at(x, y, z))) continue;
        index.emplace(lattice.key(x, y, z), centres.size());
        centres.push_back(lattice.at(x, y, z));
        sites.push_back({x, y, z});
      }
    }
  }
  const std::uint64_t first = maker.add_particles(centres, material, vec3_or(entry.at("velocity"), {}), path);
  Spring spring;
  spring.rest_length = spacing;
  spring.stiffness = entry.at("stiffness").get<double>();
  spring.damping = entry.at("damping").get<double>();
  spring.break_strain = break_strain_of(entry);
  spring.contact = false;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (const auto& step : kForward) {
      const std::int64_t x = sites[i][0] + step[0], y = sites[i][1] + step[1], z = sites[i][2] + step[2];
      if (x < 0 || x >= nx || y < 0 || y >= ny || z >= nz) continue;
      const auto other = index.find(lattice.key(x, y, z));
      if (other == index.end()) continue;
      spring.a = first + i;
      spring.b = first + other->second;
      maker.structure.springs.push_back(spring);
    }
  }
}

}  // namespace

void StructureMaker::add_bodies(const Json& bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::string path = join_path("bodies", i);
    const auto material = bodies[i].is_object() ? material_of(bodies[i], path) : std::nullopt;
    if (findings.touches(path) || !material) continue;
    const Filling filling = filling_of(bodies[i].at("shape"));
    bool empty = false;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = component(filling.min, axis), high = component(filling.max, axis);
      if (low <= high) continue;
      findings.add(join_path(join_path(path, "shape"), "box"),
                   fmt::format("has min[{}] = {} above max[{}] = {}", axis, low, axis, high));
      empty = true;
    }
    if (!empty && options.with_particles) fill(*this, bodies[i], filling, *material, path);
  }
}

}  // namespace hooke
