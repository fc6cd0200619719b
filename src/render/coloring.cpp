// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/coloring.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "hooke/base/assert.h"
#include "hooke/core/contacts.h"
#include "hooke/render/action.h"

namespace hooke::render {

namespace {

// Colours of materials without one of their own, by the material's index.
constexpr const char* kPalette[] = {"#2f7fd6", "#e4933a", "#4cb35a", "#c9485b",
                                    "#8e5bc0", "#5bb8c4", "#d6c12f", "#7d8794"};

double norm(const Vec3d& v) { return std::sqrt(dot(v, v)); }

// Height of the action's lowest corner, along `up`, m.
double floor_height(const Box3d& action, const Vec3d& up) {
  return dot(action.center(), up) - 0.5 * extent_along(action, up);
}

double fastest(const ParticleSet& particles) {
  double most = 0;
  for (const Vec3d& v : particles.velocity) most = std::max(most, norm(v));
  return most;
}

// Twice the pressure of the weight of all particles, spread over the floor, Pa.
double weight_pressure(const Scene& scene, const ParticleSet& first, const Box3d& action) {
  double mass = 0;
  for (const std::uint16_t material : first.material) mass += scene.materials[material].mass;
  const Vec3d size = action.max - action.min;
  const double height = extent_along(action, up_of(scene));
  const double floor_area = size.x * size.y * size.z / height;
  return 2 * mass * norm(scene.gravity) / floor_area;
}

double or_one(double value) { return value > 0 && std::isfinite(value) ? value : 1; }

}  // namespace

std::vector<Color> material_colors(const Scene& scene) {
  std::vector<Color> colors;
  for (const Material& material : scene.materials) {
    const char* own = material.color.c_str();
    colors.push_back(parse_color(*own ? own : kPalette[colors.size() % std::size(kPalette)]));
  }
  return colors;
}

ColorTitle title(ColorBy by) {
  switch (by) {
    case ColorBy::material:
      return {"", ""};
    case ColorBy::speed:
      return {"speed", "m/s"};
    case ColorBy::height:
      return {"height", "m"};
    case ColorBy::pressure:
      return {"pressure", "Pa"};
    case ColorBy::contacts:
      return {"contacts", ""};
    case ColorBy::id:
      return {"id", ""};
  }
  return {"", ""};
}

ColorScale default_scale(const Scene& scene, const ParticleSet& first, ColorBy by) {
  const Box3d action = action_box(scene, first);
  const double height = extent_along(action, up_of(scene));
  switch (by) {
    case ColorBy::material:
      return {by, 0, 1};
    case ColorBy::speed:
      return {by, 0, or_one(std::max(std::sqrt(2 * norm(scene.gravity) * height), fastest(first)))};
    case ColorBy::height:
      return {by, 0, or_one(height)};
    case ColorBy::pressure:
      return {by, 0, or_one(weight_pressure(scene, first, action))};
    case ColorBy::contacts:
      return {by, 0, 12};
    case ColorBy::id:
      return {by, 0, first.empty() ? 1 : or_one(static_cast<double>(first.id.back()))};
  }
  return {};
}

std::vector<double> color_values(const Scene& scene, const ParticleSet& particles, double time, const Box3d& action,
                                 ColorBy by) {
  HOOKE_ASSERT(are_particles_of(particles, scene), particles.size(), scene.materials.size());
  std::vector<double> values;
  if (by == ColorBy::material) return values;
  if (by == ColorBy::pressure) return contact_figures(scene, particles, {time, {}}).pressure;
  values.reserve(particles.size());
  if (by == ColorBy::contacts) {
    const auto figures = contact_figures(scene, particles, {time, {}});
    values.assign(figures.count.begin(), figures.count.end());
    return values;
  }
  const Vec3d up = up_of(scene);
  const double ground = floor_height(action, up);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    values.push_back(by == ColorBy::speed    ? norm(particles.velocity[i])
                     : by == ColorBy::height ? dot(particles.position[i], up) - ground
                                             : static_cast<double>(particles.id[i]));
  }
  return values;
}

}  // namespace hooke::render
