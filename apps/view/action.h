// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/base/vec3.h"
#include "hooke/scene/json_reader.h"

namespace hooke::view {

// What a hand does to a simulation, between two steps. Everything that changes a simulation is one of these: a record
// is the list of them, each with the step at which it took effect. Numbers are stored so that they read back bit for
// bit.

/// Adds a ball of particles where there is room for them.
struct AddBall {
  std::string material;
  Vec3d center{0, 0, 0};    ///< m
  double radius = 1;        ///< m; a ball smaller than a particle is one particle
  Vec3d velocity{0, 0, 0};  ///< m/s
};

/// Takes hold of a collider: from now on it is where the hand leads it.
struct HoldCollider {
  std::string name;
  Vec3d rotation{0, 0, 0};  ///< in which it is held, rad
};
/// Takes hold of particles.
struct HoldParticles {
  std::vector<std::uint64_t> ids;
};
/// Leads what is held: `shift` is how far from where it was taken, m.
struct Lead {
  Vec3d shift{0, 0, 0};
};
/// Lets go. A collider stays where it is, particles fly on.
struct LetGo {};

/// Cuts springs, by their indices.
struct CutSprings {
  std::vector<std::uint64_t> springs;
};

/// Puts the particles, but for those that springs tie or that are held still, at random places of the domain, at rest.
struct Scatter {
  std::uint64_t seed = 1;
};

/// Starts again from the scene as it is now.
struct Reset {};

/// Goes on from a checkpoint of a simulation of this scene.
struct LoadCheckpoint {
  std::string file;  ///< absolute path
};

/// Changes the scene: a JSON Patch (RFC 6902) of its resolved text.
struct ChangeScene {
  scene::Json patch = scene::Json::array();
};

using Action = std::variant<AddBall, HoldCollider, HoldParticles, Lead, LetGo, CutSprings, Scatter, Reset,
                            LoadCheckpoint, ChangeScene>;

/// The name of an action in records: "add-ball".
const char* name_of(const Action& action);

scene::Json to_json(const Action& action);
/// bad_input, with what is wrong, where `json` is no action.
Expected<Action> action_from_json(const scene::Json& json);

}  // namespace hooke::view
