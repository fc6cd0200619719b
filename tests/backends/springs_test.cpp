// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Springs and pinned particles: the CPU back end against the reference, and the same bits on any threads and
// instruction set.

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "busy_scenes.h"
#include "hooke/backends/cpu/isa.h"
#include "support/ranks.h"

namespace hooke::test {
namespace {

constexpr int kEdge = 8;

// Ties each particle of a cubic lattice to its next neighbours along the axes with springs of all modes. Some springs
// break; most keep their ends from touching.
std::shared_ptr<const Structure> tie_lattice(const ParticleSet& p) {
  auto structure = std::make_shared<Structure>();
  const auto tie = [&](int i, int j) {
    const auto n = structure->springs.size();
    const auto mode = static_cast<SpringMode>(n % 7 == 0 ? 1 : n % 5 == 0 ? 2 : 0);
    Spring s{p.id[static_cast<std::size_t>(i)], p.id[static_cast<std::size_t>(j)], 0.5, 400, 2};
    if (n % 2 == 0) std::swap(s.a, s.b);
    s.mode = mode;
    s.contact = n % 3 == 0;
    if (n % 2 == 0) s.break_strain = 0.15 + 0.01 * static_cast<double>(n % 11);
    structure->springs.push_back(s);
  };
  for (int i = 0; i < kEdge * kEdge * kEdge; ++i) {
    if ((i + 1) % kEdge != 0) tie(i, i + 1);
    if (i / kEdge % kEdge != kEdge - 1) tie(i, i + kEdge);
    if (i / (kEdge * kEdge) != kEdge - 1) tie(i, i + kEdge * kEdge);
  }
  for (std::size_t i = 0; i < p.size(); i += 37) structure->pinned.push_back(p.id[i]);
  return structure;
}

class Springs : public testing::TestWithParam<BusyKind> {
 protected:
  Springs() : scene_(busy_scene(GetParam())) {
    particles_ = lattice(scene_, {kEdge, kEdge, kEdge}, {-2.7, 0.4, -2.7}, 0.5, 0.1, 5);
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      const auto u = random4(6, i);
      particles_.velocity[i] = {6 * (u[0] - 0.5), 6 * (u[1] - 0.5), 6 * (u[2] - 0.5)};
      particles_.id[i] = 3 * i + 5 + i / 10;
    }
    scene_.structure = tie_lattice(particles_);
    for (std::size_t i = 0; i < particles_.size(); i += 37) particles_.velocity[i] = {0, 0, 0};
  }

  Engine engine(int threads) const { return {"cpu", GetParam().precision, threads, "", true}; }

