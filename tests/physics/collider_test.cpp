// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Moving particles and colliders.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hooke/core/contacts.h"
#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

Collider make_collider(Shape shape, Motion motion = {}, bool hollow = false) {
  Collider c;
  c.name = "thing";
  c.shape = std::move(shape);
  c.motion = std::move(motion);
  c.hollow = hollow;
  return c;
}

Scene scene_with(Collider collider) {
  Scene scene = open_scene();
  scene.gravity = {0, -9.8, 0};
  scene.colliders.push_back(std::move(collider));
  return scene;
}

// A ball falls from above on each shape's top, at y = 0, and bounces as it does off the domain's floor.
TEST(BouncingBall, GoesTheSameWayOverEveryShape) {
  const Shape shapes[] = {PlaneShape{{3, 0, -2}, {0, 5, 0}},
                          BoxShape{{-2, -1, -2}, {2, 0, 2}},
                          SphereShape{{0, -3, 0}, 3},
                          CapsuleShape{{-1, -1, 0}, {1, -1, 0}, 1},
                          CylinderShape{{0, -2, 0}, {0, 0, 0}, 1},
                          CylinderShape{{-1, -1, 0}, {1, -1, 0}, 1},
                          DiscShape{{0, 0, 0}, {0, 1, 0}, 1}};
  ParticleSet ball;
  add(ball, {0, 1.5, 0}, {0, 0, 0});
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    Scene walled = open_scene();
    walled.gravity = {0, -9.8, 0};
    walled.integrator = integrator;
    walled.domain.min.y = 0;
    walled.domain.boundary[1] = Boundary::spring;
    Simulation expected = simulate(walled, ball, kReference);
    std::vector<Vec3d> path;
    for (int i = 0; i < 15; ++i) {
      ASSERT_TRUE(advance(expected, 100));
      path.push_back(expected.positions()[0]);
    }
    for (const Shape& shape : shapes) {
      for (const bool hollow : {false, true}) {
        for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle}) {
          Scene scene = scene_with(make_collider(shape, {}, hollow));
          scene.integrator = integrator;
          Simulation simulation = simulate(scene, ball, engine);
          const double tolerance = engine.precision == Precision::single_precision ? 2e-4 : 1e-12;  // m
          for (const Vec3d& x : path) {
            ASSERT_TRUE(advance(simulation, 100));
            EXPECT_NEAR(simulation.positions()[0].y, x.y, tolerance) << shape.index() << " on " << engine.name();
            EXPECT_NEAR(simulation.positions()[0].x, 0, 1e-15);
          }
          EXPECT_NEAR(simulation.ledger().work[Cause::collider], expected.ledger().work[Cause::wall], 30 * tolerance)
              << "what the collider gave is booked as what a wall gives, to rounding";
          EXPECT_LT(momentum_drift(measured(simulation), simulation.ledger(), simulation.initial_momentum()),
                    engine.precision == Precision::single_precision ? 1e-5 : 1e-12);
        }
      }
    }
  }
}

// The plane moves along x; shear and damping speed up a ball that lies on it as v (1 - e^(-c t / m)), c = c_s + c_d.
TEST(MovingPlane, CarriesARestingBall) {
  for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle}) {
    Scene scene = scene_with(make_collider(PlaneShape{{0, 0, 0}, {0, 1, 0}}, SteadyMotion{{2, 0, 0}, {}, {}}));
    ParticleSet ball;
    add(ball, {0, 0.5 - 9.8 / 1000, 0}, {0, 0, 0});  // pressed in by its weight
    Simulation simulation = simulate(scene, ball, engine);
    for (int i = 1; i <= 10; ++i) {
      ASSERT_TRUE(advance(simulation, 100));
      const double expected = 2 * (1 - std::exp(-5 * simulation.time()));
      EXPECT_NEAR(simulation.velocities()[0].x, expected, 5e-3) << "the step's error is of order c dt/m";
      EXPECT_NEAR(simulation.velocities()[0].y, 0, 1e-4);
    }
    EXPECT_NEAR(measured(simulation).colliders[0].force.y, -9.8, 1e-2) << "it presses down";
    // 2 N s at 2 m/s; the dashpots keep half of it.
    EXPECT_NEAR(simulation.ledger().impulse[Cause::collider].x, simulation.velocities()[0].x, 1e-5);
  }
}

