// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hooke/base/assert.h"
#include "hooke/base/format.h"

namespace hooke {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

double length_of(const Vec3d& a) { return std::sqrt(dot(a, a)); }

Vec3d least(const Vec3d& a, const Vec3d& b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3d most(const Vec3d& a, const Vec3d& b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

// A unit vector at right angles to the unit vector `axis`: from the coordinate axis that is furthest from it.
Vec3d across(const Vec3d& axis) {
  const Vec3d a{std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)};
  const Vec3d other = a.x <= a.y && a.x <= a.z ? Vec3d{1, 0, 0} : a.y <= a.z ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
  const Vec3d off = other - dot(other, axis) * axis;
  return (1 / length_of(off)) * off;
}

void set_axis(ShapeGeometry<double>& g, const Vec3d& along) {
  HOOKE_ASSERT(length_of(along) > 0, along);
  g.axis = (1 / length_of(along)) * along;
  g.across = across(g.axis);
}

template <class LongShape>
void set_long(ShapeGeometry<double>& g, const LongShape& s, const Vec3d& origin) {
  HOOKE_ASSERT(s.radius > 0, s.radius);
  g.center = 0.5 * (s.from + s.to) - origin;
  set_axis(g, s.to - s.from);
  g.half_length = 0.5 * length_of(s.to - s.from);
  g.radius = s.radius;
}

// How far a disc reaches along each axis from its centre.
Vec3d reach_of_disc(const Vec3d& normal, double radius) {
  HOOKE_ASSERT(length_of(normal) > 0 && radius > 0, normal, radius);
  const Vec3d n = (1 / length_of(normal)) * normal;
  const auto reach = [radius](double c) { return radius * std::sqrt(std::max(0.0, 1 - c * c)); };
  return {reach(n.x), reach(n.y), reach(n.z)};
}

class Checker {
 public:
  explicit Checker(std::string where) : where_(std::move(where)) {}

  void vector(const char* key, const Vec3d& a) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(component(a, axis))) add(formatted("{}[{}]", key, axis), "is not a finite number");
    }
  }
  void direction(const char* key, const Vec3d& a) {
    vector(key, a);
    if (findings.empty() && !(length_of(a) > 0)) add(key, "must not be 0");
  }
  void radius(double value) {
    if (!std::isfinite(value) || !(value > 0)) add("radius", formatted("{} must be greater than 0", value));
  }
  template <class LongShape>
  void ends(const LongShape& s) {
    vector("from", s.from);
    vector("to", s.to);
    if (findings.empty() && s.from == s.to) add("to", "must be another point than \"from\"");
    radius(s.radius);
  }
  void add(const std::string& key, std::string message) {
    findings.push_back({where_ + "." + key, std::move(message)});
  }

  std::vector<Finding> findings;

 private:
  std::string where_;
};

}  // namespace

Box3d bounds_of(const Shape& shape) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const auto around = [](const Vec3d& a, const Vec3d& b, const Vec3d& reach) {
    return Box3d{least(a, b) - reach, most(a, b) + reach};
  };
  const auto all_ways = [](double r) { return Vec3d{r, r, r}; };
  return std::visit(
      Overloaded{[&](const PlaneShape&) { return Box3d{all_ways(-kInfinite), all_ways(kInfinite)}; },
                 [&](const BoxShape& s) { return Box3d{s.min, s.max}; },
                 [&](const SphereShape& s) { return around(s.center, s.center, all_ways(s.radius)); },
                 [&](const CapsuleShape& s) { return around(s.from, s.to, all_ways(s.radius)); },
                 [&](const CylinderShape& s) { return around(s.from, s.to, reach_of_disc(s.to - s.from, s.radius)); },
                 [&](const DiscShape& s) { return around(s.center, s.center, reach_of_disc(s.normal, s.radius)); },
                 [&](const MeshShape& s) {
                   HOOKE_ASSERT(s.field != nullptr);
                   return Box3d{s.field->min, s.field->max};
                 }},
      shape);
}

Vec3d middle_of(const Shape& shape) {
  if (const auto* plane = std::get_if<PlaneShape>(&shape)) return plane->point;
  return bounds_of(shape).center();
}

ShapeGeometry<double> geometry_of(const Shape& shape, bool hollow, const Vec3d& origin) {
  ShapeGeometry<double> g;
  g.hollow = hollow;
  std::visit(Overloaded{[&](const PlaneShape& s) {
                          g.kind = ShapeKind::plane;
                          g.center = s.point - origin;
                          set_axis(g, s.normal);
                        },
                        [&](const BoxShape& s) {
                          HOOKE_ASSERT(s.min.x < s.max.x && s.min.y < s.max.y && s.min.z < s.max.z, s.min, s.max);
                          g.kind = ShapeKind::box;
                          g.center = 0.5 * (s.min + s.max) - origin;
                          g.half = 0.5 * (s.max - s.min);
                        },
                        [&](const SphereShape& s) {
                          HOOKE_ASSERT(s.radius > 0, s.radius);
                          g.kind = ShapeKind::sphere;
                          g.center = s.center - origin;
                          g.radius = s.radius;
                        },
                        [&](const CapsuleShape& s) {
                          g.kind = ShapeKind::capsule;
                          set_long(g, s, origin);
                        },
                        [&](const CylinderShape& s) {
                          g.kind = ShapeKind::cylinder;
                          set_long(g, s, origin);
                        },
                        [&](const DiscShape& s) {
                          HOOKE_ASSERT(s.radius > 0, s.radius);
                          g.kind = ShapeKind::disc;
                          g.center = s.center - origin;
                          set_axis(g, s.normal);
                          g.radius = s.radius;
                        },
                        [&](const MeshShape& s) {
                          HOOKE_ASSERT(s.field != nullptr);
                          g.kind = ShapeKind::mesh;
                          g.center = s.field->origin - origin;
                          g.field = s.field->view();
                        }},
             shape);
  return g;
}

std::vector<Finding> validate(const Shape& shape, const std::string& where) {
  constexpr const char* kNames[] = {"plane", "box", "sphere", "capsule", "cylinder", "disc", "mesh"};
  Checker check(where + "." + kNames[shape.index()]);
  std::visit(Overloaded{[&](const PlaneShape& s) {
                          check.vector("point", s.point);
                          check.direction("normal", s.normal);
                        },
                        [&](const BoxShape& s) {
                          check.vector("min", s.min);
                          check.vector("max", s.max);
                          for (int axis = 0; axis < 3 && check.findings.empty(); ++axis) {
                            const double low = component(s.min, axis), high = component(s.max, axis);
                            if (low < high) continue;
                            check.add(formatted("max[{}]", axis),
                                      formatted("{} must be greater than min[{}] = {}", high, axis, low));
                          }
                        },
                        [&](const SphereShape& s) {
                          check.vector("center", s.center);
                          check.radius(s.radius);
                        },
                        [&](const CapsuleShape& s) { check.ends(s); }, [&](const CylinderShape& s) { check.ends(s); },
                        [&](const DiscShape& s) {
                          check.vector("center", s.center);
                          check.direction("normal", s.normal);
                          check.radius(s.radius);
                        },
                        [&](const MeshShape& s) {
                          if (!s.surface || !s.field || s.surface->vertices.empty()) check.add("file", "holds no mesh");
                        }},
             shape);
  return std::move(check.findings);
}

}  // namespace hooke
