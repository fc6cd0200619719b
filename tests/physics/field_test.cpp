// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Fields against analytic solutions for a particle in them.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

constexpr double kMass = 2, kDrag = 3, kStep = 1e-3;

// One material of mass 2 kg and drag 3 kg/s, another without drag; no gravity.
Scene scene_with(Field field) {
  Scene scene = open_scene();
  scene.time_step = kStep;
  scene.materials = {{"leaf", 0.5, kMass, {1000, 0, 0}, kDrag, ""}, {"stone", 0.5, 5, {1000, 0, 0}, 0, ""}};
  scene.fields = {std::move(field)};
  return scene;
}

ParticleSet one_at(const Vec3d& x, std::uint16_t material = 0) {
  ParticleSet p;
  add(p, x, {0, 0, 0}, material);
  return p;
}

void expect_near(const Vec3d& a, const Vec3d& b, double tolerance) {
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(component(a, axis), component(b, axis), tolerance) << "axis " << axis;
}

class Fields : public testing::TestWithParam<Engine> {
 protected:
  // The rounding error of a number around 1 after a thousand steps.
  double rounding() const { return GetParam().precision == Precision::single_precision ? 1e-4 : 1e-12; }
};

TEST_P(Fields, WindTakesWhatHasDragAlong) {
  const Vec3d u{4, 0, -2};
  const Scene scene = scene_with({Wind{u, {}, 0, {}}, {}, {}});
  Simulation s = simulate(scene, one_at({0, 0, 0}), GetParam());
  for (int n = 500; n <= 1500; n += 500) {
    ASSERT_TRUE(advance(s, 500));
    // Symplectic Euler's own sequence, and the exponential, from which it differs by half a step's change.
    expect_near(s.velocities()[0], (1 - std::pow(1 - kStep * kDrag / kMass, n)) * u, 4 * rounding());
    expect_near(s.velocities()[0], (1 - std::exp(-n * kStep * kDrag / kMass)) * u, 4 * kStep * kDrag / kMass);
  }
  EXPECT_NEAR(s.ledger().impulse[Cause::field].x, kDrag * u.x * 1.5, 10 * rounding());
  ASSERT_TRUE(advance(s, 12000));
  expect_near(s.velocities()[0], u, 1e-3 + 10 * rounding()); // its terminal velocity
}

TEST_P(Fields, WindWithADragOfItsOwnTakesAllAlong) {
  const Vec3d u{0, 3, 0};
  Simulation s = simulate(scene_with({Wind{u, 10.0, 0, {}}, {}, {}}), one_at({0, 0, 0}, 1), GetParam());
  ASSERT_TRUE(advance(s, 500));
  expect_near(s.velocities()[0], (1 - std::pow(1 - kStep * 10 / 5, 500)) * u, 4 * rounding());
}

TEST_P(Fields, GustsComeAndGoAndTravel) {
  const double third = 2 * std::numbers::pi / 3;
  const Gust everywhere{{0, 0, 6}, 0.25, 0}, travelling{{0, 0, 6}, 0.25, 12};
  for (const Gust& gust : {everywhere, travelling}) {
    // Along the wind, which blows towards -x, the second particle is a third of a wavelength behind.
    ParticleSet p = one_at({0, 0, 0}, 1);
    add(p, {4, 7, 0}, {0, 0, 0}, 1);
    Simulation s = simulate(scene_with({Wind{{-2, 0, 0}, 10.0, 0, gust}, {}, {}}), p, GetParam());
    ASSERT_TRUE(advance(s, 1000));  // a quarter of a turn
    const Vec3d before[] = {s.velocities()[0], s.velocities()[1]};
    const double x = s.positions()[1].x;
    ASSERT_TRUE(advance(s, 1));
    for (int i = 0; i < 2; ++i) {
      const double lag = gust.wavelength > 0 ? (i == 0 ? s.positions()[0].x / 4 : x / 4) * third : 0;
      const double wind = 6 * std::cos(lag);
      const double gain = s.velocities()[static_cast<std::size_t>(i)].z - before[i].z;
      // One step's gain: the difference of velocities of some m/s; a step changes the gust by 1.6e-3 of itself.
      EXPECT_NEAR(gain, kStep * 2 * (wind - before[i].z), kStep * 2 * 0.02 + rounding());
    }
  }
}

TEST_P(Fields, APushDoesTheWorkThatItSays) {
  const Vec3d a{1, -2, 0.5};
  Simulation s = simulate(scene_with({UniformPush{a}, {}, {}}), one_at({1, 2, 3}, 1), GetParam());
  ASSERT_TRUE(advance(s, 1000));
  expect_near(s.velocities()[0], a, 2 * rounding());
  EXPECT_NEAR(s.ledger().work[Cause::field], 0.5 * 5 * dot(a, a), 20 * rounding());
  expect_near(s.ledger().impulse[Cause::field], 5 * a, 10 * rounding());
}

