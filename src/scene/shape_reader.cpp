// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/shape_reader.h"

#include "hooke/scene/json_path.h"
#include "hooke/scene/mesh_shape.h"
#include "hooke/scene/scene_builder.h"

namespace hooke::scene {
namespace {

// Reads the only member of a "shape" object that has passed the schema.
class ShapeReader {
 public:
  explicit ShapeReader(const Json& json) : json_(json) {}

  Shape read(const std::string& kind) const {
    if (kind == "plane") return PlaneShape{vector("point"), vector("normal")};
    if (kind == "box") return BoxShape{vector("min"), vector("max")};
    if (kind == "sphere") return SphereShape{vector("center"), number("radius")};
    if (kind == "capsule") return CapsuleShape{vector("from"), vector("to"), number("radius")};
    if (kind == "cylinder") return CylinderShape{vector("from"), vector("to"), number("radius")};
    return DiscShape{vector("center"), vector("normal"), number("radius")};
  }

 private:
  Vec3d vector(const char* key) const { return vec3_or(json_.at(key), {}); }
  double number(const char* key) const { return json_.at(key).get<double>(); }

  const Json& json_;
};

}  // namespace

std::optional<Shape> read_shape(const Json& shape, const std::string& where, const ShapeFiles& files,
                                Findings& findings) {
  if (findings.touches(where) || !shape.is_object() || shape.size() != 1) return {};
  const std::string kind = shape.items().begin().key();
  const std::string path = join_path(where, kind);
  if (kind == "mesh") {
    if (auto mesh = read_mesh_shape(shape.at(kind), path, files, findings)) return Shape(std::move(*mesh));
    return {};
  }
  Shape read = ShapeReader(shape.at(kind)).read(kind);
  for (Finding& finding : validate(read, where)) findings.add(finding.where, std::move(finding.message));
  if (findings.touches(where)) return {};
  return read;
}

}  // namespace hooke::scene
