// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "hooke/base/expected.h"
#include "hooke/run/launched_ranks.h"
#include "hooke/run/open_simulation.h"

namespace hooke::run {

// What rank 0 and the others say to each other around a simulation.

/// What rank 0 has the others do.
struct RankOrder {
  enum class Kind : std::uint8_t { open, end };
  Kind kind = Kind::end;
  int status = 0;  ///< end: the exit status
  // open:
  SceneArguments scene;
  DeviceArguments device;
};
/// On rank 0.
void give_order(Communicator& communicator, const RankOrder& order);
/// On the others.
RankOrder take_order(Communicator& communicator);

/// What a rank has made ready, to be compared with what the others have.
struct RankReadiness {
  std::uint64_t scene = 0;  ///< a hash of the scene as it was understood, and of the program's version
  int threads = 1;
};
std::uint64_t hash_of_scene(const std::string& resolved);

/// All ranks say whether they are ready. The threads of all ranks where they are; otherwise rank 0 gets the error of
/// the first rank that is not, the others get any.
Expected<int> agree(Communicator& communicator, const Expected<RankReadiness>& here);

}  // namespace hooke::run
