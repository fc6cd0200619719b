// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
//
// A broken precondition is reported where it is broken: one test for each kind of precondition that headers state.

#include <gtest/gtest.h>

#include "hooke/physics/contact.h"
#include "hooke/physics/enclosure.h"
#include "hooke/physics/stability.h"
#include "support/assertions.h"

namespace hooke {
namespace {

TEST(PhysicsPreconditions, ContactsActOnlyWithinTheirRange) {
  const ContactLaw<double> law;
  EXPECT_ASSERTS((void)contact_force(-0.5, {1, 0, 0}, {0, 0, 0}, law), "overlap = -0.5");
}

TEST(PhysicsPreconditions, MassesArePositive) {
  EXPECT_ASSERTS((void)effective_mass(1, 0), "mass_i = 1, mass_p = 0");
  EXPECT_ASSERTS((void)damping_ratio(1, 1, 0), "m_eff = 0");
}

TEST(PhysicsPreconditions, AMeshHasAField) {
  EXPECT_ASSERTS((void)encloses(DistanceFieldView{}, Vec3d{0, 0, 0}), "field.slots = null, field.cell = 1");
}

}  // namespace
}  // namespace hooke
