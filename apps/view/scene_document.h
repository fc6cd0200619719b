// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "arguments.h"
#include "hand.h"
#include "hooke/base/expected.h"
#include "hooke/core/simulation.h"
#include "hooke/scene/json_reader.h"
#include "hooke/scene/load_scene.h"

namespace hooke::view {

/// When a change of the scene takes effect.
enum class Effect {
  nothing,  ///< the simulation does not know of it
  at_once,  ///< between two steps
  rebuild,  ///< between two steps, in a new simulation made from the present particles
  reset,    ///< when the simulation starts again
};

/// Of a value at a JSON pointer such as "/materials/water/radius".
Effect effect_of(std::string_view pointer);

/// How simulations of a scene are made.
struct SceneSource {
  std::string name;              ///< of the scene in messages
  std::filesystem::path folder;  ///< to which its paths are relative
  bool allow_outside = false;
  std::function<Expected<std::unique_ptr<Backend>>(const Scene&, std::size_t particles)> make_backend;
};

SceneSource scene_source(const run::SceneArguments& scene, const run::DeviceArguments& device);

/// The text of a scene that changes while it is simulated.
class SceneDocument {
 public:
  /// `scene` is the resolved text as a value.
  SceneDocument(SceneSource source, scene::Json scene)
      : source_(std::move(source)),
        scene_(std::make_shared<const scene::Json>(std::move(scene))) {}

  const std::shared_ptr<const scene::Json>& json() const { return scene_; }

  /// Applies a patch to the text and what follows from it to the simulation. Where it fails, nothing has changed.
  Expected<void> change(Simulation& simulation, const scene::Json& patch, const Hand& hand);
  /// The simulation starts again, from the text as it is.
  Expected<void> reset(Simulation& simulation) const;
  /// The simulation goes on from a checkpoint of this scene.
  Expected<void> load_checkpoint(Simulation& simulation, const std::filesystem::path& file) const;
  /// The simulation goes on from `state`, of the scene `text`.
  Expected<void> go_back(Simulation& simulation, SimulationState state, std::shared_ptr<const scene::Json> text,
                         const Hand& hand);

 private:
  Expected<scene::LoadedScene> load(const scene::Json& scene, bool with_particles) const;
  /// The rules of a text that differs little from the present one, of which `present` was made: its meshes are taken
  /// from there, because their distance fields take seconds to make.
  Expected<scene::LoadedScene> load_rules(const scene::Json& scene, const Scene& present) const;
  Expected<void> rebuild(Simulation& simulation, Scene scene, SimulationState state, const Hand& hand) const;

  SceneSource source_;
  std::shared_ptr<const scene::Json> scene_;
};

/// The scene with its colliders where a hand has led them: what is saved.
scene::Json with_led_colliders(const scene::Json& scene, const std::vector<Hand::Led>& led);

}  // namespace hooke::view
