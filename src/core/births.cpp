// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/births.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hooke/base/assert.h"
#include "hooke/base/random.h"
#include "hooke/base/sine.h"
#include "hooke/core/placed_colliders.h"
#include "hooke/physics/enclosure.h"

namespace hooke {
namespace {

// Streams of random numbers: each emitter of a scene has its own of each kind.
enum class Draw : std::uint32_t { position, velocity, life, kinds };

std::uint32_t stream(std::uint32_t emitter, Draw draw) {
  return emitter * static_cast<std::uint32_t>(Draw::kinds) + static_cast<std::uint32_t>(draw);
}

// Four numbers that `accept` takes, drawn again until it takes them. Each `accept` of this file takes more than half of
// the cube, so that a hundred draws always suffice.
template <class Accept>
std::array<double, 4> draw_until(std::uint64_t seed, std::uint64_t number, std::uint32_t first_draw,
                                 std::uint32_t purpose, const Accept& accept) {
  constexpr std::uint32_t kMost = 100;
  std::array<double, 4> u{};
  for (std::uint32_t k = 0; k < kMost; ++k) {
    u = uniform4(seed, number, first_draw * kMost + k, purpose);
    if (accept(u)) break;
  }
  return u;
}

double from_range(const Range& range, double u) { return range.least + u * (range.most - range.least); }
double both_ways(double u) { return 2 * u - 1; }  // [0, 1) to [-1, 1)

struct Frame {
  Vec3d axis, across, upright;  // unit vectors at right angles
};

Frame frame_around(const Vec3d& axis) {
  const Vec3d other = std::abs(axis.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d across = cross(axis, other);
  const Vec3d unit = (1 / std::sqrt(dot(across, across))) * across;
  return {axis, unit, cross(axis, unit)};
}

// A point of the shape, in its own frame.
Vec3d draw_point(const ShapeGeometry<double>& s, std::uint64_t seed, std::uint64_t number, std::uint32_t attempt,
                 std::uint32_t purpose) {
  const auto draw = [&](const auto& accept) { return draw_until(seed, number, attempt, purpose, accept); };
  const auto in_disc = [](const std::array<double, 4>& u) {
    return both_ways(u[0]) * both_ways(u[0]) + both_ways(u[1]) * both_ways(u[1]) < 1;
  };
  switch (s.kind) {
    case ShapeKind::sphere: {
      const auto u = draw([&](const auto& a) {
        const Vec3d p{both_ways(a[0]), both_ways(a[1]), both_ways(a[2])};
        return dot(p, p) < 1;
      });
      return s.center + s.radius * Vec3d{both_ways(u[0]), both_ways(u[1]), both_ways(u[2])};
    }
    case ShapeKind::capsule: {
      const double half = s.half_length + s.radius;
      const auto place = [&](const auto& a) {
        return Vec3d{s.radius * both_ways(a[0]), s.radius * both_ways(a[1]), half * both_ways(a[2])};
      };
      const auto u = draw([&](const auto& a) {
        const Vec3d p = place(a);
        const double beyond = std::max(0.0, std::abs(p.z) - s.half_length);
        return p.x * p.x + p.y * p.y + beyond * beyond < s.radius * s.radius;
      });
      const Frame frame = frame_around(s.axis);
      const Vec3d p = place(u);
      return s.center + p.x * frame.across + p.y * frame.upright + p.z * frame.axis;
    }
    case ShapeKind::cylinder:
    case ShapeKind::disc: {
      const auto u = draw(in_disc);
      const Frame frame = frame_around(s.axis);
      const double height = s.kind == ShapeKind::disc ? 0 : s.half_length * both_ways(u[2]);
      return s.center + (s.radius * both_ways(u[0])) * frame.across + (s.radius * both_ways(u[1])) * frame.upright +
             height * frame.axis;
    }
    default: {
      const auto u = uniform4(seed, number, attempt, purpose);
      return s.center + Vec3d{s.half.x * both_ways(u[0]), s.half.y * both_ways(u[1]), s.half.z * both_ways(u[2])};
    }
  }
}

// A point inside of a closed mesh, in the frame of `s`: drawn from the box around it.
Vec3d draw_inside(const DistanceField& field, const ShapeGeometry<double>& s, std::uint64_t seed, std::uint64_t number,
                  std::uint32_t attempt, std::uint32_t purpose) {
  constexpr std::uint32_t kMost = 4096;  // if a mesh fills a hundredth of its box, one in 10^17 births fails
  const Vec3d from = field.min - field.origin, size = field.max - field.min;
  for (std::uint32_t k = 0; k < kMost; ++k) {
    const auto u = uniform4(seed, number, attempt * kMost + k, purpose);
    const Vec3d at = from + Vec3d{u[0] * size.x, u[1] * size.y, u[2] * size.z};
    if (encloses(s.field, at)) return s.center + at;
  }
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return {kNone, kNone, kNone};
}

// A point of a triangle, which is chosen in proportion to its area (Turk, "Generating random points in triangles",
// Graphics Gems, 24, 1990).
Vec3d draw_on_faces(const MeshShape& mesh, const ShapeGeometry<double>& s, std::span<const double> areas,
                    const std::array<double, 4>& u) {
  const auto found = std::upper_bound(areas.begin(), areas.end() - 1, u[0] * areas.back());
  const auto& corners = mesh.surface->triangles[static_cast<std::size_t>(found - areas.begin())];
  const auto corner = [&](std::size_t k) { return mesh.surface->vertices[corners[k]]; };
  const double away = std::sqrt(u[1]);  // from the first corner, of the way to the opposite edge
  const Vec3d at = (1 - away) * corner(0) + (away * (1 - u[2])) * corner(1) + (away * u[2]) * corner(2);
  return s.center + (at - mesh.field->origin);
}

Vec3d turned(const PlacedCollider<double>& body, const Vec3d& own) {
  return own.x * body.turn[0] + own.y * body.turn[1] + own.z * body.turn[2];
}

}  // namespace

bool is_open_mesh(const Shape& shape) {
  const auto* mesh = std::get_if<MeshShape>(&shape);
  return mesh != nullptr && mesh->field && mesh->field->open;
}

std::vector<double> areas_of_birth(const Shape& shape) {
  std::vector<double> areas;
  if (!is_open_mesh(shape)) return areas;
  HOOKE_ASSERT(std::get<MeshShape>(shape).surface != nullptr);
  const TriangleMesh& mesh = *std::get<MeshShape>(shape).surface;
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3d& a = mesh.vertices[t[0]];
    const Vec3d twice = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
    areas.push_back(sum += 0.5 * std::sqrt(dot(twice, twice)));
  }
  return areas;
}

PlacedEmitter place_emitter(const Emitter& emitter, std::uint32_t index, double time, double reach,
                            std::span<const double> areas) {
  HOOKE_ASSERT(dot(emitter.direction, emitter.direction) > 0, emitter.name, emitter.direction);
  HOOKE_ASSERT(emitter.spread >= 0 && emitter.spread <= 180, emitter.name, emitter.spread);
  const Collider body{emitter.name, emitter.shape, false, {}, emitter.motion};
  PlacedEmitter placed;
  placed.emitter = &emitter;
  placed.index = index;
  placed.areas = areas;
  placed.body = place_collider<double>(body, pose_at(body, time), reach);
  placed.direction = (1 / std::sqrt(dot(emitter.direction, emitter.direction))) * emitter.direction;
  placed.cosine = sine_cosine_of_turns(emitter.spread / 360).cosine;
  return placed;
}

Vec3d draw_position(const PlacedEmitter& emitter, std::uint64_t number, std::uint32_t attempt) {
  HOOKE_ASSERT(emitter.emitter != nullptr);
  HOOKE_ASSERT(!is_open_mesh(emitter.emitter->shape) || !emitter.areas.empty(), emitter.emitter->name);
  const ShapeGeometry<double>& shape = emitter.body.shape;
  const std::uint64_t seed = emitter.emitter->seed;
  const std::uint32_t purpose = stream(emitter.index, Draw::position);
  Vec3d own;
  if (const auto* mesh = std::get_if<MeshShape>(&emitter.emitter->shape)) {
    own = mesh->field->open ? draw_on_faces(*mesh, shape, emitter.areas, uniform4(seed, number, attempt, purpose))
                            : draw_inside(*mesh->field, shape, seed, number, attempt, purpose);
  } else {
    own = draw_point(shape, seed, number, attempt, purpose);
  }
  return emitter.body.pivot + turned(emitter.body, own);
}

// With (a, b) uniform over the unit disc, a^2 + b^2 is uniform over [0, 1), so a cosine of 1 - (a^2 + b^2)
// (1 - cos spread) makes the direction uniform over the cone (Marsaglia, "Choosing a point from the surface of a
// sphere", Ann. Math. Stat. 43, 645, 1972).
Vec3d draw_velocity(const PlacedEmitter& emitter, std::uint64_t number, const Vec3d& x) {
  HOOKE_ASSERT(emitter.emitter != nullptr);
  const auto u = draw_until(emitter.emitter->seed, number, 0, stream(emitter.index, Draw::velocity), [](const auto& v) {
    return both_ways(v[0]) * both_ways(v[0]) + both_ways(v[1]) * both_ways(v[1]) < 1;
  });
  const double a = both_ways(u[0]), b = both_ways(u[1]), square = a * a + b * b;
  const double narrowing = 1 - emitter.cosine, cosine = 1 - square * narrowing;
  // sin / sqrt(square), without a division by a square of 0
  const double sideways = std::sqrt(narrowing * (1 + cosine));
  const Frame frame = frame_around(emitter.direction);
  const Vec3d direction = cosine * frame.axis + (a * sideways) * frame.across + (b * sideways) * frame.upright;
  const PlacedCollider<double>& body = emitter.body;
  return from_range(emitter.emitter->speed, u[2]) * turned(body, direction) + body.velocity +
         cross(body.angular_velocity, x - body.pivot);
}

std::optional<std::int64_t> draw_lifetime(const Emitter& emitter, std::uint32_t index, std::uint64_t number,
                                          double dt) {
  HOOKE_ASSERT(dt > 0, dt);
  if (!emitter.life) return {};
  HOOKE_ASSERT(emitter.life->least > 0 && emitter.decay.least > 0, emitter.life->least, emitter.decay.least);
  const auto u = uniform4(emitter.seed, number, 0, stream(index, Draw::life));
  const double life = from_range(*emitter.life, u[0]), each = dt * from_range(emitter.decay, u[1]);
  constexpr double kLongest = 4503599627370496;  // 2^52 steps: exact, and no run lasts longer
  double n = std::clamp(std::ceil(life / each), 1.0, kLongest);
  if (n > 1 && (n - 1) * each >= life) --n;  // corrects the quotient's rounding
  if (n < kLongest && n * each < life) ++n;
  return static_cast<std::int64_t>(n);
}

}  // namespace hooke
