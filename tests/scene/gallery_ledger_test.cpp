// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The ledger on every scene of the gallery.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gallery_scenes.h"
#include "support/engines.h"

namespace hooke::test {
namespace {

class GalleryLedger : public GalleryScenes {};

// The gain in kinetic energy is the work of all causes plus the energy that particles bring and take: in double up to
// rounding, a billionth of the energy that goes through the ledger. Where particles come and go, without gravity: the
// ledger does not tell their potential energy from the kinetic.
TEST_P(GalleryLedger, KineticEnergyBalances) {
  Scene scene = loaded_.scene;
  if (!scene.emitters.empty()) scene.gravity = {0, 0, 0};
  Simulation s = simulate(scene, loaded_.particles, {"cpu", Precision::double_precision, 2, ""});
  const double before = measured(s).kinetic_energy;
  const auto many = static_cast<std::int64_t>(loaded_.particles.size());
  const std::int64_t moves = !scene.attraction ? 4'000'000 : 800'000;  // a sum over all pairs takes its time
  ASSERT_TRUE(advance(s, std::clamp<std::int64_t>(moves / std::max<std::int64_t>(many, 1), 20, 2000)));
  const Ledger& l = s.ledger();
  if (scene.emitters.empty()) {
    ASSERT_EQ(l.removed + l.population.sunk, 0U) << "takes gravity's potential along";
  }
  const double after = measured(s).kinetic_energy, born = l.population.born_energy;
  double given = born - l.removed_energy, throughput = before + after + born + l.removed_energy;
  for (const double work : l.work.of) {
    given += work;
    throughput += std::abs(work);
  }
  EXPECT_GT(throughput, 0);
  EXPECT_NEAR(after - before, given, 1e-9 * throughput);
}

INSTANTIATE_TEST_SUITE_P(Gallery, GalleryLedger, testing::ValuesIn(bundled_names(false)), bundled_test_name);

}  // namespace
}  // namespace hooke::test