  Scene scene_;
  ParticleSet particles_;
};

void expect_same_springs(const Simulation& a, const Simulation& b) {
  expect_same_bits(a, b);
  EXPECT_EQ(a.broken_springs(), b.broken_springs());
  EXPECT_EQ(measured(a).springs, measured(b).springs);
  EXPECT_EQ(measured(a).spring_energy, measured(b).spring_energy);
}

constexpr std::int64_t kSteps = 100;

TEST_P(Springs, HaveTheReferencesBits) {
  if (GetParam().precision == Precision::single_precision) GTEST_SKIP() << "the reference is double";
  Simulation all_pairs = simulate(scene_, particles_, kReference);
  Simulation fast = simulate(scene_, particles_, engine(2));
  ASSERT_TRUE(advance(all_pairs, kSteps));
  ASSERT_TRUE(advance(fast, kSteps));
  EXPECT_EQ(all_pairs.state_hash(), fast.state_hash());
  EXPECT_EQ(all_pairs.broken_springs(), fast.broken_springs());
  EXPECT_EQ(all_pairs.ledger().springs.broken, fast.ledger().springs.broken);
  EXPECT_GT(fast.broken_springs().size(), 50U) << "springs break on the way";
  EXPECT_LT(fast.broken_springs().size(), scene_.structure->springs.size() / 2);
  EXPECT_EQ(fast.neighbour_statistics().missed_contacts, 0U);
  const Measurements a = measured(all_pairs), b = measured(fast);
  EXPECT_EQ(a.springs, b.springs);
  EXPECT_EQ(a.contacts, b.contacts);
  // Sums of the same terms, rounded once or twice.
  EXPECT_NEAR(a.spring_energy, b.spring_energy, 1e-12 * a.spring_energy);
  const SpringLedger &x = all_pairs.ledger().springs, &y = fast.ledger().springs;
  const double x_work = all_pairs.ledger().work[Cause::springs], y_work = fast.ledger().work[Cause::springs];
  EXPECT_NEAR(x_work, y_work, 1e-11 * (std::abs(x_work) + x.dissipated));
  EXPECT_NEAR(x.dissipated, y.dissipated, 1e-12 * x.dissipated);
  EXPECT_NEAR(x.broken_energy, y.broken_energy, 1e-12 * x.broken_energy);
  EXPECT_NEAR(all_pairs.ledger().impulse[Cause::hold].y, fast.ledger().impulse[Cause::hold].y, 1e-9);
}

TEST_P(Springs, HaveTheSameBitsForAnyNumberOfThreadsInstructionSetAndDevice) {
  Simulation one = simulate(scene_, particles_, engine(1));
  ASSERT_TRUE(advance(one, kSteps));
  for (const int threads : {2, 3, 8}) {
    Simulation many = simulate(scene_, particles_, engine(threads));
    ASSERT_TRUE(advance(many, kSteps));
    expect_same_springs(one, many);
  }
  for (const Engine& engine : engines_with_the_same_bits(GetParam().precision)) {
    SCOPED_TRACE(engine.name());
    Simulation other = simulate(scene_, particles_, engine);
    ASSERT_TRUE(advance(other, kSteps));
    expect_same_springs(one, other);
  }
}

TEST_P(Springs, AreTheSameOnAnyNumberOfRanks) {
  Simulation one = simulate(scene_, particles_, engine(1));
  ASSERT_TRUE(advance(one, kSteps));
  for (const int ranks : {2, 3, 6}) {
    SCOPED_TRACE(ranks);
    SimulationState saved;
    on_ranks(ranks, scene_, particles_, engine(1), [&](Simulation& many) {
      ASSERT_TRUE(advance(many, kSteps / 2));
      saved = many.state();
      ASSERT_TRUE(advance(many, kSteps - kSteps / 2));
      expect_same_springs(one, many);
    });
    resume_on_ranks(7 - ranks, scene_, saved, engine(1), [&](Simulation& many) {
      ASSERT_TRUE(advance(many, kSteps - kSteps / 2));
      expect_same_springs(one, many);
    });
  }
}

TEST_P(Springs, StayBrokenOverARestart) {
  Simulation whole = simulate(scene_, particles_, engine(2));
  ASSERT_TRUE(advance(whole, kSteps));
  Simulation first = simulate(scene_, particles_, engine(3));
  ASSERT_TRUE(advance(first, kSteps / 2));
  const SimulationState saved = first.state();
  EXPECT_FALSE(saved.broken_springs.empty());
  Scene rules = scene_;
  rules.structure = nullptr;  // as in a scene read without its particles; the state brings the structure
  Simulation second = resume(rules, saved, engine(1));
  EXPECT_EQ(second.broken_springs(), saved.broken_springs);
  ASSERT_TRUE(advance(second, kSteps / 2));
  expect_same_springs(whole, second);
}

// The ledger has the energy of the springs, less what contacts between their ends, which may touch now, have gained.
TEST_P(Springs, ThatAreCutAreBrokenOnes) {
  Simulation cut = simulate(scene_, particles_, engine(2)), restored = simulate(scene_, particles_, engine(2));
  ASSERT_TRUE(advance(cut, kSteps / 2));
  ASSERT_TRUE(advance(restored, kSteps / 2));
  SimulationState state = restored.state();
  const std::uint64_t broken = cut.ledger().springs.broken, again = state.broken_springs.front();
  std::vector<std::uint64_t> whole;
  for (std::uint64_t k = 0; whole.size() < 5; ++k) {
    if (!std::binary_search(state.broken_springs.begin(), state.broken_springs.end(), k)) whole.push_back(k);
  }
  state.broken_springs.insert(state.broken_springs.end(), whole.begin(), whole.end());
  std::sort(state.broken_springs.begin(), state.broken_springs.end());
  const auto bound_energy = [](const Simulation& s) { return measured(s).elastic_energy + measured(s).spring_energy; };
  const double before = bound_energy(restored);
  ASSERT_TRUE(restored.restore(state));
  state.ledger.broken += 5;
  state.ledger.broken_energy.add(before);
  state.ledger.broken_energy.add(-bound_energy(restored));
  ASSERT_TRUE(restored.restore(std::move(state)));

  std::reverse(whole.begin(), whole.end());
  whole.insert(whole.end(), {again, whole.front()});  // in any order, broken already, and twice
  ASSERT_TRUE(cut.cut_springs(whole));
  EXPECT_EQ(cut.ledger().springs.broken, broken + 5);
  expect_same_bits(cut, restored);
  ASSERT_TRUE(advance(cut, kSteps / 2));
  ASSERT_TRUE(advance(restored, kSteps / 2));
  expect_same_bits(cut, restored);
  EXPECT_EQ(cut.broken_springs(), restored.broken_springs());

  const std::uint64_t hash = cut.state_hash(), none = scene_.structure->springs.size();
  for (const std::vector<std::uint64_t>& bad : {std::vector<std::uint64_t>{0, none}, {again}, {}}) {
    const auto refused = cut.cut_springs(bad);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, Error::Kind::bad_input);
  }
  EXPECT_EQ(cut.state_hash(), hash);
}

