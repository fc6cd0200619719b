// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/mesh_shape.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "hooke/base/assert.h"
#include "hooke/core/colliders.h"
#include "hooke/scene/json_path.h"
#include "hooke/scene/mesh_file.h"
#include "hooke/scene/scene_builder.h"
#include "hooke/scene/scene_path.h"
#include "hooke/volumes/mesh_field.h"

namespace hooke {
namespace {

// A gigabyte of samples.
constexpr double kMostSamples = 2.5e8;

// A cell is a third of the smallest radius, so features as thick as that radius are kept.
constexpr double kCellsPerRadius = 3;

void place(TriangleMesh& mesh, double scale, const Vec3d& rotation, const Vec3d& translation) {
  const auto axes = turned_axes(rotation);
  for (Vec3d& x : mesh.vertices) {
    const Vec3d at = scale * x;
    x = at.x * axes[0] + at.y * axes[1] + at.z * axes[2] + translation;
  }
}

}  // namespace

std::optional<MeshShape> read_mesh_shape(const Json& json, const std::string& where, const ShapeFiles& files,
                                         Findings& findings) {
  HOOKE_ASSERT(files.smallest_radius > 0 && files.reach > 0, where, files.smallest_radius, files.reach);
  const std::string file_at = join_path(where, "file");
  const auto file = find_scene_file(files.folder, json.at("file").get<std::string>(), files.allow_outside);
  const auto refuse = [&](const Error& error) {
    findings.add(file_at, fmt::format("is {}, which {}", brief(json.at("file")), error.findings.front().message));
    return std::nullopt;
  };
  if (!file) return refuse(file.error());
  auto mesh = read_mesh(*file);
  if (!mesh) return refuse(mesh.error());
  if (files.used != nullptr) files.used->push_back({json.at("file").get<std::string>(), *file});
  Vec3d rotation{0, 0, 0};
  if (const Json& turn = json.at("rotate"); turn[3].get<double>() != 0) {
    const Vec3d axis{turn[0].get<double>(), turn[1].get<double>(), turn[2].get<double>()};
    const double length = std::sqrt(dot(axis, axis));
    if (!(length > 0)) {
      findings.add(join_path(where, "rotate"),
                   fmt::format("is {}; the axis, its first three numbers, must not be 0", brief(turn)));
      return {};
    }
    rotation = (turn[3].get<double>() * (std::numbers::pi / 180) / length) * axis;
  }
  place(*mesh, json.at("scale").get<double>(), rotation, vec3_or(json.at("translate"), {}));

  FieldOptions options;
  options.cell = json.contains("voxel") ? json.at("voxel").get<double>() : files.smallest_radius / kCellsPerRadius;
  options.reach = files.reach;
  const std::size_t open_edges = count_open_edges(*mesh);
  options.closed = open_edges == 0;
  if (const double samples = expected_samples(*mesh, options); !(samples <= kMostSamples)) {
    findings.add(
        json.contains("voxel") ? join_path(where, "voxel") : where,
        fmt::format("has about {:.2g} samples of its distance, {:.3g} m apart; at most {:.2g} are possible, so "
                    "give a larger \"voxel\" or a smaller \"scale\"",
                    samples, options.cell, kMostSamples));
    return {};
  }
  if (open_edges > 0 && files.warnings != nullptr) {
    files.warnings->push_back({file_at, fmt::format("{} edges have a triangle on one side only: the mesh is open, a "
                                                    "shell that is touched from both sides",
                                                    open_edges)});
  }
  auto field = make_distance_field(*mesh, options);
  if (!field) {
    findings.add(where, std::move(field.error().findings.front().message));
    return {};
  }
  MeshShape shape;
  shape.field = std::make_shared<const DistanceField>(std::move(*field));
  shape.surface = std::make_shared<const TriangleMesh>(std::move(*mesh));
  return shape;
}

}  // namespace hooke
