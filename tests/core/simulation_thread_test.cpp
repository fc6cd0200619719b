// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/simulation_thread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

using namespace std::chrono_literals;

class SimulationThreads : public testing::Test {
 protected:
  static Simulation pool(const Engine& engine = {"cpu", Precision::single_precision, 2, ""}, int edge = 8) {
    Scene scene = open_scene();
    scene.gravity = {0, -9.8, 0};
    scene.domain.boundary[1] = Boundary::spring;
    return simulate(scene, lattice(scene, {edge, edge, edge}, {0, -99, 0}, 0.9, 0.05, 5), engine);
  }

  template <class Condition>
  static bool wait_until(const Condition& holds) {
    for (int i = 0; i < 10000; ++i) {
      if (holds()) return true;
      std::this_thread::sleep_for(1ms);
    }
    return false;
  }
};

TEST_F(SimulationThreads, TakeTheStepsThatTheyAreAskedForWithTheSameBits) {
  Simulation alone = pool();
  ASSERT_TRUE(advance(alone, 30));
  SimulationThread thread(pool(), true);
  EXPECT_TRUE(thread.is_paused());
  thread.step(10);
  thread.step();
  thread.step(19);
  ASSERT_TRUE(wait_until([&] { return thread.is_paused(); }));
  EXPECT_EQ(thread.ask([](Simulation& s) { return s.state_hash(); }).get(), alone.state_hash());
  EXPECT_EQ(thread.finish().state_hash(), alone.state_hash());
}

TEST_F(SimulationThreads, CarryOutCommandsBetweenStepsInTheirOrder) {
  SimulationThread thread(pool(), true);
  std::vector<int> order;
  for (int k = 0; k < 100; ++k) {
    thread.post([&order, k](Simulation&) { order.push_back(k); });
    if (k == 50) thread.resume();
  }
  const auto pushed = thread.ask([](Simulation& s) { return s.apply_impulse(7, {0, 3, 0}); }).get();
  EXPECT_TRUE(pushed);
  EXPECT_EQ(order.size(), 100U);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
  thread.pause();
  const SimulationState saved = thread.ask([](Simulation& s) { return s.state(); }).get();
  const auto hash = thread.ask([](Simulation& s) { return s.state_hash(); }).get();
  thread.step(5);
  ASSERT_TRUE(wait_until([&] { return thread.is_paused(); }));
  EXPECT_NE(thread.ask([](Simulation& s) { return s.state_hash(); }).get(), hash);
  EXPECT_TRUE(thread.ask([&](Simulation& s) { return s.restore(saved); }).get());
  EXPECT_EQ(thread.finish().state_hash(), hash);
}

// Readers take the latest state, and keep it while the simulation goes on.
TEST_F(SimulationThreads, ShowStatesThatNeverChange) {
  SimulationThread thread(pool());
  std::vector<std::thread> readers;
  for (int r = 0; r < 2; ++r) {
    readers.emplace_back([&] {
      std::vector<std::shared_ptr<const Snapshot>> kept;
      std::vector<double> heights;
      const auto height = [](const Snapshot& s) {
        double sum = 0;
        for (const Vec3d& x : s.particles.position) sum += x.y;
        return sum;
      };
      for (std::int64_t seen = -1; kept.size() < 6;) {
        std::shared_ptr<const Snapshot> now = thread.latest();
        ASSERT_GE(now->step, seen) << "time goes on";
        ASSERT_EQ(now->particles.size(), 512U);
        if (now->step == seen) continue;
        seen = now->step;
        heights.push_back(height(*now));
        kept.push_back(std::move(now));
      }
      for (std::size_t k = 0; k < kept.size(); ++k) ASSERT_EQ(height(*kept[k]), heights[k]);
    });
  }
  for (std::thread& reader : readers) reader.join();
  EXPECT_FALSE(thread.failure());
}

// Other threads read and edit it, and change a material, while it steps.
TEST_F(SimulationThreads, TakeEditsFromSeveralThreads) {
  SimulationThread thread(pool());
  std::vector<std::thread> hands;
  for (std::uint64_t h = 0; h < 3; ++h) {
    hands.emplace_back([&, h] {
      for (std::uint64_t k = 0; k < 20; ++k) {
        thread.post([=](Simulation& s) { ASSERT_TRUE(s.apply_impulse(1 + (31 * h + k) % 512, {0.1, 0, 0})); });
        (void)thread.latest();
        (void)thread.is_paused();
      }
    });
  }
  for (std::thread& hand : hands) hand.join();
  Material softer = open_scene().materials[0];
  softer.contact.stiffness *= 0.5;
  EXPECT_TRUE(thread.ask([=](Simulation& s) { return s.set_material(softer); }).get());
  const Simulation after = thread.finish();
  EXPECT_EQ(after.particle_count(), 512U);
  EXPECT_LT(momentum_drift(measured(after), after.ledger(), after.initial_momentum()), 1e-5);
}

