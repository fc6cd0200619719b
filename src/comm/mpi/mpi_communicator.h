// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "hooke/base/expected.h"
#include "hooke/core/communicator.h"

namespace hooke {

struct MpiOptions {
  /// Longer messages than this are sent in pieces, bytes: MPI counts in int.
  std::size_t largest_message = std::size_t{1} << 30U;
};

/// Joins the other ranks by MPI, of which the launcher has started `launched` in all. To be called once in a program,
/// by the thread that will call the communicator; MPI ends with its last copy. bad_input where MPI finds another number
/// of ranks.
Expected<std::shared_ptr<Communicator>> join_ranks(int launched, const MpiOptions& options = {});

}  // namespace hooke
