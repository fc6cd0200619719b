// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Fields: the CPU back end against the reference, and the same bits on any threads and instruction set.

#include <gtest/gtest.h>

#include "busy_scenes.h"
#include "hooke/backends/cpu/isa.h"
#include "support/ranks.h"

namespace hooke::test {
namespace {

constexpr int kEdge = 10;
constexpr std::int64_t kSteps = 60;

// A sheet through the block, under every kind of field; some of the sheet's corners leave or wrap.
class BusyFields : public testing::TestWithParam<BusyKind> {
 protected:
  BusyFields() : scene_(busy_scene(GetParam())) {
    particles_ = lattice(scene_, {kEdge, kEdge, kEdge}, {-2.7, 0.4, -2.7}, 0.5, 0.1, 5);
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      const auto u = random4(6, i);
      particles_.velocity[i] = {6 * (u[0] - 0.5), 6 * (u[1] - 0.5), 6 * (u[2] - 0.5)};
      particles_.id[i] = 3 * i + 5 + i / 10;
    }
    auto structure = std::make_shared<Structure>();
    Surface sheet{"linen", {}, {}};
    for (std::size_t i = 0; i < particles_.size(); i += 7) sheet.particles.push_back(particles_.id[i]);
    for (std::uint32_t k = 0; k + 2 < sheet.particles.size(); ++k) {
      sheet.triangles.insert(sheet.triangles.end(), {k, k + 2, k + 1});
    }
    structure->springs.push_back({particles_.id[0], particles_.id[1], 0.5, 400, 2});
    structure->surfaces = {sheet, sheet};
    scene_.structure = structure;
    const Gust gust{{0, 1, 3}, 3, 2.5};
    scene_.fields = {{Wind{{4, 0, 1}, {}, 0.3, gust}, {}, {}},
                     {Wind{{0, -1, 0}, 0.4, 0.1, Gust{{1, 0, 0}, 2, 0}}, BoxShape{{-2, 0, -3}, {1, 3, 1}}, {1, 2}},
                     {UniformPush{{0.5, 0, -1}}, {}, {0}},
                     {PushToward{{1, 4, 0}, 3, 0, 0}, {}, {}},
                     {PushToward{{-1, 1, 2}, 0, 2, 0.3}, BoxShape{{-3, 0, -3}, {0, 9, 4}}, {}}};
  }

  Engine engine(int threads) const { return {"cpu", GetParam().precision, threads, ""}; }

  Scene scene_;
  ParticleSet particles_;
};

TEST_P(BusyFields, HaveTheReferencesBits) {
  if (GetParam().precision == Precision::single_precision) GTEST_SKIP() << "the reference is double";
  Simulation all_pairs = simulate(scene_, particles_, kReference);
  Simulation fast = simulate(scene_, particles_, engine(2));
  ASSERT_TRUE(advance(all_pairs, kSteps));
  ASSERT_TRUE(advance(fast, kSteps));
  EXPECT_EQ(all_pairs.state_hash(), fast.state_hash());
  // Sums of the same terms, rounded once or twice.
  const double work = all_pairs.ledger().work[Cause::field], impulse = all_pairs.ledger().impulse[Cause::field].x;
  EXPECT_NEAR(fast.ledger().work[Cause::field], work, 1e-12 * std::abs(work));
  EXPECT_NEAR(fast.ledger().impulse[Cause::field].x, impulse, 1e-12 * std::abs(impulse));
  EXPECT_GT(std::abs(work), 1);
}

// Particles come and go between steps: sheets and springs stay what they are.
TEST_P(BusyFields, HaveTheReferencesBitsAfterEditsByHand) {
  if (GetParam().precision == Precision::single_precision) GTEST_SKIP() << "the reference is double";
  Simulation all_pairs = simulate(scene_, particles_, kReference);
  Simulation fast = simulate(scene_, particles_, engine(2));
  for (Simulation* s : {&all_pairs, &fast}) {
    ASSERT_TRUE(advance(*s, 5));
    const NewParticle added[] = {{0, {4, 8.5, 3}, {0, -1, 0}}, {1, {-2, 8.5, -2}, {0, 0, 0}}};
    ASSERT_TRUE(s->add_particles(added));
    ASSERT_TRUE(advance(*s, 5));
    const std::uint64_t gone[] = {particles_.id[0], particles_.id[7]};  // an end of the spring, a corner of the sheet
    if (s->find(gone[0]) && s->find(gone[1])) {
      ASSERT_TRUE(s->remove_particles(gone));
    }
    ASSERT_TRUE(s->add_particles({added, 1}));
    ASSERT_TRUE(advance(*s, 5));
  }
  EXPECT_EQ(all_pairs.state_hash(), fast.state_hash());
}

TEST_P(BusyFields, HaveTheSameBitsForAnyNumberOfThreadsInstructionSetAndDevice) {
  Simulation one = simulate(scene_, particles_, engine(1));
  ASSERT_TRUE(advance(one, kSteps));
  for (const int threads : {2, 3, 8}) {
    Simulation many = simulate(scene_, particles_, engine(threads));
    ASSERT_TRUE(advance(many, kSteps));
    expect_same_bits(one, many);
  }
  for (const Engine& engine : engines_with_the_same_bits(GetParam().precision)) {
    SCOPED_TRACE(engine.name());
    Simulation other = simulate(scene_, particles_, engine);
    ASSERT_TRUE(advance(other, kSteps));
    expect_same_bits(one, other);
  }
}

TEST_P(BusyFields, HaveTheSameBitsOnAnyNumberOfRanks) {
  Simulation one = simulate(scene_, particles_, engine(1));
  ASSERT_TRUE(advance(one, kSteps));
  for (const int ranks : {2, 5}) {
    SCOPED_TRACE(ranks);
    on_ranks(ranks, scene_, particles_, engine(1), [&](Simulation& many) {
      ASSERT_TRUE(advance(many, kSteps));
      expect_same_bits(one, many);
    });
  }
}

TEST_P(BusyFields, GoOnOverARestart) {
  Simulation whole = simulate(scene_, particles_, engine(2));
  ASSERT_TRUE(advance(whole, kSteps));
  Simulation first = simulate(scene_, particles_, engine(3));
  ASSERT_TRUE(advance(first, kSteps / 2));
  Scene rules = scene_;
  rules.structure = nullptr;  // as in a scene read without its particles; the state brings the structure
  Simulation second = resume(rules, first.state(), engine(1));
  ASSERT_TRUE(advance(second, kSteps / 2));
  expect_same_bits(whole, second);
}

TEST_P(BusyFields, AccountForTheirWorkAndMomentum) {
  Simulation s = simulate(scene_, particles_, engine(2));
  const double before = measured(s).kinetic_energy;
  ASSERT_TRUE(advance(s, kSteps));
  const bool single = GetParam().precision == Precision::single_precision;
  EXPECT_LT(momentum_drift(measured(s), s.ledger(), s.initial_momentum()), single ? 1e-6 : 1e-13);
  if (s.ledger().removed > 0) return;  // particles that left took energy along
  double sum = 0, scale = before;
  for (const double work : s.ledger().work.of) {
    sum += work;
    scale += std::abs(work);
  }
  EXPECT_NEAR(sum, measured(s).kinetic_energy - before, (single ? 1e-5 : 1e-12) * scale);
}

INSTANTIATE_TEST_SUITE_P(Kinds, BusyFields, all_busy_kinds(),
                         [](const auto& instance) { return instance.param.name(); });

}  // namespace
}  // namespace hooke::test
