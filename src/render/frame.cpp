// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/frame.h"

#include <algorithm>
#include <cmath>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"
#include "hooke/render/action.h"
#include "hooke/render/cloth_meshes.h"
#include "hooke/render/collider_mesh.h"
#include "hooke/render/skin_bodies.h"
#include "hooke/render/spray.h"
#include "hooke/render/spring_meshes.h"
#include "hooke/render/water_mixing.h"

namespace hooke::render {

namespace {

constexpr float kNight = 0.12f;  // of the day's light

float smoothstep(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

// Radius of the sphere that draws a particle of water, over its own. At their own size, spheres at the surface of a
// pool would leave gaps that show the spheres below, and those of a sheet still more; a drop of its own is no larger
// than it is.
float water_radius(float filled) {
  const float sheet = smoothstep(0.06f, 0.2f, filled) * (1 - smoothstep(0.35f, 0.6f, filled));
  return 0.85f + 0.4f * smoothstep(0.02f, 0.15f, filled) + 0.3f * sheet;
}

// How much larger the spheres of a smooth skin are, to fill the steps of its lattice; its outline is as much smaller.
constexpr float kSkinFilling = 1.25f;

// How much smaller foam is drawn than the water it comes from: froth is fine.
constexpr float kFroth = 0.35f;

// How far a particle of water is a drop of its own, from 0 to 1.
float looseness(float filled) { return 1 - smoothstep(0.06f, 0.25f, filled); }

// How far a loose particle is one of the many of spray, from 0 to 1: alone in its space it fills 0.017 of it.
float denseness(float filled) { return smoothstep(0.017f, 0.07f, filled); }

// Between the walls.
void keep_inside(const Domain& domain, const Tank& tank, Sphere& drop) {
  float* const place[] = {&drop.x, &drop.y, &drop.z};
  for (int axis = 0; axis < 3; ++axis) {
    if (domain.boundary[static_cast<std::size_t>(axis)] != Boundary::spring) continue;
    const auto low = static_cast<float>(component(tank.min, axis)) + drop.radius;
    const auto high = static_cast<float>(component(tank.max, axis)) - drop.radius;
    float& x = *place[axis];
    x = std::min(std::max(x, low), std::max(low, high));
  }
}

// Water turns white where it churns, which mixes it with air: clear up to 0.07 of the speed of a fall from the top,
// white from 0.3 of it. Water that falls together and drops that fly alone stay clear.
std::uint8_t foam_of(const Material& material, const WaterMixing& mixing, double foam_speed) {
  const float churns = smoothstep(0.07f, 0.3f, mixing.churn / static_cast<float>(foam_speed));
  const float together = 1 - looseness(mixing.filled);
  const double white = std::clamp(material.foam * static_cast<double>(churns * together), 0.0, 1.0);
  return static_cast<std::uint8_t>(1 + std::lround(254 * white));
}

// Empty where no material looks like water.
std::vector<WaterMixing> mixing_of(const Scene& scene, const ParticleSet& particles, double foam_speed) {
  const auto water = std::find_if(scene.materials.begin(), scene.materials.end(),
                                  [](const Material& m) { return m.look == MaterialLook::water; });
  if (water == scene.materials.end()) return {};
  return water_mixing(scene, particles, water->radius, foam_speed);
}

std::optional<double> ground_of(const Scene& scene, const Box3d& action, const Vec3d& up) {
  if (scene.gravity == Vec3d{0, 0, 0}) return {};
  double lowest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double upward = component(up, axis);
    lowest += upward * component(upward > 0 ? action.min : action.max, axis);
  }
  return lowest;
}

// What the scene says of its pictures.
void apply(const ScenePicture& picture, Frame& frame) {
  if (!picture.box) frame.tank.walls = {};
  if (!picture.ground) frame.ground.reset();
  frame.ground_lines = picture.ground_lines;
  if (!picture.ground_color.empty()) frame.ground_color = parse_color(picture.ground_color.c_str());
  if (picture.background.starts_with('#')) frame.background = parse_color(picture.background.c_str());
  frame.bright_sky = picture.background == "sky";
  if (picture.sun) frame.to_sun = (1 / std::sqrt(dot(*picture.sun, *picture.sun))) * *picture.sun;
  frame.sunlight = static_cast<float>(picture.sunlight);
  frame.skylight = static_cast<float>(picture.skylight);
}

// Between rods, particles are small balls, whatever their look.
void shrink_joints(const Scene& scene, const ParticleSet& particles, Frame& frame) {
  constexpr float kJoint = 0.6f;  // of the particle's radius
  const SpringSet& springs = scene.structure->springs;
  for (const std::vector<std::uint64_t>* ends : {&springs.a, &springs.b}) {
    for (const std::uint64_t id : *ends) {
      const std::size_t i = particles.find(id);
      if (i == particles.size()) continue;
      frame.spheres[i].skin = false;
      frame.spheres[i].body = 0;
      frame.spheres[i].radius = kJoint * static_cast<float>(scene.materials[particles.material[i]].radius);
    }
  }
}

// Surfaces take the place of their particles; springs come as the scene wants them. Spheres are those of all particles.
void add_structure(const Scene& scene, const ParticleSet& particles, Frame& frame) {
  std::vector<char> covered(particles.size(), 0);
  const auto color_of = [&](std::size_t i) { return frame.spheres[i].color; };
  const auto add = [&frame](std::vector<ShadedMesh> meshes) {
    for (ShadedMesh& mesh : meshes) frame.meshes.push_back(std::move(mesh));
  };
  add(cloth_meshes(scene, particles, frame.origin, color_of, covered));
  add(spring_meshes(scene, particles, frame.origin, color_of, covered));
  if (scene.picture.springs != SpringLook::none) shrink_joints(scene, particles, frame);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (covered[i] == 0) frame.spheres[kept++] = frame.spheres[i];
  }
  frame.spheres.resize(kept);
}

}  // namespace

