// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Particles that touch no others, births, lives and sinks: the CPU back end against the reference, and the same bits on
// any threads and instruction set.

#include <gtest/gtest.h>

#include <set>

#include "busy_scenes.h"
#include "hooke/backends/cpu/isa.h"
#include "hooke/core/contacts.h"
#include "support/ranks.h"

namespace hooke::test {
namespace {

Material sparks() {
  Material m;
  m.name = "spark";
  m.radius = 0.1;
  m.mass = 0.2;
  m.contact = {20, 0.01, 0.02};
  m.drag = 0.04;
  m.interacts = false;
  return m;
}

Emitter spring_of(std::size_t material, const Vec3d& at, double rate) {
  Emitter e;
  e.name = "spring_" + std::to_string(material);
  e.material = material;
  e.shape = BoxShape{at, at + Vec3d{1.5, 0.5, 1.5}};
  e.rate = rate;
  e.speed = {1, 3};
  e.spread = 40;
  return e;
}

// A busy scene with sparks among its particles, emitters of both kinds (one emitter moves), lives that end and begin
// anew, and two sinks.
class Births : public testing::TestWithParam<BusyKind> {
 protected:
  Births() : scene_(busy_scene(GetParam())), particles_(lattice(scene_, {6, 8, 6}, {-2.7, 0.4, -2.7}, 0.5, 0.1, 5)) {
    const std::size_t spark = scene_.materials.size();
    scene_.materials.push_back(sparks());
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      const auto u = random4(6, i);
      particles_.velocity[i] = {6 * (u[0] - 0.5), 6 * (u[1] - 0.5), 6 * (u[2] - 0.5)};
      particles_.id[i] = 2 * i + 3;
      if (i % 4 == 3) particles_.material[i] = static_cast<std::uint16_t>(spark);
    }
    Emitter sprayed = spring_of(spark, {1, 2, 1}, 4000);
    sprayed.life = Range{0.01, 0.04};
    sprayed.decay = {0.8, 1.2};
    sprayed.respawn = true;
    sprayed.stop = 0.03;
    sprayed.motion = SteadyMotion{{0.5, 1, 0}, {0, 3, 0}, {}};
    Emitter poured = spring_of(1, {2.4, 6, -2}, 3000);
    poured.count = 90;
    poured.life = Range{0.03, 0.09};
    scene_.emitters = {sprayed, poured};
    scene_.sinks = {{SphereShape{{-2, 1, -2}, 0.7}}, {PlaneShape{{0, 8.5, 0}, {0, -1, 0}}}};
  }

  Engine engine(int threads) const { return {"cpu", GetParam().precision, threads, "", true}; }
  Engine gpu() const { return {"gpu", GetParam().precision, 1, ""}; }