// A turning disc carries a ball along with the speed of the disc's surface under the ball.
TEST(TurningDisc, TakesAlongByTheSpeedOfItsSurface) {
  Scene scene = scene_with(make_collider(DiscShape{{0, 0, 0}, {0, 1, 0}, 5}, SteadyMotion{{}, {0, 2, 0}, {}}));
  ParticleSet ball;
  add(ball, {3, 0.5 - 9.8 / 1000, 0}, {0, 0, 0});
  Simulation simulation = simulate(scene, ball, kReference);
  ASSERT_TRUE(advance(simulation, 1));
  // omega x r = (0, 2, 0) x (3, 0, 0) = (0, 0, -6); one step of 0.001 s gives (c_s + c_d) dt/m of it.
  EXPECT_NEAR(simulation.velocities()[0].z, -6 * 5 * 0.001, 1e-12);
  EXPECT_NEAR(simulation.velocities()[0].x, 0, 1e-12);
}

TEST(Heap, WeighsOnAColliderWhatItsParticlesWeigh) {
  for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle}) {
    Scene scene = scene_with(make_collider(BoxShape{{-10, -20, 5}, {-7, 0, 8}}, {}, true));
    for (Material& m : scene.materials) m.contact.damping = m.contact.shear = 20;
    scene.time_step = 0.002;
    const int per_side = engine.device == "reference" ? 2 : 3;
    Simulation simulation =
        simulate(scene, lattice(scene, {per_side, 3, per_side}, {-9.4, -19.4, 5.6}, 0.95, 0.02, 4), engine);
    const double weight = 9.8 * static_cast<double>(simulation.particle_count());
    ASSERT_TRUE(advance(simulation, 6000));
    const Measurements now = measured(simulation);
    ASSERT_EQ(now.colliders.size(), 1U);
    EXPECT_NEAR(now.colliders[0].force.y / weight, -1, 1e-3) << engine.name();
    EXPECT_NEAR(now.colliders[0].force.x / weight, 0, 1e-3);
    EXPECT_GT(now.colliders[0].contacts, 4U);
    // The lever of the weight, from the pivot (the middle of the box) to the heap's centre.
    const Vec3d lever = now.centre_of_mass - Vec3d{-8.5, -10, 6.5};
    EXPECT_NEAR(now.colliders[0].torque.z / weight, -lever.x, 2e-2);
    EXPECT_NEAR(now.colliders[0].torque.x / weight, lever.z, 2e-2);
    EXPECT_EQ(now.wall_contacts, 0U);
  }
}

// A collider's material mixes with the particle's, unless the pair has an entry; a collider without a material has the
// walls' coefficients.
TEST(ColliderMaterial, MixesWithTheParticles) {
  const auto force = [](const Scene& scene) {
    ParticleSet ball;
    add(ball, {0, 0.4, 0}, {0, 0, 0});
    return measured(simulate(scene, ball, kCpuDouble)).colliders[0].force.y;
  };
  Scene scene = scene_with(make_collider(PlaneShape{}));
  EXPECT_NEAR(force(scene), -100, 1e-9) << "k = 1000 over 0.1 m, as a wall";
  Material steel;
  steel.name = "steel";
  steel.radius = steel.mass = 0;
  steel.contact.stiffness = 3000;
  scene.materials.push_back(steel);
  scene.colliders[0].material = 1;
  EXPECT_NEAR(force(scene), -150, 1e-9) << "2 k1 k2/(k1 + k2)";
  scene.contacts.push_back({0, 1, {400, 0, 0}});
  EXPECT_NEAR(force(scene), -40, 1e-9);
  ParticleSet wrong;
  add(wrong, {0, 3, 0}, {0, 0, 0}, 1);
  const auto refused = Simulation::create(scene, wrong, make_backend(kCpuDouble));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text().find("\"steel\" has no radius"), std::string::npos) << refused.error().text();
}

TEST(FastApproach, ToAColliderStopsTheRun) {
  for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle}) {
    Scene scene = scene_with(make_collider(PlaneShape{}, SteadyMotion{{0, 400, 0}, {}, {}}));
    ParticleSet ball;
    add(ball, {0, 0.45, 0}, {0, -200, 0});
    Simulation simulation = simulate(scene, ball, engine);
    const auto stepped = simulation.step();
    ASSERT_FALSE(stepped) << engine.name();
    EXPECT_NE(stepped.error().text().find("particle 1 and collider \"thing\" approach at 600 m/s"), std::string::npos)
        << stepped.error().text();
  }
}

