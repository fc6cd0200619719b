// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "arguments.h"
#include "hooke/base/expected.h"
#include "record.h"
#include "timeline.h"

namespace hooke::view {

/// How a replay without a window ended.
struct ReplayEnd {
  ReplayReport report;
  std::int64_t steps = 0;
  std::uint64_t state_hash = 0;
};

/// Replays a record to its end, or to the first hash that is wrong. `scene` is opened as the record says.
Expected<ReplayEnd> replay(const Record& record, const run::SceneArguments& scene, const run::DeviceArguments& device);

}  // namespace hooke::view