// Spheres of a skin's lattice leave no gaps.
float drawn_radius(const Material& material) {
  constexpr float kSkinRadius = 1.4f;  // over the particle's own
  const auto own = static_cast<float>(material.radius);
  return material.look == MaterialLook::skin ? kSkinRadius * own : own;
}

float typical_radius(const Frame& frame, SphereKind kind) {
  HOOKE_ASSERT(frame.fine_drops <= frame.spheres.size(), frame.fine_drops, frame.spheres.size());
  constexpr std::size_t kLooks = 256;
  std::vector<float> radii;
  const std::size_t count = frame.spheres.size() - frame.fine_drops;
  for (const std::size_t step : {std::max<std::size_t>(1, count / kLooks), std::size_t{1}}) {
    for (std::size_t i = step / 2; i < count; i += step) {
      if (kind_of(frame.spheres[i]) == kind) radii.push_back(frame.spheres[i].radius);
      if (step == 1 && radii.size() == kLooks) break;
    }
    if (!radii.empty()) break;
  }
  if (radii.empty()) return 1;
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

Look make_look(const Scene& scene, const ParticleSet& first, ColorBy by,
               const std::optional<std::array<double, 2>>& range) {
  Look look{action_box(scene, first), default_scale(scene, first, by), 0};
  look.foam_speed = default_scale(scene, first, ColorBy::speed).high;
  if (range) {
    HOOKE_ASSERT((*range)[1] > (*range)[0], (*range)[0], (*range)[1]);
    look.scale.low = (*range)[0];
    look.scale.high = (*range)[1];
  }
  return look;
}

Frame make_frame(const Scene& scene, const ParticleSet& particles, double time, const Look& look, double aspect) {
  HOOKE_ASSERT(are_particles_of(particles, scene), particles.size(), scene.materials.size());
  HOOKE_ASSERT(aspect > 0, aspect);
  HOOKE_ASSERT(look.scale.high > look.scale.low, look.scale.low, look.scale.high);
  Frame frame;
  frame.up = up_of(scene);
  const LevelAxes level = level_axes(look.action, frame.up);
  frame.across = level.across;
  frame.along = level.front;
  frame.to_sun = direction_to_sun(look.action, frame.up);
  frame.camera = camera_at(scene, look.action, aspect, time, followed_point(scene, particles, time));
  frame.origin = look.action.center();
  frame.camera.eye -= frame.origin;
  frame.camera.target -= frame.origin;
  frame.action = {look.action.min - frame.origin, look.action.max - frame.origin};
  frame.ground = ground_of(scene, frame.action, frame.up);
  frame.night = scene.attraction.has_value() && !frame.ground;
  frame.tank.min = scene.domain.min - frame.origin;
  frame.tank.max = scene.domain.max - frame.origin;
  for (std::size_t axis = 0; axis < 3; ++axis) frame.tank.walls[axis] = scene.domain.boundary[axis] == Boundary::spring;
  apply(scene.picture, frame);
  frame.meshes = collider_meshes(scene, time, frame.origin);
  if (look.scale.by != ColorBy::material) frame.scale = look.scale;
  const auto glows = [](const Material& m) { return m.look == MaterialLook::spark; };
  if (std::any_of(scene.materials.begin(), scene.materials.end(), glows)) frame.daylight = kNight;

  const std::vector<Color> colors = material_colors(scene);
  const std::vector<double> values = color_values(scene, particles, time, look.action, look.scale.by);
  const std::vector<WaterMixing> mixing =
      values.empty() ? mixing_of(scene, particles, look.foam_speed) : std::vector<WaterMixing>();
  const bool skin = std::any_of(scene.materials.begin(), scene.materials.end(),
                                [](const Material& m) { return m.look == MaterialLook::skin; });
  const std::vector<std::uint8_t> body = skin ? skin_bodies(scene, particles) : std::vector<std::uint8_t>();
  frame.spheres.resize(particles.size());
  parallel_ranges(particles.size(), 4096, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Material& material = scene.materials[particles.material[i]];
      const Vec3f at = vec_cast<float>(particles.position[i] - frame.origin);
      Sphere& sphere = frame.spheres[i];
      sphere = {at.x, at.y, at.z, drawn_radius(material), colors[particles.material[i]], 0};
      sphere.glows = glows(material);
      sphere.roughness = static_cast<std::uint8_t>(std::lround(255 * material.roughness));
      sphere.skin = material.look == MaterialLook::skin;
      if (sphere.skin) {
        sphere.body = body[i];
        sphere.radius *= kSkinFilling;
      }
      if (!values.empty()) {
        sphere.color = map_color((values[i] - look.scale.low) / (look.scale.high - look.scale.low));
      } else if (material.look == MaterialLook::water) {
        sphere.foam = foam_of(material, mixing[i], look.foam_speed);
        sphere.radius *= water_radius(mixing[i].filled) * (1 - kFroth * static_cast<float>(sphere.foam - 1) / 254);
        sphere.roughness = static_cast<std::uint8_t>(std::lround(255 * looseness(mixing[i].filled)));
      }
    }
  });
  std::vector<Sphere> fine;
  for (std::size_t i = 0; i < mixing.size(); ++i) {
    Sphere& sphere = frame.spheres[i];
    if (kind_of(sphere) != SphereKind::water) continue;
    const float filled = mixing[i].filled, radius = drawn_radius(scene.materials[particles.material[i]]);
    make_spray(sphere, particles.id[i], radius, looseness(filled), denseness(filled), fine);
  }
  for (Sphere& drop : fine) keep_inside(scene.domain, frame.tank, drop);
  if (scene.structure) add_structure(scene, particles, frame);
  frame.spheres.insert(frame.spheres.end(), fine.begin(), fine.end());
  frame.fine_drops = fine.size();
  return frame;
}

}  // namespace hooke::render
