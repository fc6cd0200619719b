// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
//
// In this file assertions are off in every build. It includes no other header of Hooke's, because their inline
// functions would differ from the same functions in other files.
#undef HOOKE_ASSERTIONS
#define HOOKE_ASSERTIONS 0
#include "hooke/base/assert.h"

#include "base/assert_off.h"

namespace {

bool is_small(int value) { return value < 10; }  // used only in an assertion: no warning

}  // namespace

int evaluations_without_assertions() {
  int evaluated = 0;
  const int limit = 10;  // likewise
  HOOKE_ASSERT(++evaluated > limit, ++evaluated, limit);
  HOOKE_ASSERT(is_small(++evaluated));
  return evaluated;
}
