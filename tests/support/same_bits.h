// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include "support/engines.h"

namespace hooke::test {

/// Expects that two simulations hold the same bits: particles, ledger and figures.
inline void expect_same_bits(const Simulation& a, const Simulation& b) {
  EXPECT_EQ(a.state_hash(), b.state_hash());
  EXPECT_EQ(a.particles().position, b.particles().position);
  EXPECT_EQ(a.particles().acceleration, b.particles().acceleration);
  EXPECT_EQ(a.ledger(), b.ledger());
  const Measurements m = measured(a), n = measured(b);
  EXPECT_EQ(m.contacts, n.contacts);
  EXPECT_EQ(m.wall_contacts, n.wall_contacts);
  EXPECT_EQ(m.kinetic_energy, n.kinetic_energy);
  EXPECT_EQ(m.potential_energy, n.potential_energy);
  EXPECT_EQ(m.elastic_energy, n.elastic_energy);
  EXPECT_EQ(m.wall_elastic_energy, n.wall_elastic_energy);
  EXPECT_EQ(m.attraction_energy, n.attraction_energy);
  EXPECT_EQ(m.momentum, n.momentum);
  EXPECT_EQ(m.momentum_scale, n.momentum_scale);
  EXPECT_EQ(m.centre_of_mass, n.centre_of_mass);
  EXPECT_EQ(m.max_speed, n.max_speed);
  EXPECT_EQ(m.max_overlap_ratio, n.max_overlap_ratio);
  EXPECT_EQ(m.max_pair_overlap_ratio, n.max_pair_overlap_ratio);
  EXPECT_EQ(m.mean_overlap_ratio, n.mean_overlap_ratio);
  EXPECT_EQ(m.min, n.min);
  EXPECT_EQ(m.max, n.max);
  EXPECT_EQ(m.wall_force, n.wall_force);
  EXPECT_EQ(m.collider_elastic_energy, n.collider_elastic_energy);
  EXPECT_EQ(m.colliders, n.colliders);
}

}  // namespace hooke::test
