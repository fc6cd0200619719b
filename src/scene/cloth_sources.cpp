// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The scene's "cloths": grids and meshes of particles. Springs tie neighbours (stretch), diagonals (shear) and second
// neighbours (bend); Provot, "Deformation constraints in a mass-spring model", 1995.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "hooke/scene/cloth_mesh.h"
#include "hooke/scene/json_path.h"
#include "hooke/scene/mesh_repair.h"
#include "hooke/scene/scene_builder.h"
#include "hooke/scene/scene_path.h"
#include "hooke/scene/structure_maker.h"

namespace hooke::scene {
namespace {

// One cloth being made: the positions of its particles, its springs and its surface.
class Cloth {
 public:
  Cloth(StructureMaker& maker, const Json& entry, std::string path)
      : maker_(maker),
        entry_(entry),
        path_(std::move(path)) {
    spring_.damping = entry.at("damping").get<double>();
    spring_.break_strain = break_strain_of(entry);
    spring_.contact = false;
    stretch_ = entry.at("stretch").get<double>();
    shear_ = entry.at("shear").get<double>();
    bend_ = entry.at("bend").get<double>();
  }

  void make_grid(std::uint16_t material) {
    const Vec3d corner = vec3_or(entry_.at("corner"), {});
    const Vec3d along[2] = {vec3_or(entry_.at("edges")[0], {}), vec3_or(entry_.at("edges")[1], {})};
    for (std::size_t k = 0; k < 2; ++k) cells_[k] = entry_.at("cells")[k].get<std::uint64_t>();
    const double count = static_cast<double>(cells_[0] + 1) * static_cast<double>(cells_[1] + 1);
    if (!maker_.fits(count, 6 * count, path_)) return;
    std::vector<Vec3d> at;
    for (std::uint64_t j = 0; j <= cells_[1]; ++j) {
      for (std::uint64_t i = 0; i <= cells_[0]; ++i) {
        at.push_back(corner + (static_cast<double>(i) / static_cast<double>(cells_[0])) * along[0] +
                     (static_cast<double>(j) / static_cast<double>(cells_[1])) * along[1]);
      }
    }
    add_particles(std::move(at), material);
    for (std::uint64_t j = 0; j <= cells_[1]; ++j) {
      for (std::uint64_t i = 0; i <= cells_[0]; ++i) tie_grid(i, j);
    }
    add_surface(material, grid_triangles());
    pin();
  }

  void make_mesh(const ClothMesh& cloth, std::uint16_t material) {
    const TriangleMesh& mesh = cloth.mesh;
    const auto corners = static_cast<double>(mesh.vertices.size());
    if (!maker_.fits(corners, 6 * corners, path_)) return;
    add_particles(mesh.vertices, material);
    vertex_ = cloth.vertex;
    // The corners opposite each edge, on one or two sides.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> facing;
    for (const auto& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) facing[std::minmax(t[k], t[(k + 1) % 3])].push_back(t[(k + 2) % 3]);
    }
    for (const auto& [edge, apexes] : facing) tie(edge.first, edge.second, stretch_);
    std::set<std::pair<std::uint32_t, std::uint32_t>> bent;
    for (const auto& [edge, apexes] : facing) {
      if (apexes.size() != 2 || apexes[0] == apexes[1]) continue;
      const std::pair<std::uint32_t, std::uint32_t> pair = std::minmax(apexes[0], apexes[1]);
      if (!facing.contains(pair) && bent.insert(pair).second) tie(pair.first, pair.second, bend_);
    }
    std::vector<std::uint32_t> triangles;
    for (const auto& t : mesh.triangles) triangles.insert(triangles.end(), t.begin(), t.end());
    add_surface(material, std::move(triangles));
    pin();
  }

 private:
  std::uint64_t index_of(std::uint64_t i, std::uint64_t j) const { return j * (cells_[0] + 1) + i; }

  void add_particles(std::vector<Vec3d> at, std::uint16_t material) {
    first_ = maker_.add_particles(at, material, vec3_or(entry_.at("velocity"), {}), path_);
    at_ = std::move(at);
  }

  void tie(std::uint64_t a, std::uint64_t b, double stiffness) {
    if (stiffness == 0) return;
    const Vec3d d = at_[a] - at_[b];
    spring_.a = first_ + a;
    spring_.b = first_ + b;
    spring_.rest_length = std::sqrt(dot(d, d));
    spring_.stiffness = stiffness;
    if (!(spring_.rest_length > 0)) {
      if (!maker_.findings.touches(path_)) {
        maker_.findings.add(path_, fmt::format("has its particles {} and {} in one place", a, b));
      }
      return;
    }
    maker_.structure.springs.push_back(spring_);
  }

  void tie_grid(std::uint64_t i, std::uint64_t j) {
    const bool right = i + 1 <= cells_[0], up = j + 1 <= cells_[1];
    const std::uint64_t own = index_of(i, j);
    if (right) tie(own, index_of(i + 1, j), stretch_);
    if (up) tie(own, index_of(i, j + 1), stretch_);
    if (right && up) {
      tie(own, index_of(i + 1, j + 1), shear_);
      tie(index_of(i + 1, j), index_of(i, j + 1), shear_);
    }
    if (i + 2 <= cells_[0]) tie(own, index_of(i + 2, j), bend_);
    if (j + 2 <= cells_[1]) tie(own, index_of(i, j + 2), bend_);
  }

