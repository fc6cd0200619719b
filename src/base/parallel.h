// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace hooke {

/// parallel_ranges() independent of the body's type, so that files that use threads need not compile oneTBB's
/// templates, which takes a second or more per file.
using RangeFunction = void (*)(const void* body, std::size_t first, std::size_t last);
void run_ranges(std::size_t count, std::size_t grain, const void* body, RangeFunction call);

/// Calls body(first, last) on disjoint ranges that cover [0, count); each but the last is a multiple of `grain`, > 0.
/// Ranges run on the threads of the calling task arena, in no order; their results must not depend on the split.
template <class Body>
void parallel_ranges(std::size_t count, std::size_t grain, const Body& body) {
  run_ranges(count, grain, &body,
             [](const void* of, std::size_t first, std::size_t last) { (*static_cast<const Body*>(of))(first, last); });
}

}  // namespace hooke
