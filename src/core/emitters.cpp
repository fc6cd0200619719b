// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/emitters.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "hooke/base/assert.h"
#include "hooke/base/format.h"
#include "hooke/base/printable.h"
#include "hooke/core/births.h"
#include "hooke/core/free_space.h"
#include "hooke/core/placed_colliders.h"
#include "hooke/core/scene.h"

namespace hooke {
namespace {

class EmitterCheck {
 public:
  EmitterCheck(std::string where, std::vector<Finding>& findings) : where_(std::move(where)), findings_(findings) {}

  void check(const Emitter& e, const Scene& scene) {
    if (e.material >= scene.materials.size()) {
      add("material", "is no material of the scene");
    } else if (!scene.materials[e.material].is_of_particles()) {
      add("material", formatted("\"{}\" has no radius and no mass: only colliders may have it",
                                printable(scene.materials[e.material].name)));
    } else if (scene.materials[e.material].fixed) {
      add("material",
          formatted("\"{}\" is fixed: its particles could not leave", printable(scene.materials[e.material].name)));
    }
    if (std::holds_alternative<PlaneShape>(e.shape)) {
      add("shape", "must be a disc, or a box, sphere, capsule, cylinder or mesh, whose inside particles are born in");
    }
    at_least(0, "rate", e.rate);
    range("speed", e.speed, 0);
    const double length2 = dot(e.direction, e.direction);
    if (!(length2 > 0) || !std::isfinite(length2)) add("direction", "must be finite and not 0");
    if (!(e.spread >= 0 && e.spread <= 180)) {
      add("spread", formatted("{} must be from 0 to 180 degrees", e.spread));
    }
    if (e.life) positive("life", *e.life);
    positive("decay", e.decay);
    if (!std::isfinite(e.start)) add("start", "is not a finite number");
    if (!(e.stop >= e.start)) add("stop", formatted("{} must not be before \"start\", {}", e.stop, e.start));
    if (e.respawn && !e.life) add("respawn", "needs \"life\": those who live for ever are not born again");
  }

 private:
  void at_least(double least, const char* key, double value) {
    if (!std::isfinite(value) || value < least) add(key, formatted("{} must be {} or more", value, least));
  }
  void range(const char* key, const Range& r, double least) {
    const auto at = [key](int i) { return formatted("{}[{}]", key, i); };
    at_least(least, at(0).c_str(), r.least);
    if (!std::isfinite(r.most) || r.most < r.least) {
      add(at(1), formatted("{} must not be less than {}[0] = {}", r.most, key, r.least));
    }
  }
  void positive(const char* key, const Range& r) {
    range(key, r, 0);
    if (r.least == 0) add(formatted("{}[0]", key), "0 must be greater than 0");
  }
  void add(const std::string& key, std::string message) {
    findings_.push_back({where_ + "." + key, std::move(message)});
  }

  std::string where_;
  std::vector<Finding>& findings_;
};

}  // namespace

std::vector<Finding> check_emitters(const Scene& scene) {
  std::vector<Finding> findings;
  std::set<std::string> names;
  for (std::size_t i = 0; i < scene.emitters.size(); ++i) {
    const Emitter& e = scene.emitters[i];
    const std::string where = formatted("emitters[{}]", i);
    if (!names.insert(e.name).second) {
      findings.push_back({where + ".name", formatted("\"{}\" is the name of another emitter, too", printable(e.name))});
    }
    for (Finding& finding : validate(e.shape, where + ".shape")) findings.push_back(std::move(finding));
    EmitterCheck(where, findings).check(e, scene);
    for (Finding& finding : validate(e.motion, where + ".motion")) findings.push_back(std::move(finding));
  }
  for (std::size_t i = 0; i < scene.sinks.size(); ++i) {
    const std::string where = formatted("sinks[{}].shape", i);
    const Shape& shape = scene.sinks[i].shape;
    for (Finding& finding : validate(shape, where)) findings.push_back(std::move(finding));
    if (std::holds_alternative<DiscShape>(shape)) {
      findings.push_back(
          {where, "must be a plane, box, sphere, capsule, cylinder or mesh, that particles can be inside of"});
    }
    if (is_open_mesh(shape)) {
      findings.push_back(
          {where + ".mesh", "is open and has no inside that could take particles away; close its edges"});
    }
  }
  return findings;
}

namespace {

// Whether an emitter that does not move has any place for a birth, with only the domain and colliders that do not move
// in the way.
bool has_any_place(const Scene& scene, std::uint32_t index) {
  constexpr std::uint64_t kTries = 10000;
  const Emitter& emitter = scene.emitters[index];
  const double radius = scene.materials[emitter.material].radius;
  std::vector<PlacedCollider<double>> colliders;
  for (const Collider& c : scene.colliders) {
    if (std::holds_alternative<NoMotion>(c.motion)) {
      colliders.push_back(place_collider<double>(c, pose_at(c, 0), radius));
    }
  }
  const FreeSpace space(scene, emitter.material, colliders);
  const std::vector<double> areas = areas_of_birth(emitter.shape);
  const PlacedEmitter placed = place_emitter(emitter, index, 0, 0, areas);
  for (std::uint64_t k = 0; k < kTries; ++k) {
    if (space.has_room_at(draw_position(placed, k, 0))) return true;
  }
  return false;
}

}  // namespace

std::vector<Finding> check_places_of_birth(const Scene& scene) {
  std::vector<Finding> findings;
  for (std::uint32_t i = 0; i < scene.emitters.size(); ++i) {
    if (!std::holds_alternative<NoMotion>(scene.emitters[i].motion) || has_any_place(scene, i)) continue;
    findings.push_back({formatted("emitters[{}].shape", i),
                        "has no place where a particle is inside the domain and clear of walls and colliders"});
  }
  return findings;
}

double expected_population(const Emitter& emitter, double seconds) {
  double most = std::max(0.0, std::min(seconds, emitter.stop) - emitter.start);
  if (emitter.life && !emitter.respawn) {
    HOOKE_ASSERT(emitter.decay.least > 0, emitter.name, emitter.decay.least);
    const double mean = (emitter.life->least + emitter.life->most) / (emitter.decay.least + emitter.decay.most);
    most = std::min(most, 1.2 * mean);
  }
  const double births = emitter.rate * most;
  return emitter.count ? std::min(births, static_cast<double>(*emitter.count)) : births;
}

}  // namespace hooke
