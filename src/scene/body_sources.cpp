// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The scene's "bodies": shapes filled with a face-centred cubic lattice whose nearest neighbours are tied by springs.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <unordered_map>

#include "hooke/physics/enclosure.h"
#include "hooke/scene/json_path.h"
#include "hooke/scene/mesh_shape.h"
#include "hooke/scene/scene_builder.h"
#include "hooke/scene/structure_maker.h"

namespace hooke::scene {
namespace {

// The box around a shape, and which part of the box the shape fills.
struct Filling {
  Vec3d min, max;
  double radius = 0;                          // of a sphere
  std::shared_ptr<const DistanceField> mesh;  // or of a mesh; else all of the box

  bool is_box() const { return radius == 0 && !mesh; }
};

bool is_inside(const Filling& filling, const Vec3d& x) {
  if (filling.mesh) return encloses(filling.mesh->view(), x - filling.mesh->origin);
  if (filling.radius == 0) return true;
  const Vec3d off = x - 0.5 * (filling.min + filling.max);
  return dot(off, off) <= filling.radius * filling.radius * (1 + 1e-12);
}

// Sites of a face-centred cubic lattice: the points of a cubic lattice, half a cell apart, whose indices have an even
// sum. One site is at the lower corner of a box, or in the middle of the box around any other shape.
class Lattice {
 public:
  Lattice(const Filling& filling, double spacing) : step_(spacing / std::sqrt(2.0)) {
    origin_ = filling.min;
    for (int axis = 0; axis < 3; ++axis) {
      const double length = component(filling.max, axis) - component(filling.min, axis);
      if (!filling.is_box()) {
        const double half = std::floor(length / 2 / step_ * (1 + 1e-12));
        count_[static_cast<std::size_t>(axis)] = 2 * half + 1;
        component(origin_, axis) = component(filling.min, axis) + length / 2 - half * step_;
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

std::optional<Filling> filling_of_mesh(StructureMaker& maker, const Json& json, double spacing,
                                       const std::string& where) {
  if (!maker.options.with_particles) return std::nullopt;
  // Samples are a third of the spacing apart, known to one spacing from the surface.
  ShapeFiles files{maker.folder, maker.options.allow_outside, spacing, spacing};
  files.warnings = &maker.warnings;
  files.depth = 1;
  files.memory = &maker.fields;
  files.kept = false;
  files.memory_limit = maker.options.memory_limit;
  files.opening = ShapeFiles::Opening::refused;
  const auto mesh = read_mesh_shape(json, where, files, maker.findings);
  if (!mesh) return std::nullopt;
  return Filling{mesh->field->min, mesh->field->max, 0, mesh->field};
}

std::optional<Filling> filling_of_box(StructureMaker& maker, const Json& json, const std::string& where) {
  const Filling filling{vec3_or(json.at("min"), {}), vec3_or(json.at("max"), {}), 0, nullptr};
  for (int axis = 0; axis < 3; ++axis) {
    const double low = component(filling.min, axis), high = component(filling.max, axis);
    if (low <= high) continue;
    maker.findings.add(where, fmt::format("has min[{}] = {} above max[{}] = {}", axis, low, axis, high));
  }
  return maker.findings.touches(where) ? std::nullopt : std::optional(filling);
}

// What the body's "shape" at the path `where` fills. Empty, with findings, where it can't be made.
std::optional<Filling> filling_of(StructureMaker& maker, const Json& shape, double spacing, const std::string& where) {
  if (shape.contains("mesh")) return filling_of_mesh(maker, shape.at("mesh"), spacing, join_path(where, "mesh"));
  if (shape.contains("box")) return filling_of_box(maker, shape.at("box"), join_path(where, "box"));
  const Vec3d center = vec3_or(shape.at("sphere").at("center"), {});
  const double r = shape.at("sphere").at("radius").get<double>();
  return Filling{center - Vec3d{r, r, r}, center + Vec3d{r, r, r}, r, nullptr};
}

// Six of the twelve nearest neighbours; the other six pairs are found from the neighbour's side.
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
        if (!lattice.is_site(x, y, z) || !is_inside(filling, lattice.at(x, y, z))) continue;
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
    const double spacing = bodies[i].at("spacing").get<double>();
    const auto filling = filling_of(*this, bodies[i].at("shape"), spacing, join_path(path, "shape"));
    if (!filling || !options.with_particles) continue;
    fill(*this, bodies[i], *filling, *material, path);
    end_group(path);
  }
}

}  // namespace hooke::scene