  Scene scene_;
  ParticleSet particles_;
};

TEST_P(Births, AreThoseOfTheReference) {
  if (GetParam().precision == Precision::single_precision) GTEST_SKIP() << "the reference is in double";
  for (const Isa& isa : available_isas()) {
    SCOPED_TRACE(isa.name);
    Simulation reference = simulate(scene_, particles_, kReference);
    Simulation cpu = simulate(scene_, particles_, {"cpu", Precision::double_precision, 2, isa.name, true});
    for (int step = 1; step <= 100; ++step) {
      ASSERT_TRUE(advance(reference, 1));
      ASSERT_TRUE(advance(cpu, 1));
      ASSERT_EQ(reference.state_hash(), cpu.state_hash()) << "after step " << step;
      ASSERT_EQ(reference.particle_count(), cpu.particle_count());
    }
    EXPECT_EQ(reference.ids().back(), cpu.ids().back());
    const PopulationLedger &a = reference.ledger().population, &b = cpu.ledger().population;
    EXPECT_EQ(a, b);
    EXPECT_GT(a.born, 200U);
    EXPECT_GT(a.expired, 100U);
    EXPECT_GT(a.sunk, 3U);
    EXPECT_EQ(reference.ledger().removed, cpu.ledger().removed);
    const double elastic = reference.ledger().removed_elastic;
    EXPECT_GT(std::abs(elastic), 0.1);
    EXPECT_NEAR(cpu.ledger().removed_elastic, elastic, 1e-12 * std::abs(elastic));
    EXPECT_EQ(measured(reference).contacts, measured(cpu).contacts);
    EXPECT_EQ(cpu.neighbour_statistics().missed_contacts, 0U);
  }
}

TEST_P(Births, AreTheSameForAnyThreadsInstructionsAndDevices) {
  Simulation one = simulate(scene_, particles_, engine(1));
  ASSERT_TRUE(advance(one, 100));
  for (const Engine& engine : engines_with_the_same_bits(GetParam().precision)) {
    SCOPED_TRACE(engine.name());
    Simulation other = simulate(scene_, particles_, engine);
    ASSERT_TRUE(advance(other, 100));
    expect_same_bits(one, other);
  }
}

TEST_P(Births, AreTheSameOnAnyNumberOfRanks) {
  Simulation one = simulate(scene_, particles_, engine(1));
  ASSERT_TRUE(advance(one, 100));
  for (const int ranks : {2, 3, 6}) {
    SCOPED_TRACE(ranks);
    SimulationState saved;
    on_ranks(ranks, scene_, particles_, engine(1), [&](Simulation& many) {
      ASSERT_TRUE(advance(many, 43));
      saved = many.state();
      ASSERT_TRUE(advance(many, 57));
      expect_same_bits(one, many);
      EXPECT_EQ(many.state().emission, one.state().emission);
      EXPECT_EQ(many.neighbour_statistics().missed_contacts, 0U);
    });
    resume_on_ranks(5 - ranks / 2, scene_, saved, engine(1), [&](Simulation& resumed) {
      ASSERT_TRUE(advance(resumed, 57));
      expect_same_bits(one, resumed);
    });
  }
}

TEST_P(Births, GoOnAfterARestart) {
  Simulation whole = simulate(scene_, particles_, engine(2));
  ASSERT_TRUE(advance(whole, 90));
  for (const std::int64_t steps : {1, 17, 45}) {
    Simulation first = simulate(scene_, particles_, engine(2));
    ASSERT_TRUE(advance(first, steps));
    Simulation second = resume(scene_, first.state(), steps == 17 ? gpu() : engine(1));
    EXPECT_EQ(second.state().emission, first.state().emission);
    ASSERT_TRUE(advance(second, 90 - steps));
    expect_same_bits(whole, second);
  }
}

// Kinetic, potential and elastic energy change as the ledger says, up to the integrator's error, which is as large as
// in a run without births.
TEST_P(Births, AreBooked) {
  Simulation sim = simulate(scene_, particles_, engine(2));
  const std::uint64_t start = sim.particle_count();
  ASSERT_TRUE(advance(sim, 100));
  const Ledger& l = sim.ledger();
  EXPECT_EQ(sim.particle_count() + l.removed + l.population.expired + l.population.sunk, start + l.population.born);
  // Under velocity Verlet the second half kick of particles that have just left is booked with the next step.
  const bool verlet = GetParam().integrator == Integrator::velocity_verlet;
  const double rounding = verlet ? 5e-6 : GetParam().precision == Precision::single_precision ? 1e-6 : 1e-13;
  EXPECT_LT(momentum_drift(measured(sim), l, sim.initial_momentum()), rounding);
}

// Particles in contacts and on springs die, sink and leave, and the kinetic energy is still the sum of all causes,
// births and departures: a contact that vanishes takes elastic energy along, but no kinetic energy. Without gravity,
// because its potential is booked together with the kinetic energy. Under velocity Verlet particles that have just left
// take work along that is booked with the next step.
TEST_P(Births, KineticEnergyBalances) {
  if (GetParam().precision == Precision::single_precision) GTEST_SKIP() << "rounds by more than that";
  if (GetParam().integrator == Integrator::velocity_verlet) GTEST_SKIP() << "books a part ahead";
  scene_.gravity = {0, 0, 0};
  scene_.time_step = 0.0005;  // small, for particles that get stuck between colliders
  auto structure = std::make_shared<Structure>();
  for (std::size_t i = 1; i < particles_.size(); i += 2) {
    structure->springs.push_back({particles_.id[i - 1], particles_.id[i], 0.45, 500, 0.5});
  }
  scene_.structure = structure;
  for (const Engine& by : {engine(2), kReference}) {
    Simulation sim = simulate(scene_, particles_, by);
    const Measurements start = measured(sim);
    ASSERT_TRUE(advance(sim, 200));
    const Measurements end = measured(sim);
    const Ledger& l = sim.ledger();
    EXPECT_GT(l.population.expired, 100U);
    EXPECT_LT(end.springs, start.springs);
    const double come = l.population.born_energy, gone = l.removed_energy;
    double given = come - gone, throughput = start.kinetic_energy + end.kinetic_energy + come + gone;
    for (const double work : l.work.of) {
      given += work;
      throughput += std::abs(work);
    }
    EXPECT_NEAR(end.kinetic_energy - start.kinetic_energy, given, 1e-12 * throughput) << by.name();
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Births, all_busy_kinds(), [](const auto& instance) { return instance.param.name(); });

// A gas touches nothing, is slowed by drag and dies out. Its energy is fully accounted for by births, deaths and the
// work of drag.
TEST(BirthLedger, KineticEnergyBalances) {
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    Scene scene = open_scene();
    scene.materials = {sparks()};
    scene.integrator = integrator;
    scene.gravity = {0, 0, 0};
    Emitter e = spring_of(0, {0, 0, 0}, 20000);
    e.life = Range{0.005, 0.02};
    e.stop = 0.05;
    scene.emitters = {e};
    for (const Engine& engine : {kReference, kCpuDouble, kGpuDouble}) {
      Simulation sim = simulate(scene, {}, engine);
      ASSERT_TRUE(advance(sim, 100));
      EXPECT_EQ(sim.particle_count(), 0U);
      const Ledger& l = sim.ledger();
      EXPECT_EQ(l.population.expired, 1000U);
      EXPECT_LT(l.work[Cause::drag], -0.001 * l.population.born_energy);
      // Each of 100 steps rounds sums of this size, by 1e-16 of them.
      EXPECT_NEAR(l.removed_energy - l.population.born_energy, l.work[Cause::drag], 1e-13 * l.population.born_energy);
    }
  }
}

TEST(Emitters, KeepTheirRate) {
  Scene scene = open_scene();
  scene.materials.push_back(sparks());
  Emitter e = spring_of(1, {0, 0, 0}, 333.3);
  e.start = 0.0105;  // steps 12 to 70
  e.stop = 0.07;
  scene.emitters = {e};
  Simulation sim = simulate(scene, {}, kCpuDouble);
  for (int step = 1; step <= 100; ++step) {
    ASSERT_TRUE(advance(sim, 1));
    const double steps = std::clamp(step - 11, 0, 59);
    EXPECT_EQ(sim.particle_count(), static_cast<std::uint64_t>(std::floor(steps * 333.3 * 0.001 + 1e-9))) << step;
  }
}

// 0.1 births a step are one birth every ten steps, never one in eleven.
TEST(Emitters, CarryTheRemainder) {
  Scene scene = open_scene();
  scene.materials.push_back(sparks());
  scene.emitters = {spring_of(1, {0, 0, 0}, 100)};
  Simulation sim = simulate(scene, {}, kReference);
  ASSERT_TRUE(advance(sim, 1000));
  EXPECT_EQ(sim.particle_count(), 100U);
}

// In a space that is soon full, births wait. No particle is ever born into an overlap with a wall, a collider or a
// particle, across periodic faces too.
TEST(Emitters, NeverBearIntoAnOverlap) {
  for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle}) {
    Scene scene = open_scene();
    scene.domain = {{0, 0, 0}, {6, 4, 5}, {Boundary::periodic, Boundary::spring, Boundary::spring}};
    mix_materials(scene, 0.3);
    Collider ball;
    ball.name = "ball";
    ball.shape = SphereShape{{3, 2, 2.5}, 0.8};
    scene.colliders = {ball};
    Emitter e = spring_of(0, {0, 0, 0}, 20000);
    e.shape = BoxShape{{-1, -1, -1}, {7, 5, 6}};
    e.speed = {0, 0};
    scene.emitters = {e};
    scene.gravity = {0, 0, 0};
    Simulation sim = simulate(scene, {}, engine);
    ASSERT_TRUE(advance(sim, 60));
    const Measurements now = measured(sim);
    EXPECT_EQ(now.contacts, 0U) << engine.name();
    EXPECT_EQ(now.wall_contacts, 0U);
    EXPECT_EQ(now.collider_elastic_energy, 0);
    EXPECT_EQ(now.kinetic_energy, 0);
    // Spheres added one after the other at random positions jam at 0.38 of the volume; 60 steps get a good part of the
    // way there.
    const double volume = 6 * 4 * 5 - 4.0 / 3 * M_PI * 0.8 * 0.8 * 0.8;
    const double r = scene.materials[0].radius;
    EXPECT_GT(static_cast<double>(now.particles) * 4 / 3 * M_PI * r * r * r, 0.15 * volume);
    EXPECT_LT(now.particles, 1200U);  // 1,200 were due
  }
}

