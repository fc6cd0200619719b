// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "scene_document.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "hooke/io/checkpoint.h"
#include "hooke/run/open_simulation.h"

namespace hooke::view {
namespace {

bool starts_with(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }
bool is_at_or_below(std::string_view pointer, std::string_view top) {
  return starts_with(pointer, top) && (pointer.size() == top.size() || pointer[top.size()] == '/');
}

// "/colliders/2/motion/...": whether the key after the index is `key`.
bool is_of_item(std::string_view pointer, std::string_view list, std::string_view key) {
  if (!is_at_or_below(pointer, list) || pointer.size() <= list.size() + 1) return false;
  const std::size_t slash = pointer.find('/', list.size() + 1);
  return slash != std::string_view::npos && is_at_or_below(pointer.substr(slash + 1), key);
}

std::set<std::string> changed_pointers(const scene::Json& patch) {
  std::set<std::string> pointers;
  for (const scene::Json& operation : patch) pointers.insert(operation.at("path").get<std::string>());
  return pointers;
}

Unexpected bad_patch(const char* what) { return fail(Error::Kind::bad_input, "patch", what); }

std::vector<std::string> material_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Material& m : scene.materials) names.push_back(m.name);
  return names;
}

// What a text of the changed scene has set anew in materials and motions, without a new simulation.
Expected<void> change_at_once(Simulation& simulation, const Scene& changed, const std::set<std::string>& pointers,
                              const Hand& hand) {
  const Scene before = simulation.scene();
  for (const Material& material : changed.materials) {
    const std::string entry = (scene::Json::json_pointer("/materials") / material.name).to_string();
    const auto own = [&](const std::string& pointer) { return is_at_or_below(pointer, entry); };
    if (std::none_of(pointers.begin(), pointers.end(), own)) continue;
    if (auto set = simulation.set_material(material); !set) {
      for (const Material& old : before.materials) (void)simulation.set_material(old);
      return set;
    }
  }
  for (std::size_t k = 0; k < changed.colliders.size(); ++k) {
    const std::string motion = "/colliders/" + std::to_string(k) + "/motion";
    const auto own = [&](const std::string& pointer) { return is_at_or_below(pointer, motion); };
    if (std::none_of(pointers.begin(), pointers.end(), own)) continue;
    if (auto set = simulation.set_collider_motion(changed.colliders[k].name, changed.colliders[k].motion); !set)
      return set;
  }
  return hand.reapply(simulation);
}

// The spacing of a mesh's distance field may follow from the smallest radius.
bool same_radii(const scene::Json& a, const scene::Json& b) {
  if (a.at("materials").size() != b.at("materials").size()) return false;
  for (const auto& [name, material] : a.at("materials").items()) {
    if (!b.at("materials").contains(name)) return false;
    if (material.value("radius", 0.0) != b.at("materials").at(name).value("radius", 0.0)) return false;
  }
  return true;
}

// Puts a small ball, far from everything, in place of each mesh of the list that is as in `before`; returns their
// indices.
std::vector<std::size_t> replace_same_meshes(const scene::Json& before, scene::Json& scene, const char* list,
                                             const Domain& domain) {
  std::vector<std::size_t> replaced;
  if (!before.contains(list) || !scene.contains(list)) return replaced;
  const scene::Json &old = before.at(list), here = scene::Json(scene.at(list));
  const Vec3d away = domain.max + 100 * (domain.max - domain.min);
  for (std::size_t k = 0; k < std::min(old.size(), here.size()); ++k) {
    const scene::Json shape = here[k].value("shape", scene::Json());
    if (!shape.is_object() || !shape.contains("mesh") || shape != old[k].value("shape", scene::Json())) continue;
    const double radius = 0.01 * domain.length(0);
    scene[list][k]["shape"] = {{"sphere", {{"center", {away.x, away.y, away.z}}, {"radius", radius}}}};
    replaced.push_back(k);
  }
  return replaced;
}

}  // namespace

Effect effect_of(std::string_view pointer) {
  for (const char* top :
       {"/name", "/description", "/output", "/camera", "/time/end", "/time/steps", "/$schema", "/hooke"}) {
    if (is_at_or_below(pointer, top)) return Effect::nothing;
  }
  for (const char* top : {"/particles", "/cloths", "/bodies", "/springs"}) {
    if (is_at_or_below(pointer, top)) return Effect::reset;
  }
  if (is_at_or_below(pointer, "/materials") || is_of_item(pointer, "/colliders", "motion")) return Effect::at_once;
  return Effect::rebuild;
}

SceneSource scene_source(const run::SceneArguments& scene, const run::DeviceArguments& device) {
  return {scene.file.string(), scene.file.parent_path(), scene.allow_outside,
          [device](const Scene& of, std::size_t particles) {
            std::vector<Finding> told_before;
            return run::make_backend(device, of, particles, told_before);
          }};
}

Expected<scene::LoadedScene> SceneDocument::load(const scene::Json& scene, bool with_particles) const {
  scene::LoadOptions options;
  options.allow_outside = source_.allow_outside;
  options.with_particles = with_particles;
  return scene::parse_scene(scene::pretty(scene), source_.name, source_.folder, options);
}