  std::vector<std::uint32_t> grid_triangles() const {
    std::vector<std::uint32_t> triangles;
    for (std::uint64_t j = 0; j < cells_[1]; ++j) {
      for (std::uint64_t i = 0; i < cells_[0]; ++i) {
        const auto a = static_cast<std::uint32_t>(index_of(i, j)), b = static_cast<std::uint32_t>(index_of(i + 1, j));
        const auto c = static_cast<std::uint32_t>(index_of(i + 1, j + 1));
        const auto d = static_cast<std::uint32_t>(index_of(i, j + 1));
        triangles.insert(triangles.end(), {a, b, c, a, c, d});
      }
    }
    return triangles;
  }

  void add_surface(std::uint16_t material, std::vector<std::uint32_t> triangles) {
    Surface surface;
    surface.name = maker_.scene.materials[material].name;
    for (std::size_t i = 0; i < at_.size(); ++i) surface.particles.push_back(first_ + i);
    surface.triangles = std::move(triangles);
    maker_.structure.surfaces.push_back(std::move(surface));
  }

  void hold(std::uint64_t index) {
    maker_.structure.pinned.push_back(first_ + index);
    maker_.particles.velocity[maker_.particles.find(first_ + index)] = {0, 0, 0};
  }

  void pin() {
    const Json& pins = entry_.at("pins");
    for (std::size_t k = 0; k < pins.size(); ++k) {
      const std::string where = join_path(join_path(path_, "pins"), k);
      if (pins[k].is_number()) {
        pin_number(pins[k].get<std::uint64_t>(), where);
      } else if (cells_[0] == 0) {
        maker_.findings.add(where,
                            fmt::format("is {}; a mesh has no sides: its pins are numbers of corners", pins[k].dump()));
      } else {
        pin_side(pins[k].get<std::string>());
      }
    }
  }

  // The number of a particle of a grid, or of a corner of a mesh as its file counts them.
  void pin_number(std::uint64_t index, const std::string& where) {
    const bool is_mesh = cells_[0] == 0;
    const std::size_t count = is_mesh ? vertex_.size() : at_.size();
    if (index >= count) {
      maker_.findings.add(
          where, fmt::format("is {}; the cloth has {} 0 to {}", index, is_mesh ? "corners" : "particles", count - 1));
    } else if (is_mesh && vertex_[index] == kUnused) {
      maker_.findings.add(where, fmt::format("is {}, a corner that no face uses: it is no particle", index));
    } else {
      hold(is_mesh ? vertex_[index] : index);
    }
  }

  // "corner:0,1" or "edge:2"; the schema has checked the form.
  void pin_side(const std::string& name) {
    const auto digit = [&name](std::size_t at) { return static_cast<std::uint64_t>(name[at] - '0'); };
    if (name.starts_with("corner")) return hold(index_of(digit(7) * cells_[0], digit(9) * cells_[1]));
    const std::uint64_t side = digit(5), along = side % 2, end = side / 2;
    for (std::uint64_t k = 0; k <= cells_[along]; ++k) {
      hold(along == 0 ? index_of(k, end * cells_[1]) : index_of(end * cells_[0], k));
    }
  }

  StructureMaker& maker_;
  const Json& entry_;
  std::string path_;
  Spring spring_;
  double stretch_, shear_, bend_;
  std::uint64_t cells_[2] = {0, 0};  // 0 for a mesh
  std::uint64_t first_ = 0;
  std::vector<Vec3d> at_;
  std::vector<std::uint32_t> vertex_;  // of each corner of a mesh's file
};

// Whether the entry has all that a grid needs.
bool is_whole_grid(const Json& entry, const std::string& path, Findings& findings) {
  bool whole = true;
  for (const char* key : {"corner", "edges"}) {
    if (entry.contains(key) || findings.touches_at(join_path(path, key))) continue;
    findings.add(join_path(path, key), "is missing; a grid needs \"corner\", \"edges\" and \"cells\"");
    whole = false;
  }
  return whole;
}

std::optional<ClothMesh> mesh_of(StructureMaker& maker, const Json& entry, const std::string& path) {
  const auto& name = entry.at("mesh").get_ref<const std::string&>();
  const auto refuse = [&](const std::string& why) {
    maker.findings.add(join_path(path, "mesh"), fmt::format("is \"{}\", which {}", printable(name), why));
    return std::nullopt;
  };
  for (const char* key : {"corner", "edges"}) {
    if (entry.contains(key)) maker.findings.add(join_path(path, key), "is of no use beside \"mesh\"");
  }
  if (!maker.options.with_particles) return std::nullopt;
  const auto file = find_scene_file(maker.folder, name, maker.options.allow_outside);
  if (!file) return refuse(file.error().findings.front().message);
  auto mesh = read_cloth_mesh(*file);
  if (!mesh) return refuse(mesh.error().findings.front().message);
  for (const std::string& warning : mesh->warnings) {
    maker.warnings.push_back({join_path(path, "mesh"), fmt::format("is \"{}\", which {}", printable(name), warning)});
  }
  return std::move(*mesh);
}

}  // namespace

void StructureMaker::add_cloths(const Json& cloths) {
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    const std::string path = join_path("cloths", i);
    const auto material = cloths[i].is_object() ? material_of(cloths[i], path) : std::nullopt;
    if (!material || findings.touches(path)) continue;
    if (cloths[i].contains("mesh")) {
      if (const auto mesh = mesh_of(*this, cloths[i], path)) Cloth(*this, cloths[i], path).make_mesh(*mesh, *material);
    } else if (is_whole_grid(cloths[i], path, findings) && options.with_particles) {
      Cloth(*this, cloths[i], path).make_grid(*material);
    }
    end_group(path);
  }
}

}  // namespace hooke::scene
