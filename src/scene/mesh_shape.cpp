// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/mesh_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hooke/base/assert.h"
#include "hooke/core/colliders.h"
#include "hooke/scene/available_memory.h"
#include "hooke/scene/json_path.h"
#include "hooke/scene/mesh_file.h"
#include "hooke/scene/mesh_repair.h"
#include "hooke/scene/scene_builder.h"
#include "hooke/scene/scene_path.h"
#include "hooke/volumes/mesh_field.h"

namespace hooke::scene {
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

// "3 edges have one triangle, 2 edges have an odd number of triangles": what a mesh with such edges is.
std::string in_words(const OpenEdges& open) {
  std::string words;
  const auto add = [&words](std::size_t count, const char* what) {
    if (count == 0) return;
    words +=
        fmt::format("{}{} {} {}", words.empty() ? "" : " and ", count, count == 1 ? "edge has" : "edges have", what);
  };
  add(open.single, "a triangle on one side only");
  add(open.odd, "three triangles or another odd number");
  return words;
}

class MeshShapeReader {
 public:
  MeshShapeReader(const Json& json, const std::string& where, const ShapeFiles& files, Findings& findings)
      : json_(json),
        where_(where),
        file_at_(join_path(where, "file")),
        files_(files),
        findings_(findings) {}

  std::optional<MeshShape> read() {
    auto mesh = read_file();
    if (!mesh) return {};
    const auto rotation = read_rotation();
    if (!rotation) return {};
    place(*mesh, json_.at("scale").get<double>(), *rotation, vec3_or(json_.at("translate"), {}));

    volumes::FieldOptions options;
    options.cell = json_.contains("voxel") ? json_.at("voxel").get<double>() : files_.smallest_radius / kCellsPerRadius;
    options.reach = files_.reach;
    options.depth = files_.depth;
    if (!check_closed(*mesh, options) || !is_small_enough(*mesh, options)) return {};
    auto field = volumes::make_distance_field(*mesh, options);
    if (!field) {
      findings_.add(where_, std::move(field.error().findings.front().message));
      return {};
    }
    book(*field);
    MeshShape shape;
    shape.field = std::make_shared<const DistanceField>(std::move(*field));
    shape.surface = std::make_shared<const TriangleMesh>(std::move(*mesh));
    return shape;
  }

 private:
  std::string about_file(const std::string& what) const {
    return fmt::format("is {}, which {}", brief(json_.at("file")), what);
  }

  std::optional<TriangleMesh> read_file() {
    const auto& name = json_.at("file").get_ref<const std::string&>();
    const auto refuse = [&](const Error& error) {
      findings_.add(file_at_, about_file(error.findings.front().message));
      return std::nullopt;
    };
    const auto file = find_scene_file(files_.folder, name, files_.allow_outside);
    if (!file) return refuse(file.error());
    std::vector<std::string> warnings;
    auto mesh = read_mesh(*file, &warnings);
    if (!mesh) return refuse(mesh.error());
    if (files_.used != nullptr) files_.used->push_back({name, *file});
    for (const std::string& warning : warnings) warn(about_file(warning));
    return std::move(*mesh);
  }

  void book(const DistanceField& field) const {
    if (files_.memory == nullptr) return;
    FieldMemory& memory = *files_.memory;
    memory.most =
        std::max(memory.most, memory.kept + volumes::kBytesPerSampleMade * static_cast<double>(field.samples.size()));
    if (files_.kept) memory.kept += static_cast<double>(field.bytes());
  }

  void warn(std::string message) {
    if (files_.warnings != nullptr) files_.warnings->push_back({file_at_, std::move(message)});
  }

  // A vector along the axis whose length is the angle, rad.
  std::optional<Vec3d> read_rotation() {
    const Json& turn = json_.at("rotate");
    if (turn[3].get<double>() == 0) return Vec3d{0, 0, 0};
    const Vec3d axis{turn[0].get<double>(), turn[1].get<double>(), turn[2].get<double>()};
    const double length = std::sqrt(dot(axis, axis));
    if (length > 0) return (turn[3].get<double>() * (std::numbers::pi / 180) / length) * axis;
    findings_.add(join_path(where_, "rotate"),
                  fmt::format("is {}; the axis, its first three numbers, must not be 0", brief(turn)));
    return {};
  }

  // Decides whether the mesh encloses a space. False, with a finding, where it must and does not.
  bool check_closed(const TriangleMesh& mesh, volumes::FieldOptions& options) {
    const OpenEdges open = open_edges(mesh);
    options.closed = open.single == 0 && open.odd == 0;
    if (options.closed || files_.opening == ShapeFiles::Opening::allowed) return true;
    if (files_.opening == ShapeFiles::Opening::warned_of) {
      warn(in_words(open) + ": the mesh is open, a shell that is touched from both sides");
      return true;
    }
    findings_.add(file_at_,
                  about_file(fmt::format("is open: {}; a body needs a mesh that encloses a space", in_words(open))));
    return false;
  }

  bool is_small_enough(const TriangleMesh& mesh, const volumes::FieldOptions& options) {
    const std::string at = json_.contains("voxel") ? join_path(where_, "voxel") : where_;
    constexpr const char* kAdvice = "so give a larger \"voxel\" or a smaller \"scale\"";
    if (!volumes::spans_few_cells(mesh, options)) {
      findings_.add(at, fmt::format("spans too many samples of its distance, {:.3g} m apart; {} along each axis are "
                                    "possible, {}",
                                    options.cell, DistanceFieldView::kMostBricks * DistanceFieldView::kCells, kAdvice));
      return false;
    }
    const double samples = volumes::expected_samples(mesh, options, kMostSamples);
    const std::uint64_t limit = files_.memory_limit != 0 ? files_.memory_limit : available_memory();
    if (!(samples <= kMostSamples)) {
      findings_.add(at,
                    fmt::format("has about {:.2g} samples of its distance, {:.3g} m apart, or more; at most {:.2g} are "
                                "possible, {}",
                                samples, options.cell, kMostSamples, kAdvice));
    } else if (limit != 0 && samples * volumes::kBytesPerSampleMade > static_cast<double>(limit)) {
      findings_.add(at, fmt::format("has about {:.2g} samples of its distance, {:.3g} m apart, which need about {} of "
                                    "memory while they are made; {} are available, {}",
                                    samples, options.cell, in_bytes(samples * volumes::kBytesPerSampleMade),
                                    in_bytes(static_cast<double>(limit)), kAdvice));
    } else {
      return true;
    }
    return false;
  }

  const Json& json_;
  const std::string& where_;
  std::string file_at_;
  const ShapeFiles& files_;
  Findings& findings_;
};

}  // namespace

std::optional<MeshShape> read_mesh_shape(const Json& json, const std::string& where, const ShapeFiles& files,
                                         Findings& findings) {
  HOOKE_ASSERT(files.smallest_radius > 0 && files.reach > 0, where, files.smallest_radius, files.reach);
  return MeshShapeReader(json, where, files, findings).read();
}

}  // namespace hooke::scene