// The rate is kept on average: births that had to wait take place when there is room.
TEST(Emitters, CatchUp) {
  Scene scene = open_scene();
  Emitter e = spring_of(0, {0, 0, 0}, 1000);
  e.shape = SphereShape{{0, 0, 0}, 0.01};
  e.speed = {100, 100};
  scene.emitters = {e};
  // One birth a step is due; a particle is out of the way after ten steps of 0.1 m.
  Simulation sim = simulate(scene, {}, kCpuDouble);
  ASSERT_TRUE(advance(sim, 105));
  EXPECT_NEAR(static_cast<double>(sim.particle_count()), 10.5, 1);
  EXPECT_NEAR(sim.state().emission.emitters[0].due, 105 - static_cast<double>(sim.particle_count()), 1e-9);
}

TEST(Emitters, BearAgainUnderNewIds) {
  Scene scene = open_scene();
  scene.materials.push_back(sparks());
  Emitter e = spring_of(1, {0, 0, 0}, 1e5);
  e.count = 50;
  e.life = Range{0.004, 0.009};
  e.respawn = true;
  scene.emitters = {e};
  for (const Engine& engine : {kReference, kCpuDouble, kGpuDouble}) {
    Simulation sim = simulate(scene, {}, engine);
    std::set<std::uint64_t> ever, before;
    for (int step = 1; step <= 60; ++step) {
      ASSERT_TRUE(advance(sim, 1));
      const auto ids = sim.ids();
      const std::set<std::uint64_t> now(ids.begin(), ids.end());
      for (const std::uint64_t id : now) {
        if (!before.contains(id)) {
          EXPECT_TRUE(ever.insert(id).second) << "id " << id << " came back";
        }
      }
      before = now;
      const EmissionState state = sim.state().emission;
      EXPECT_EQ(now.size() + state.emitters[0].to_respawn, 50U) << "after step " << step;
    }
    EXPECT_GT(ever.size(), 300U);
    EXPECT_EQ(sim.next_id(), *ever.rbegin() + 1);
    EXPECT_EQ(sim.ledger().population.born, ever.size());
  }
}

