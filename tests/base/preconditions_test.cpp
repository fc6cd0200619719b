// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
//
// A broken precondition is reported where it is broken: one test for each kind of precondition that headers state.

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "hooke/base/exact_sum.h"
#include "hooke/base/expected.h"
#include "hooke/base/parallel.h"
#include "hooke/base/sine.h"
#include "support/assertions.h"

namespace hooke {
namespace {

TEST(BasePreconditions, SumsWantValuesWhereThereIsACount) {
  ExactSum sum;
  EXPECT_ASSERTS(sum.add(static_cast<const double*>(nullptr), 3), "count = 3");
}

TEST(BasePreconditions, ErrorsHaveAFinding) { EXPECT_ASSERTS((void)fail(Error{}), "findings"); }

TEST(BasePreconditions, RangesHaveALength) {
  EXPECT_ASSERTS(parallel_ranges(5, 0, [](std::size_t, std::size_t) {}), "grain > 0; count = 5");
}

TEST(BasePreconditions, AnglesAreFinite) { EXPECT_ASSERTS((void)sine_cosine_of_turns(INFINITY), "turns = inf"); }

}  // namespace
}  // namespace hooke
