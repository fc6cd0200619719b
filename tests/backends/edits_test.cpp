// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Edits by hand change the slots concerned; the rest of the state, such as the neighbour list, goes on.

#include <gtest/gtest.h>

#include "busy_scenes.h"

namespace hooke::test {
namespace {

class EditedScenes : public BusyScenes {
 protected:
  EditedScenes() {
    // Does not move from where an edit puts it.
    Material post = scene_.materials[0];
    post.name = "post";
    post.fixed = true;
    scene_.materials.push_back(post);
  }

  // The n-th burst of edits: kicks, pushes to nearby, throws across the domain, births and removals.
  static void edit(Simulation& s, std::uint64_t n) {
    const std::vector<std::uint64_t> ids(s.ids().begin(), s.ids().end());
    const Domain& domain = s.scene().domain;
    const auto anywhere = [&](std::uint64_t k) {
      const auto u = random4(100 + n, k);
      const Vec3d size = domain.max - domain.min;
      return domain.min + Vec3d{u[0] * size.x, u[1] * size.y, u[2] * size.z};
    };
    for (std::uint64_t k = 0; k < 12; ++k) {
      const std::uint64_t id = ids[(7919 * (n + 1) * (k + 1)) % ids.size()];
      const ParticleSet& now = s.particles();
      const std::size_t i = now.find(id);
      const Vec3d x = now.position[i], v = now.velocity[i];
      if (k % 3 == 0) {
        ASSERT_TRUE(s.apply_impulse(id, {0.5, 1, -0.5}));
      } else if (k % 3 == 1) {
        const Vec3d near{std::clamp(x.x + 0.1, domain.min.x, domain.max.x), x.y, x.z};
        if (near.y >= domain.min.y) {
          ASSERT_TRUE(s.set_particle(id, near, v));
        }
      } else {
        ASSERT_TRUE(s.set_particle(id, anywhere(k), 0.1 * v));
      }
    }
    const NewParticle added[] = {{1, anywhere(50), {0, -1, 0}},
                                 {s.scene().materials.size() - 1, anywhere(51), {0, 0, 0}}};
    ASSERT_TRUE(s.add_particles(added));
    const std::uint64_t gone[] = {ids[n], ids[ids.size() / 2 + n]};
    ASSERT_TRUE(s.remove_particles(gone));
  }
};

TEST_P(EditedScenes, GoOnAsIfAllWereLaidOutAnew) {
  Engine checked = engine(2);
  checked.check_list = true;
  Simulation edited = simulate(scene_, particles_, checked);
  Simulation laid_out = simulate(scene_, particles_, engine(1));
  for (std::uint64_t burst = 0; burst < 8; ++burst) {
    for (Simulation* s : {&edited, &laid_out}) {
      ASSERT_TRUE(advance(*s, 5));
      ASSERT_NO_FATAL_FAILURE(edit(*s, burst));
    }
    ASSERT_TRUE(laid_out.restore(laid_out.state()));
    expect_same_bits(edited, laid_out);
  }
  ASSERT_TRUE(advance(edited, 10));
  ASSERT_TRUE(advance(laid_out, 10));
  expect_same_bits(edited, laid_out);
  EXPECT_EQ(edited.neighbour_statistics().missed_contacts, 0U);
  if (GetParam().integrator == Integrator::symplectic_euler) {
    EXPECT_LT(momentum_drift(measured(edited), edited.ledger(), edited.initial_momentum()), 1e-6);
  }
}

TEST_P(EditedScenes, HaveTheBitsOfTheReference) {
  if (GetParam().precision == Precision::single_precision) GTEST_SKIP() << "the reference computes in double";
  Simulation ours = simulate(scene_, particles_, engine(2));
  Simulation reference = simulate(scene_, particles_, kReference);
  for (std::uint64_t burst = 0; burst < 2; ++burst) {
    for (Simulation* s : {&ours, &reference}) {
      ASSERT_TRUE(advance(*s, 2));
      ASSERT_NO_FATAL_FAILURE(edit(*s, burst));
    }
  }
  ASSERT_TRUE(advance(ours, 2));
  ASSERT_TRUE(advance(reference, 2));
  EXPECT_EQ(ours.state_hash(), reference.state_hash());
  EXPECT_EQ(ours.particles().acceleration, reference.particles().acceleration);
}

// Forces by id find their particles through rebuilds, births, removals, and slots that change hands.
TEST_P(EditedScenes, PushedByTheCallerHaveTheSameBits) {
  const bool single = GetParam().precision == Precision::single_precision;
  Simulation ours = simulate(scene_, particles_, engine(2));
  Simulation other = simulate(scene_, particles_, single ? engine(1) : kReference);
  Simulation gpu = simulate(scene_, particles_, {"gpu", GetParam().precision, 1, ""});
  for (std::uint64_t burst = 0; burst < 3; ++burst) {
    for (Simulation* s : {&ours, &other, &gpu}) {
      if (burst > 0) {
        ASSERT_NO_FATAL_FAILURE(edit(*s, burst));
      }
      std::vector<std::uint64_t> ids;
      std::vector<Vec3d> forces;
      for (std::size_t i = burst; burst < 2 && i < s->ids().size(); i += 3) {
        const auto u = random4(77 + burst, i);
        ids.push_back(s->ids()[i]);
        forces.push_back({40 * (u[0] - 0.5), 40 * u[1], 40 * (u[2] - 0.5)});
      }
      ASSERT_TRUE(s->set_external_forces(ids, forces));
      ASSERT_TRUE(advance(*s, single ? 10 : 2));
    }
    EXPECT_EQ(ours.state_hash(), other.state_hash()) << "after burst " << burst;
    EXPECT_NEAR(ours.ledger().impulse[Cause::external].y, other.ledger().impulse[Cause::external].y, 1e-9);
    EXPECT_NEAR(ours.ledger().work[Cause::external], other.ledger().work[Cause::external], 1e-9);
  }
  EXPECT_GT(ours.ledger().impulse[Cause::external].y, 0);
  expect_same_bits(ours, gpu);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EditedScenes, all_busy_kinds(),
                         [](const auto& instance) { return instance.param.name(); });

// A fixed particle's place is no longer fixed once the particle is removed.
TEST(Edits, FreeThePlacesOfFixedParticles) {
  Scene scene = open_scene();
  scene.gravity = {0, -9.8, 0};
  Material post = scene.materials[0];
  post.name = "post";
  post.interacts = false;
  Material spark = post;
  spark.name = "spark";
  post.fixed = true;
  scene.materials = {post, spark};
  ParticleSet particles;
  add(particles, {0, 0, 0}, {0, 0, 0});
  add(particles, {5, 0, 0}, {0, 0, 0});
  for (const Engine& engine : {kReference, kCpuDouble, kGpuDouble}) {
    Simulation s = simulate(scene, particles, engine);
    ASSERT_TRUE(advance(s, 2));
    const std::uint64_t gone[] = {1};
    ASSERT_TRUE(s.remove_particles(gone));
    const NewParticle added[] = {{1, {1, 0, 0}, {0, 0, 0}}};
    ASSERT_TRUE(s.add_particles(added));
    ASSERT_TRUE(advance(s, 50));
    EXPECT_EQ(s.positions()[0], (Vec3d{5, 0, 0})) << engine.name();
    EXPECT_LT(s.positions()[1].y, 0) << engine.name();
  }
}

// Thousands of edits between two steps are handled together.
TEST(Edits, ByTheThousandHaveTheBitsOfAStateLaidOutAnew) {
  const Scene scene = open_scene();
  Simulation edited = simulate(scene, lattice(scene, {16, 16, 16}, {0, 0, 0}, 1.01, 0, 5), kCpuSingle);
  Simulation laid_out = simulate(scene, lattice(scene, {16, 16, 16}, {0, 0, 0}, 1.01, 0, 5), kCpuSingle);
  for (Simulation* s : {&edited, &laid_out}) {
    ASSERT_TRUE(advance(*s, 1));
    for (std::uint64_t id = 1; id <= 4096; id += 2) {
      const auto u = random4(9, id);
      ASSERT_TRUE(s->set_particle(id, {20 * u[0], 20 * u[1], 20 + 20 * u[2]}, {0, 0, 0}));
    }
  }
  ASSERT_TRUE(laid_out.restore(laid_out.state()));
  ASSERT_TRUE(advance(edited, 5));
  ASSERT_TRUE(advance(laid_out, 5));
  EXPECT_EQ(edited.state_hash(), laid_out.state_hash());
}

// A hand that holds a ball causes no rebuild of the list.
TEST(Edits, OfAPoolAtRestKeepItsList) {
  Scene scene = open_scene();
  const ParticleSet particles = lattice(scene, {12, 12, 12}, {0, 0, 0}, 1.01, 0, 5);  // apart, at rest
  Simulation s = simulate(scene, particles, kCpuSingle);
  ASSERT_TRUE(advance(s, 1));
  const std::uint64_t before = s.neighbour_statistics().rebuilds;
  for (int step = 0; step < 100; ++step) {
    ASSERT_TRUE(s.set_particle(7, {6 + 0.01 * step, 6, 13 - 0.01 * step}, {1, 0, -1}));
    ASSERT_TRUE(s.apply_impulse(9, {0, 1e-3, 0}));
    ASSERT_TRUE(advance(s, 1));
  }
  EXPECT_EQ(s.neighbour_statistics().rebuilds, before);
}

}  // namespace
}  // namespace hooke::test