Expected<scene::LoadedScene> SceneDocument::load_rules(const scene::Json& scene, const Scene& present) const {
  scene::Json light = scene;
  std::vector<std::size_t> colliders, sinks;
  if (same_radii(*scene_, scene)) {
    colliders = replace_same_meshes(*scene_, light, "colliders", present.domain);
    sinks = replace_same_meshes(*scene_, light, "sinks", present.domain);
  }
  auto loaded = load(light, false);
  if (!loaded) return loaded;
  for (const std::size_t k : colliders) loaded->scene.colliders[k].shape = present.colliders[k].shape;
  for (const std::size_t k : sinks) loaded->scene.sinks[k].shape = present.sinks[k].shape;
  return loaded;
}

Expected<void> SceneDocument::rebuild(Simulation& simulation, Scene scene, SimulationState state,
                                      const Hand& hand) const {
  auto backend = source_.make_backend(scene, state.particles.size());
  if (!backend) return fail(std::move(backend).error());
  auto rebuilt = Simulation::resume(std::move(scene), std::move(state), std::move(*backend));
  if (!rebuilt) return fail(std::move(rebuilt).error());
  if (auto led = hand.reapply(*rebuilt); !led) return led;
  simulation = std::move(*rebuilt);
  return {};
}

Expected<void> SceneDocument::change(Simulation& simulation, const scene::Json& patch, const Hand& hand) {
  scene::Json next;
  std::set<std::string> pointers;
  try {
    next = scene_->patch(patch);
    pointers = changed_pointers(patch);
  } catch (const nlohmann::json::exception& thrown) {
    return bad_patch(thrown.what());
  }
  auto loaded = load_rules(next, simulation.scene());
  if (!loaded) return fail(std::move(loaded).error());
  Scene& changed = loaded->scene;
  if (material_names(changed) != material_names(simulation.scene())) {
    return bad_patch("materials can't be added, removed or renamed while particles are made of them");
  }
  const auto needs = [&](Effect effect) {
    return std::any_of(pointers.begin(), pointers.end(), [&](const auto& p) { return effect_of(p) == effect; });
  };
  Expected<void> done{};
  if (needs(Effect::rebuild)) {
    SimulationState state = simulation.state();
    // The clock goes on where it is, as nearly as whole steps allow.
    state.step = std::llround(simulation.time() / changed.time_step);
    changed.structure = simulation.scene().structure;
    // Of another integrator: velocity Verlet begins as particles that are added do, with no acceleration of a last
    // step.
    const std::size_t accelerated = changed.integrator == Integrator::velocity_verlet ? state.particles.size() : 0;
    state.particles.acceleration.resize(accelerated, {0, 0, 0});
    done = rebuild(simulation, std::move(changed), std::move(state), hand);
  } else if (needs(Effect::at_once)) {
    done = change_at_once(simulation, changed, pointers, hand);
  }
  if (done) scene_ = std::make_shared<const scene::Json>(std::move(next));
  return done;
}

Expected<void> SceneDocument::reset(Simulation& simulation) const {
  auto loaded = load(*scene_, true);
  if (!loaded) return fail(std::move(loaded).error());
  auto backend = source_.make_backend(loaded->scene, loaded->particles.size());
  if (!backend) return fail(std::move(backend).error());
  auto started = Simulation::create(std::move(loaded->scene), std::move(loaded->particles), std::move(*backend),
                                    {.allow_unstable_step = true});  // the panel says so
  if (!started) return fail(std::move(started).error());
  simulation = std::move(*started);
  return {};
}

Expected<void> SceneDocument::load_checkpoint(Simulation& simulation, const std::filesystem::path& file) const {
  auto loaded = load_rules(*scene_, simulation.scene());
  if (!loaded) return fail(std::move(loaded).error());
  auto checkpoint = io::read_checkpoint(file);
  if (!checkpoint) return fail(std::move(checkpoint).error());
  const io::RunInfo info = io::describe_run(loaded->scene, simulation.backend_info().precision);
  if (auto findings = io::check_resumable(checkpoint->info, info); !findings.empty()) {
    return fail(Error{Error::Kind::bad_input, std::move(findings)});
  }
  return rebuild(simulation, std::move(loaded->scene), std::move(checkpoint->state), Hand{});
}

Expected<void> SceneDocument::go_back(Simulation& simulation, SimulationState state,
                                      std::shared_ptr<const scene::Json> text, const Hand& hand) {
  auto loaded = load_rules(*text, simulation.scene());
  if (!loaded) return fail(std::move(loaded).error());
  if (auto rebuilt = rebuild(simulation, std::move(loaded->scene), std::move(state), hand); !rebuilt) return rebuilt;
  scene_ = std::move(text);
  return {};
}

scene::Json with_led_colliders(const scene::Json& scene, const std::vector<Hand::Led>& led) {
  scene::Json saved = scene;
  if (!saved.contains("colliders")) return saved;
  for (scene::Json& collider : saved["colliders"]) {
    for (const Hand::Led& one : led) {
      if (collider.value("name", "") != one.name) continue;
      const Vec3d &x = one.motion.position, &turn = one.motion.rotation;
      const double angle = std::sqrt(dot(turn, turn));
      scene::Json keyframe = {{"time", 0}, {"position", {x.x, x.y, x.z}}};
      if (angle > 0) {
        keyframe["rotation"] = {turn.x / angle, turn.y / angle, turn.z / angle, angle * 180 / std::numbers::pi};
      }
      scene::Json motion = {{"keyframes", scene::Json::array({keyframe})}};
      if (const auto& pivot = one.motion.pivot) motion["pivot"] = {pivot->x, pivot->y, pivot->z};
      collider["motion"] = std::move(motion);
    }
  }
  return saved;
}

}  // namespace hooke::view
