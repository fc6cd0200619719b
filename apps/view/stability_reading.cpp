// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "stability_reading.h"

#include <cmath>
#include <numbers>

#include "hooke/physics/stability.h"

namespace hooke::view {
namespace {

constexpr double kSafe = 0.8;

// The largest number of two digits that is not above `value`, > 0.
double rounded_down(double value) {
  if (!std::isfinite(value)) return value;
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return std::floor(value / unit * (1 + 1e-12)) * unit;
}

MaterialReading reading_of(const Material& m, double time_step) {
  MaterialReading reading{m.name, 0, 1, INFINITY};
  const double m_eff = effective_mass(m.mass, m.mass), k = m.contact.stiffness;
  if (!(k > 0)) return reading;
  const double ratio = damping_ratio(m.contact.damping, k, m_eff), omega = std::sqrt(k / m_eff);
  reading.damping_ratio = ratio;
  if (ratio >= 1) {
    reading.restitution = 0;
    return reading;
  }
  const double root = std::sqrt(1 - ratio * ratio);
  reading.restitution = std::exp(-std::numbers::pi * ratio / root);
  reading.contact_steps = std::numbers::pi / (omega * root) / time_step;
  return reading;
}

}  // namespace

StabilityReading read_stability(const Scene& scene, const ParticleSet& particles) {
  StabilityReading reading;
  reading.stable = stable_step(scene, particles);
  reading.safe_step = rounded_down(kSafe * reading.stable.seconds);
  for (const Material& m : scene.materials) {
    if (m.is_of_particles()) reading.materials.push_back(reading_of(m, scene.time_step));
  }
  return reading;
}

}  // namespace hooke::view