// Many more particles are born than exist at any one time: the store of slots and ids does not grow beyond need, and
// nothing else changes.
TEST(Emitters, GoOnForLong) {
  Scene scene = open_scene();
  scene.materials.push_back(sparks());
  Emitter e = spring_of(1, {0, 0, 0}, 4e6);
  e.life = Range{0.002, 0.004};
  Emitter old = spring_of(0, {10, 0, 0}, 1e5);
  old.life = Range{0.01, 0.03};
  scene.emitters = {e, old};
  Simulation b = simulate(scene, {}, {"cpu", Precision::double_precision, 2, ""});

  ASSERT_TRUE(advance(b, 60));
  Simulation c = resume(scene, b.state(), kCpuDouble);
  ASSERT_TRUE(advance(b, 10));
  ASSERT_TRUE(advance(c, 10));
  EXPECT_EQ(b.state_hash(), c.state_hash());
  EXPECT_GT(b.ledger().population.born, 250000U);
  EXPECT_LT(b.particle_count(), 20000U);
}

TEST(Sinks, TakeWhoIsInsideAndNobodyElse) {
  Scene scene = open_scene();
  scene.gravity = {0, 0, 0};
  scene.sinks = {{BoxShape{{0, 0, 0}, {2, 2, 2}}}, {CapsuleShape{{10, 0, 0}, {12, 0, 0}, 1}}};
  ParticleSet p;
  add(p, {-0.01, 1, 1}, {1, 0, 0});  // is in the box after 10 steps of 0.001
  add(p, {-0.1, 0.2, 1.9}, {1, 0, 0});  // after 100
  add(p, {12.9, 0, 0}, {0, 0, 0});  // in the capsule's cap
  add(p, {12.9, 1.1, 0}, {0, 0, 0});  // beside it
  for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle}) {
    Simulation sim = simulate(scene, p, engine);
    EXPECT_EQ(sim.particle_count(), 4U);
    ASSERT_TRUE(advance(sim, 20));
    EXPECT_EQ(sim.ledger().population.sunk, 2U);
    EXPECT_EQ(sim.ledger().removed, 0U);
    EXPECT_EQ(std::vector<std::uint64_t>(sim.ids().begin(), sim.ids().end()), (std::vector<std::uint64_t>{2, 4}));
    EXPECT_EQ(sim.ledger().removed_momentum.x, 1);
    EXPECT_EQ(sim.ledger().removed_energy, 0.5);
  }
}

