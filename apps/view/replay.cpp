// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "replay.h"

#include <utility>

#include "hooke/run/open_simulation.h"

namespace hooke::view {

Expected<ReplayEnd> replay(const Record& record, const run::SceneArguments& scene, const run::DeviceArguments& device) {
  auto opened = run::open_simulation(scene, device, {});
  if (!opened) return fail(std::move(opened).error());
  Simulation& simulation = opened->simulation;
  Timeline::Settings settings;
  settings.source = scene_source(scene, device);
  settings.scene = scene::Json::parse(opened->resolved);
  settings.replay = record.entries;
  settings.memory = 0;
  Timeline timeline(std::move(settings), simulation);
  if (auto begun = timeline.begin(simulation); !begun) return fail(std::move(begun).error());
  while (timeline.replay().running && !timeline.replay().diverged) {
    if (auto taken = timeline.step(simulation); !taken) return fail(std::move(taken).error());
  }
  return ReplayEnd{timeline.replay(), timeline.steps(), simulation.state_hash()};
}

}  // namespace hooke::view
