// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/frame.h"

#include <algorithm>
#include <cmath>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"
#include "hooke/render/aeration.h"
#include "hooke/render/cloth_meshes.h"
#include "hooke/render/collider_mesh.h"

namespace hooke {

namespace {

// Colours of materials without one of their own, by the material's index.
constexpr const char* kPalette[] = {"#2f7fd6", "#e4933a", "#4cb35a", "#c9485b",
                                    "#8e5bc0", "#5bb8c4", "#d6c12f", "#7d8794"};

std::vector<Color> material_colors(const Scene& scene) {
  std::vector<Color> colors;
  for (const Material& material : scene.materials) {
    const char* own = material.color.c_str();
    colors.push_back(parse_color(*own ? own : kPalette[colors.size() % std::size(kPalette)]));
  }
  return colors;
}

// At their own size, spheres at the water's surface would leave gaps that show the spheres below.
constexpr float kWaterRadius = 1.25f;

constexpr float kNight = 0.12f;  // of the day's light

// Water turns white where it is fast: clear up to 0.35 of foam_speed, the speed of a fall from the top, white from 0.9
// of it. It also turns white where it is mixed with air.
std::uint8_t foam_of(const Vec3d& velocity, double foam_speed, float air) {
  const double share = std::clamp((std::sqrt(dot(velocity, velocity)) / foam_speed - 0.35) / 0.55, 0.0, 1.0);
  const double white = 1 - (1 - share * share) * (1 - 0.8 * static_cast<double>(air));
  return static_cast<std::uint8_t>(1 + std::lround(254 * white));
}

// Empty where no material looks like water.
std::vector<float> water_aeration(const Scene& scene, const ParticleSet& particles) {
  const auto water = std::find_if(scene.materials.begin(), scene.materials.end(),
                                  [](const Material& m) { return m.look == MaterialLook::water; });
  if (water == scene.materials.end()) return {};
  return aeration(scene, particles, water->radius);
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

}  // namespace

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
  frame.camera = camera_at(scene, look.action, aspect, time);
  frame.origin = look.action.center();
  frame.camera.eye -= frame.origin;
  frame.camera.target -= frame.origin;
  frame.action = {look.action.min - frame.origin, look.action.max - frame.origin};
  frame.ground = ground_of(scene, frame.action, frame.up);
  frame.night = scene.attraction.has_value() && !frame.ground;
  frame.tank.min = scene.domain.min - frame.origin;
  frame.tank.max = scene.domain.max - frame.origin;
  for (std::size_t axis = 0; axis < 3; ++axis) frame.tank.walls[axis] = scene.domain.boundary[axis] == Boundary::spring;
  frame.meshes = collider_meshes(scene, time, frame.origin);
  if (look.scale.by != ColorBy::material) frame.scale = look.scale;
  const auto glows = [](const Material& m) { return m.look == MaterialLook::spark; };
  if (std::any_of(scene.materials.begin(), scene.materials.end(), glows)) frame.daylight = kNight;

  const std::vector<Color> colors = material_colors(scene);
  const std::vector<double> values = color_values(scene, particles, time, look.action, look.scale.by);
  const std::vector<float> air = values.empty() ? water_aeration(scene, particles) : std::vector<float>();
  frame.spheres.resize(particles.size());
  parallel_ranges(particles.size(), 4096, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Material& material = scene.materials[particles.material[i]];
      const Vec3f at = vec_cast<float>(particles.position[i] - frame.origin);
      Sphere& sphere = frame.spheres[i];
      sphere = {at.x, at.y,           at.z, static_cast<float>(material.radius), colors[particles.material[i]],
                0,    glows(material)};
      if (!values.empty()) {
        sphere.color = map_color((values[i] - look.scale.low) / (look.scale.high - look.scale.low));
      } else if (material.look == MaterialLook::water) {
        sphere.foam = foam_of(particles.velocity[i], look.foam_speed, air[i]);
        sphere.radius *= kWaterRadius;
      }
    }
  });
  if (scene.structure && !scene.structure->surfaces.empty()) {
    std::vector<char> covered(particles.size(), 0);
    const auto color_of = [&](std::size_t i) { return frame.spheres[i].color; };
    for (ShadedMesh& mesh : cloth_meshes(scene, particles, frame.origin, color_of, covered)) {
      frame.meshes.push_back(std::move(mesh));
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      if (covered[i] == 0) frame.spheres[kept++] = frame.spheres[i];
    }
    frame.spheres.resize(kept);
  }
  return frame;
}

}  // namespace hooke