// The slope of grains in a hollow drum grows with the drum's speed: shear lifts the grains further.
TEST(Drum, LiftsGrainsHigherTheFasterItTurns) {
  double before = 0;
  for (const double speed : {0.0, 0.5, 1.5}) {
    Scene scene =
        scene_with(make_collider(CylinderShape{{0, 0, 0}, {0, 0, 3}, 4}, SteadyMotion{{}, {0, 0, speed}, {}}, true));
    scene.materials[0].contact.shear = scene.materials[0].contact.damping = 10;
    Simulation simulation = simulate(scene, lattice(scene, {5, 3, 2}, {-2, -2.6, 0.7}, 1, 0.02, 3), kCpuSingle);
    ASSERT_TRUE(advance(simulation, 8000));
    // Angle of the heap's middle from straight below the axis, in the direction in which the drum turns, degrees.
    const Vec3d middle = measured(simulation).centre_of_mass;
    const double angle = std::atan2(middle.x, -middle.y) * 180 / std::numbers::pi;
    if (speed == 0) {
      EXPECT_NEAR(angle, 0, 3);
    } else {
      EXPECT_GT(angle, before + 3) << "at " << speed << " rad/s";
    }
    before = angle;
    for (const Vec3d& x : simulation.positions()) {
      EXPECT_LT(std::hypot(x.x, x.y), 4) << "nothing leaves";
      EXPECT_GT(x.z, 0);
      EXPECT_LT(x.z, 3);
    }
  }
}

// A ball sticks out of a periodic domain and has moved by three lengths of the domain. It acts on the other side just
// as in a domain with the ball in its middle. A collider as long as the domain acts once.
TEST(PeriodicColliders, AreFeltAcrossTheFaces) {
  Collider ball = make_collider(SphereShape{{9.75, -1, -9.5}, 1.5}, SteadyMotion{{30, 0, 0}, {0, 0, 3}, {}});
  Collider floor = make_collider(BoxShape{{-5, -4, -20}, {15, -2, 20}});
  floor.name = "floor";
  Scene scene = scene_with(ball);
  scene.colliders.push_back(floor);
  scene.domain = {{0, -10, -10}, {10, 10, 10}, {Boundary::periodic, Boundary::open, Boundary::periodic}};
  const Vec3d shift{4.75, 0, -9};
  Scene middle = scene;
  middle.domain.min += shift;
  middle.domain.max += shift;
  ParticleSet grains, shifted;
  for (int k = 0; k < 12; ++k) {
    const double angle = 0.55 * k;  // around the ball, across both faces
    Vec3d x{9.75 + 1.3 * std::cos(angle), 1 + 0.1 * k, -9.5 + 1.3 * std::sin(angle)};
    add(shifted, x, {0, 0, 0});
    if (x.x >= 10) x.x -= 10;
    if (x.z < -10) x.z += 20;
    add(grains, x, {0, 0, 0});
  }
  for (const Engine& engine : {kReference, kCpuDouble, kGpuDouble}) {
    Simulation across = simulate(scene, grains, engine), within = simulate(middle, shifted, engine);
    for (int i = 0; i < 10; ++i) {
      ASSERT_TRUE(advance(across, 100));
      ASSERT_TRUE(advance(within, 100));
      for (std::size_t k = 0; k < grains.size(); ++k) {
        Vec3d off = across.positions()[k] - within.positions()[k];
        off.x -= 10 * std::round(off.x / 10);
        off.z -= 20 * std::round(off.z / 20);
        // Rounding errors of the images grow during collisions.
        EXPECT_LT(dot(off, off), 1e-16) << engine.name() << ' ' << i << ' ' << k;
      }
    }
    const Measurements a = measured(across), b = measured(within);
    EXPECT_GT(across.ledger().impulse[Cause::collider].y, 1) << engine.name();
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_EQ(a.colliders[c].contacts, b.colliders[c].contacts);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(component(a.colliders[c].force, axis), component(b.colliders[c].force, axis), 1e-4);
      }
    }
    std::size_t contacts = 0;
    for (const Contact& contact : find_contacts(scene, across.particles(), {across.time(), {}})) {
      if (contact.b == Contact::kCollider) ++contacts;
    }
    EXPECT_EQ(contacts, a.colliders[0].contacts + a.colliders[1].contacts);
  }
}

TEST(SetColliderMotion, MovesItByHand) {
  Scene scene = scene_with(make_collider(PlaneShape{}));
  ParticleSet ball;
  add(ball, {0, 0.4, 0}, {0, 0, 0});
  Simulation simulation = simulate(scene, ball, kCpuDouble);
  EXPECT_NEAR(measured(simulation).colliders[0].force.y, -100, 1e-9);
  HeldMotion pinned;
  pinned.position = {0, 0.1, 0};
  pinned.velocity = {7, 0, 0};
  ASSERT_TRUE(simulation.set_collider_motion("thing", pinned));
  EXPECT_NEAR(measured(simulation).colliders[0].force.y, -200, 1e-9);
  EXPECT_NEAR(measured(simulation).colliders[0].force.x, -35, 1e-9) << "dragged along at 7 m/s by 5 N s/m";
  EXPECT_EQ(simulation.collider_poses()[0].pivot, (Vec3d{0, 0.1, 0}));
  EXPECT_FALSE(simulation.set_collider_motion("nothing", pinned));
  pinned.position.x = NAN;
  EXPECT_FALSE(simulation.set_collider_motion("thing", pinned));
}

}  // namespace
}  // namespace hooke::test
