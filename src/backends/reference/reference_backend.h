// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "hooke/core/backend.h"

namespace hooke {

/// All pairs, double precision, one thread, O(N^2): the specification that every other back end must match, bit for
/// bit in double. For tests, teaching and a few thousand particles.
std::unique_ptr<Backend> make_reference_backend();

}  // namespace hooke
