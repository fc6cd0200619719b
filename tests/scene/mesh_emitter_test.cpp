// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Meshes as emitters and sinks: where particles are born, which particles are removed, and the same on every back end.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hooke/core/births.h"
#include "hooke/physics/enclosure.h"
#include "hooke/scene/load_scene.h"
#include "mesh_shapes.h"
#include "scratch_folder.h"
#include "support/engines.h"
#include "support/openvdb.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

constexpr std::uint64_t kDraws = 20000;

// The deviation of `count` out of kDraws from the expected share, in standard deviations; the seed is fixed.
double deviations(std::uint64_t count, double share) {
  const double n = static_cast<double>(kDraws);
  return std::abs(static_cast<double>(count) - n * share) / std::sqrt(n * share * (1 - share));
}

// The field's samples reach 0.5 m into the ball; most of the ball is deeper than that.
MeshShape ball_of_field() { return shape_of(ball_mesh(0, 2, 128), 0.05, 0.02); }

TEST(Enclosure, IsOfAllThatIsInsideHoweverDeep) {
  HOOKE_NEEDS_OPENVDB();
  const Shape ball = ball_of_field();
  for (const Vec3d& origin : {Vec3d{0, 0, 0}, Vec3d{3, -1, 7}}) {
    const ShapeGeometry<double> geometry = geometry_of(ball, false, origin);
    int deep = 0;
    for (std::uint64_t i = 0; i < 4000; ++i) {
      const auto u = random4(3, i);
      const Vec3d x{6 * u[0] - 3, 6 * u[1] - 3, 6 * u[2] - 3};
      const double beyond = std::sqrt(dot(x, x)) - 2;
      if (std::abs(beyond) < 0.01) continue;  // the mesh's edges are that far inside the ball
      EXPECT_EQ(encloses(geometry, x - origin), beyond < 0) << beyond;
      deep += beyond < 0 && distance(ball, x) > 1 ? 1 : 0;
    }
    EXPECT_GT(deep, 100) << "places inside of which the field knows nothing";
  }
  EXPECT_FALSE(encloses(geometry_of(shape_of(turned({{2, 2}, {0.5, 0}}, 32), 0.05, 0.2), false, {0, 0, 0}), {0, 1, 0}));
}

TEST(MeshEmitter, FillsAClosedMeshEvenly) {
  HOOKE_NEEDS_OPENVDB();
  Emitter e;
  e.shape = ball_of_field();
  e.motion = SteadyMotion{{1, 0, 0}, {0, 0, 1}, Vec3d{0, 0, 0}};
  const double time = 0.7;
  const PlacedEmitter placed = place_emitter(e, 0, time, 0);
  std::uint64_t inner = 0, ahead = 0;
  for (std::uint64_t n = 0; n < kDraws; ++n) {
    const Vec3d x = draw_position(placed, n, 0) - Vec3d{time, 0, 0};
    const double away = std::sqrt(dot(x, x));
    ASSERT_LT(away, 2.01);
    inner += away < 1 ? 1 : 0;
    ahead += x.x + 2 * x.y > 0 ? 1 : 0;
  }
  EXPECT_LT(deviations(inner, 1.0 / 8), 4);
  EXPECT_LT(deviations(ahead, 0.5), 4);
}

// A cone without ends: births in proportion to area.
TEST(MeshEmitter, CoversTheFacesOfAnOpenMeshEvenly) {
  HOOKE_NEEDS_OPENVDB();
  Emitter e;
  const double wide = 2, narrow = 0.5;  // at heights 3 and 0; the slant is straight
  e.shape = shape_of(turned({{wide, 3}, {narrow, 0}}, 400), 0.1, 0.2);
  const std::vector<double> areas = areas_of_birth(e.shape);
  EXPECT_NEAR(areas.back(), kPi * (wide + narrow) * std::sqrt(3 * 3 + 1.5 * 1.5), 1e-3 * areas.back());
  const PlacedEmitter placed = place_emitter(e, 0, 0, 0, areas);
  std::uint64_t lower = 0, left = 0;
  for (std::uint64_t n = 0; n < kDraws; ++n) {
    const Vec3d x = draw_position(placed, n, 0);
    ASSERT_NEAR(std::hypot(x.x, x.z), narrow + (wide - narrow) * x.y / 3, 1e-3);
    lower += x.y < 1.5 ? 1 : 0;
    left += x.x < 0 ? 1 : 0;
  }
  const double middle = 0.5 * (wide + narrow);
  EXPECT_LT(deviations(lower, (narrow + middle) / (2 * (wide + narrow))), 4);
  EXPECT_LT(deviations(left, 0.5), 4);
}

// Meshes read from files, with a sink in the way that removes every particle that gets inside.
TEST(MeshEmitter, IsTheSameOnEveryBackEnd) {
  HOOKE_NEEDS_OPENVDB();
  const ScratchFolder folder;
  folder.write("ball.obj", obj_text(ball_mesh(0, 1, 48)));
  folder.write("sheet.obj", obj_text(turned({{1, 0.3}, {0.2, 0}}, 24)));
  const auto loaded = scene::parse_scene(R"({ "hooke": 1, "time": { "step": 0.001, "end": 1 }, "precision": "double",
      "domain": { "min": [-5, -5, -5], "max": [5, 5, 5] }, "gravity": [0, -9.8, 0],
      "materials": { "water": { "radius": 0.05, "mass": 1, "stiffness": 1000, "damping": 1 } }, "particles": [],
      "emitters": [
        { "material": "water", "rate": 3000, "shape": { "mesh": { "file": "ball.obj", "scale": 0.7 } }, "speed": [1, 2],
          "direction": [0, -1, 0], "motion": { "velocity": [0.5, 0, 0], "angular_velocity": [0, 2, 0] } },
        { "material": "water", "rate": 2000, "shape": { "mesh": { "file": "sheet.obj", "translate": [3, 0, 0] } } } ],
      "sinks": [ { "shape": { "mesh": { "file": "ball.obj", "translate": [0, -1.5, 0] } } } ] })",
                                         "scene.json", folder.path());
  ASSERT_TRUE(loaded) << loaded.error().text();
  EXPECT_TRUE(loaded->warnings.empty());
  EXPECT_EQ(loaded->files.size(), 3U);
  Simulation reference = simulate(loaded->scene, {}, kReference),
             cpu = simulate(loaded->scene, {}, {"cpu", Precision::double_precision, 2, ""});
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(advance(reference, 15));
    ASSERT_TRUE(advance(cpu, 15));
    ASSERT_EQ(reference.state_hash(), cpu.state_hash()) << "after " << reference.step_count() << " steps";
  }
  EXPECT_EQ(reference.ledger().population, cpu.ledger().population);
  EXPECT_GT(cpu.ledger().population.born, 600U);
  EXPECT_GT(cpu.ledger().population.sunk, 50U);
  for (const Vec3d& x : cpu.positions()) EXPECT_GT(std::hypot(x.x, x.y + 1.5, x.z), 0.98) << "inside of the sink";
}

}  // namespace
}  // namespace hooke::test
