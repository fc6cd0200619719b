// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace hooke {

/// What parallel_ranges() comes to, whatever the body's type: so that files that ask for threads needn't compile
/// oneTBB's templates, which takes a second and more each.
using RangeFunction = void (*)(const void* body, std::size_t first, std::size_t last);
void run_ranges(std::size_t count, std::size_t grain, const void* body, RangeFunction call);

/// body(first, last) on disjoint ranges that cover [0, count), each but the last a whole number of `grain`, > 0. Ranges
/// run on the threads of the task arena that this is called in, in no order; what they compute must not depend on the
/// split.
template <class Body>
void parallel_ranges(std::size_t count, std::size_t grain, const Body& body) {
  run_ranges(count, grain, &body,
             [](const void* of, std::size_t first, std::size_t last) { (*static_cast<const Body*>(of))(first, last); });
}

}  // namespace hooke