TEST_P(Springs, HoldParticlesStill) {
  Simulation s = simulate(scene_, particles_, engine(2));
  ASSERT_TRUE(advance(s, kSteps));
  const Vec3d impulse = s.ledger().impulse[Cause::hold];
  EXPECT_GT(dot(impulse, impulse), 1) << "gravity and springs pull";
  for (std::size_t i = 0; i < particles_.size(); i += 37) {
    const std::size_t k = s.particles().find(particles_.id[i]);
    ASSERT_LT(k, s.particles().size());
    const Vec3d off = s.positions()[k] - particles_.position[i];
    EXPECT_LT(dot(off, off), 1e-12) << "but for the rounding to single precision";
    EXPECT_EQ(s.velocities()[k], (Vec3d{0, 0, 0}));
  }
  // The impulse of the hold is in the ledger, so only rounding is left.
  const double drift = momentum_drift(measured(s), s.ledger(), s.initial_momentum());
  EXPECT_LT(drift, GetParam().precision == Precision::single_precision ? 1e-6 : 1e-13);
}

TEST_P(Springs, OfParticlesThatAreRemovedVanish) {
  Simulation s = simulate(scene_, particles_, engine(2));
  const std::uint64_t before = measured(s).springs;
  const std::uint64_t gone[] = {particles_.id[kEdge * kEdge + kEdge + 1]};  // an inner particle: six springs
  ASSERT_TRUE(s.remove_particles(gone));
  EXPECT_EQ(measured(s).springs, before - 6);
  ASSERT_TRUE(advance(s, 20));
  const std::uint64_t accounted = measured(s).springs + s.ledger().springs.broken + 6;
  if (s.ledger().removed == 0) {
    EXPECT_EQ(accounted, before);
  } else {
    EXPECT_LT(accounted, before) << "whoever left took its own along";
  }
}

// The work of all causes, J.
double total_work(const Ledger& ledger) {
  double sum = 0;
  for (const double work : ledger.work.of) sum += work;
  return sum;
}

// Contacts, walls, colliders, drag, gravity, springs and holds: in any step their work adds up to the gain in kinetic
// energy, as long as no particle leaves and takes its energy along.
TEST_P(Springs, AndAllOtherCausesDoTheWorkThatTheKineticEnergyGains) {
  Scene scene = scene_;
  if (scene.domain.boundary[0] == Boundary::open)
    scene.domain.boundary[0] = scene.domain.boundary[2] = Boundary::spring;
  for (const Engine& on : {engine(2), kReference}) {
    Simulation s = simulate(scene, particles_, on);
    const double before = measured(s).kinetic_energy;
    double throughput = before;
    for (int k = 0; k < 4; ++k) {
      ASSERT_TRUE(advance(s, 25));
      double scale = 0;
      for (const double work : s.ledger().work.of) scale += std::abs(work);
      throughput = std::max(throughput, scale);
      const double gain = measured(s).kinetic_energy - before;
      // Each step rounds each velocity once: some 1e5 roundings of half a unit, of either sign.
      const double limit = on.precision == Precision::single_precision ? 1e-5 : 1e-12;
      EXPECT_NEAR(total_work(s.ledger()), gain, limit * throughput) << on.name() << " after " << s.step_count();
      EXPECT_GT(std::abs(gain), 0.01 * before);
    }
    for (const Cause cause : {Cause::contact_shear, Cause::contact_damping, Cause::drag}) {
      EXPECT_LT(s.ledger().work[cause], 0) << "they only take";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Springs, all_busy_kinds(), [](const auto& instance) { return instance.param.name(); });

}  // namespace
}  // namespace hooke::test