// Springs tie sparks to each other and to other particles, some are pinned, all attract each other. When a particle
// dies or sinks, its springs go with it, and the particle that takes its place in memory is not tied.
TEST(Sparks, FeelSpringsAndAttraction) {
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    Scene scene = busy_scene({Boundary::spring, integrator, Precision::double_precision});
    scene.materials.push_back(sparks());
    const auto spark = static_cast<std::uint16_t>(scene.materials.size() - 1);
    ParticleSet p = lattice(scene, {6, 6, 6}, {-2.5, 0.6, -2.5}, 0.6, 0.05, 5);
    auto structure = std::make_shared<Structure>();
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (i % 3 != 0) p.material[i] = spark;
      if (i + 1 < p.size() && i % 6 != 5) structure->springs.push_back({p.id[i], p.id[i + 1], 0.5, 30, 0.1});
      if (i % 31 == 7) structure->pinned.push_back(p.id[i]);
      p.velocity[i] = i % 31 == 7 ? Vec3d{0, 0, 0} : Vec3d{0.5, 0, random4(2, i)[0]};
    }
    scene.structure = structure;
    scene.attraction = Attraction{};
    scene.attraction->constant = 0.01;
    Emitter e = spring_of(spark, {1, 2, 1}, 3000);
    e.life = Range{0.005, 0.03};
    scene.emitters = {e};
    scene.sinks = {{SphereShape{{0.5, 2, 0}, 0.8}}};
    Simulation reference = simulate(scene, p, kReference),
               cpu = simulate(scene, p, {"cpu", Precision::double_precision, 2, ""});
    for (int step = 1; step <= 80; ++step) {
      ASSERT_TRUE(advance(reference, 1));
      ASSERT_TRUE(advance(cpu, 1));
      ASSERT_EQ(reference.state_hash(), cpu.state_hash()) << "after step " << step;
    }
    EXPECT_GT(cpu.ledger().population.sunk, 3U);
    EXPECT_LT(measured(cpu).springs, structure->springs.size());
    EXPECT_EQ(measured(cpu).springs, measured(reference).springs);
    Simulation second = resume(scene, reference.state(), kCpuDouble);
    ASSERT_TRUE(advance(second, 20));
    ASSERT_TRUE(advance(cpu, 20));
    EXPECT_EQ(second.state_hash(), cpu.state_hash());
  }
}

// A spark falls through a pile, and bounces off the floor as a particle without neighbours does.
TEST(Sparks, TouchWallsAndCollidersOnly) {
  for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle}) {
    Scene scene = open_scene();
    scene.gravity = {0, -9.8, 0};
    Material spark = scene.materials[0], ball = spark;
    spark.interacts = false;
    spark.name = "spark";
    scene.materials = {ball, spark};
    Collider floor;
    floor.name = "floor";
    floor.shape = PlaneShape{{0, 0, 0}, {0, 1, 0}};
    scene.colliders = {floor};
    ParticleSet p;
    add(p, {0, 0.6, 0}, {0, 0, 0}, 0);
    add(p, {0, 3, 0}, {0, 0, 0}, 1);
    add(p, {0.2, 3, 0}, {0, 0, 0}, 1);  // overlaps the other spark all the way
    add(p, {50, 3, 0}, {0, 0, 0}, 0);  // the same fall, with no particle in the way
    Simulation sim = simulate(scene, p, engine);
    for (int k = 0; k < 20; ++k) {
      ASSERT_TRUE(advance(sim, 50));
      const auto x = sim.positions();
      EXPECT_EQ(x[1].y, x[3].y);
      EXPECT_EQ(x[2].y, x[3].y);
      EXPECT_EQ(x[1].x, 0);
    }
    EXPECT_EQ(measured(sim).contacts, 0U);
    EXPECT_TRUE(find_contacts(sim.scene(), sim.particles()).empty());
  }
}

}  // namespace
}  // namespace hooke::test
