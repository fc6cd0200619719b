// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "hooke/base/box3.h"
#include "hooke/base/expected.h"
#include "hooke/base/vec3.h"
#include "hooke/core/distance_field.h"
#include "hooke/core/triangle_mesh.h"
#include "hooke/physics/shapes.h"

namespace hooke {

// Shapes as scenes describe them, of colliders and of other parts of space. Lengths in metres. All functions but
// validate() need shapes within the limits that these comments state.

struct PlaneShape {
  Vec3d point{0, 0, 0};
  Vec3d normal{0, 1, 0};  ///< not 0, of any length; all behind it is solid
};
struct BoxShape {
  Vec3d min{0, 0, 0}, max{1, 1, 1};  ///< max above min on every axis
};
struct SphereShape {
  Vec3d center{0, 0, 0};
  double radius = 1;  ///< > 0
};
/// A cylinder with half spheres at its ends.
struct CapsuleShape {
  Vec3d from{0, 0, 0}, to{0, 1, 0};  ///< centres of the half spheres, apart
  double radius = 1;                 ///< > 0
};
/// With flat ends.
struct CylinderShape {
  Vec3d from{0, 0, 0}, to{0, 1, 0};  ///< centres of the ends, apart
  double radius = 1;                 ///< > 0
};
/// Flat and without thickness.
struct DiscShape {
  Vec3d center{0, 0, 0};
  Vec3d normal{0, 1, 0};  ///< not 0, of any length
  double radius = 1;      ///< > 0
};
/// Triangles, placed: contacts use `field`, pictures show `surface`.
struct MeshShape {
  std::shared_ptr<const TriangleMesh> surface;
  std::shared_ptr<const DistanceField> field;
};

using Shape = std::variant<PlaneShape, BoxShape, SphereShape, CapsuleShape, CylinderShape, DiscShape, MeshShape>;

/// The middle of a shape, m: for a plane its point, for a mesh the middle of the box around it.
Vec3d middle_of(const Shape& shape);

/// The box around a shape, m; for a plane, infinite along every axis.
Box3d bounds_of(const Shape& shape);

/// The shape's numbers for the laws, m relative to `origin`.
ShapeGeometry<double> geometry_of(const Shape& shape, bool hollow, const Vec3d& origin);

/// What is wrong with a shape at the path `where`, if anything.
std::vector<Finding> validate(const Shape& shape, const std::string& where);

}  // namespace hooke