TEST_F(SimulationThreads, SayWhatAStepFailedWithAndGoOnFromAnotherState) {
  SimulationThread thread(pool(), true);
  const SimulationState good = thread.ask([](Simulation& s) { return s.state(); }).get();
  ASSERT_TRUE(thread.ask([](Simulation& s) { return s.apply_impulse(1, {0, -1e6, 0}); }).get());
  thread.step(100);
  ASSERT_TRUE(wait_until([&] { return thread.is_paused(); }));
  ASSERT_TRUE(thread.failure());
  EXPECT_EQ(thread.failure()->kind, Error::Kind::run_failed);
  ASSERT_TRUE(thread.ask([&](Simulation& s) { return s.restore(good); }).get());
  thread.step(3);
  ASSERT_TRUE(wait_until([&] { return thread.is_paused(); }));
  EXPECT_FALSE(thread.failure());
  EXPECT_EQ(thread.finish().step_count(), 3);
}

TEST_F(SimulationThreads, EndInTheMidstOfARun) {
  std::future<int> never;
  {
    SimulationThread thread(pool());
    std::promise<void> begun;
    thread.post([&](Simulation&) {
      begun.set_value();
      std::this_thread::sleep_for(100ms);
    });
    never = thread.ask([](Simulation&) { return 1; });
    begun.get_future().wait();
  }
  EXPECT_THROW((void)never.get(), std::future_error);
}

// Requests that arrive during a step count for the steps after it.
TEST_F(SimulationThreads, LoseNoStepThatWasAskedForDuringAStep) {
  SimulationThread thread(pool(kReference, 14), true);  // large: its steps take many milliseconds
  std::int64_t taken = 0;
  for (int round = 0; round < 8 && taken != 3; ++round) {
    const std::int64_t before = thread.latest()->step;
    thread.step();
    std::this_thread::sleep_for(3ms);
    thread.pause();
    thread.step(2);
    ASSERT_TRUE(wait_until([&] { return thread.is_paused(); }));
    taken = thread.latest()->step - before;
    ASSERT_TRUE(taken == 2 || taken == 3) << taken;  // 2 where the first step had not begun
  }
  EXPECT_EQ(taken, 3);
}

TEST_F(SimulationThreads, OutliveWhatCommandsThrow) {
  SimulationThread thread(pool(), true);
  thread.post([](Simulation&) { throw std::runtime_error("out of luck"); });
  EXPECT_EQ(thread.ask([](Simulation&) { return 7; }).get(), 7);
  ASSERT_TRUE(thread.failure());
  EXPECT_NE(thread.failure()->text().find("out of luck"), std::string::npos);
  // A command that calls back when it is destroyed.
  struct Grip {
    SimulationThread* thread;
    ~Grip() { thread->pause(); }
  };
  thread.post([grip = std::make_shared<Grip>(&thread)](Simulation&) {});
  thread.step(2);
  ASSERT_TRUE(wait_until([&] { return thread.is_paused(); }));
}

TEST_F(SimulationThreads, TakeStepsThroughTheStepperThatTheyAreGiven) {
  Simulation alone = pool();
  ASSERT_TRUE(advance(alone, 12));
  int called = 0;
  SimulationThread thread(pool(), true, [&called](Simulation& s) -> Expected<void> {
    if (++called > 12) return fail(Error::Kind::run_failed, "stepper", "enough");
    return s.step();
  });
  thread.resume();
  ASSERT_TRUE(wait_until([&] { return thread.is_paused(); }));
  ASSERT_TRUE(thread.failure());
  EXPECT_NE(thread.failure()->text().find("enough"), std::string::npos);
  EXPECT_EQ(thread.finish().state_hash(), alone.state_hash());
}

TEST_F(SimulationThreads, KeepAPaceAndAnswerInBetween) {
  SimulationThread thread(pool(), true);
  thread.set_pace(20);
  const auto begin = std::chrono::steady_clock::now();
  thread.step(10);
  EXPECT_LT(thread.ask([](Simulation& s) { return s.step_count(); }).get(), 10);
  ASSERT_TRUE(wait_until([&] { return thread.is_paused(); }));
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 400ms);  // 9 intervals less what is made up for
  thread.set_pace(1e-3);
  thread.step(2);
  ASSERT_TRUE(wait_until([&] { return thread.latest()->step == 11; }));
  thread.set_pace(std::numeric_limits<double>::infinity());  // ends the wait
  ASSERT_TRUE(wait_until([&] { return thread.is_paused(); }));
  EXPECT_EQ(thread.latest()->step, 12);
}

TEST(SnapshotsOfASimulation, OutliveIt) {
  std::shared_ptr<const Snapshot> start, same, later;
  {
    const Scene scene = open_scene();
    Simulation s = simulate(scene, pair_on_x(scene, 0.1, {1, 0, 0}, {0, 0, 0}), kCpuDouble);
    start = s.snapshot();
    same = s.snapshot();
    ASSERT_TRUE(advance(s, 3));
    later = s.snapshot();
  }
  EXPECT_EQ(start, same) << "nothing has happened between them";
  EXPECT_EQ(start->step, 0);
  EXPECT_EQ(later->step, 3);
  EXPECT_NE(start->particles.position, later->particles.position);
}

}  // namespace
}  // namespace hooke::test