TEST_P(Fields, WhoeverWantsToWalkThereAdaptsItsSpeed) {
  Simulation s = simulate(scene_with({PushToward{{30, 40, 0}, 0, 1.5, 0.5}, {}, {}}), one_at({0, 0, 0}, 1), GetParam());
  ASSERT_TRUE(advance(s, 700));
  const double speed = 1.5 * (1 - std::pow(1 - kStep / 0.5, 700));
  expect_near(s.velocities()[0], speed * Vec3d{0.6, 0.8, 0}, 2 * rounding());
  Simulation there =
      simulate(scene_with({PushToward{{30, 40, 0}, 7, 1.5, 0.5}, {}, {}}), one_at({30, 40, 0}, 1), GetParam());
  ASSERT_TRUE(advance(there, 10));
  expect_near(there.velocities()[0], {0, 0, 0}, 0);  // at the target: no direction to go
}

TEST_P(Fields, APushTowardsAPointPulls) {
  Simulation s = simulate(scene_with({PushToward{{0, -90, 0}, 2, 0, 0}, {}, {}}), one_at({0, 0, 0}, 1), GetParam());
  ASSERT_TRUE(advance(s, 100));
  expect_near(s.velocities()[0], {0, -0.2, 0}, rounding());
}

TEST_P(Fields, ActWhereAndOnWhomTheySay) {
  ParticleSet p = one_at({5, 0, 0}, 0);
  add(p, {5, 3, 0}, {0, 0, 0}, 1);
  add(p, {7, 3, 0}, {0, 0, 0}, 1);
  Field field{UniformPush{{0, 0, 1}}, BoxShape{{4, -1, -1}, {6, 4, 1}}, {1}};
  Simulation s = simulate(scene_with(field), p, GetParam());
  ASSERT_TRUE(advance(s, 10));
  EXPECT_EQ(s.velocities()[0].z, 0) << "of another material";
  EXPECT_NEAR(s.velocities()[1].z, 10 * kStep, rounding());
  EXPECT_EQ(s.velocities()[2].z, 0) << "not in the box";
}

// A triangle in the plane z = 2 x: wind presses on it only along its normal.
TEST_P(Fields, WindPressesOnSheets) {
  ParticleSet p = one_at({0, 0, 0}, 1);
  add(p, {3, 0, 6}, {0, 0, 0}, 1);
  add(p, {0, 4, 0}, {0, 0, 0}, 1);
  auto structure = std::make_shared<Structure>();
  structure->surfaces = {{"linen", {1, 2, 3}, {0, 1, 2}}};
  const Vec3d u{3, 5, 1}, normal = (1 / std::sqrt(5.0)) * Vec3d{-2, 0, 1};
  const double area = 0.5 * std::sqrt(45.0) * 4, area_drag = 0.7;
  Scene scene = scene_with({Wind{u, 0.0, area_drag, {}}, {}, {}});
  scene.structure = structure;
  Simulation s = simulate(scene, p, GetParam());
  ASSERT_TRUE(advance(s, 1));
  const Vec3d gain = (kStep / 5 * area_drag * area * dot(u, normal) / 3) * normal;
  for (const Vec3d& v : s.velocities()) expect_near(v, gain, 1e-3 * rounding());
  expect_near(s.ledger().impulse[Cause::field], 15.0 * gain, rounding());
  // A triangle that moves relative to the wind only within its own plane feels no force.
  Scene drifting = scene;
  for (Vec3d& v : p.velocity) v = u + Vec3d{1, 7, 2};  // along the triangle
  Simulation t = simulate(drifting, p, GetParam());
  ASSERT_TRUE(advance(t, 1));
  expect_near(t.ledger().impulse[Cause::field], {0, 0, 0}, kStep * rounding());
}

INSTANTIATE_TEST_SUITE_P(Engines, Fields, testing::Values(kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle),
                         [](const auto& test) { return test.param.name(); });

TEST(FieldChecks, NameWhatIsWrong) {
  Scene scene = scene_with({Wind{{0, 0, 0}, -1.0, -2, Gust{{1, 0, 0}, 1, 3}}, BoxShape{{0, 0, 0}, {1, 0, 1}}, {7}});
  std::vector<std::string> wheres;
  for (const Finding& finding : check_fields(scene)) wheres.push_back(finding.where);
  EXPECT_EQ(wheres, (std::vector<std::string>{"fields[0].wind.drag", "fields[0].wind.area_drag",
                                              "fields[0].wind.gust.wavelength", "fields[0].materials",
                                              "fields[0].within.box.max[1]"}));
}

}  // namespace
}  // namespace hooke::test
