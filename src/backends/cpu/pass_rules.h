// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "hooke/backends/cpu/force_pass.h"
#include "hooke/core/scene.h"

namespace hooke {

/// A scene's rules as the force pass and the neighbour search want them.
template <class Real>
struct PassRules {
  std::vector<PairRow<Real>> pairs;  ///< materials squared
  std::vector<MaterialRow<Real>> materials;
  double largest_radius = 0, smallest_radius = 1;  ///< m
  double rounding = 0;  ///< m, of displacements across a periodic axis
  bool has_drag = false;
  ForcePass<Real> pass;  ///< all but the buffers

  void configure(const Scene& scene) {
    configure_materials(scene);
    configure_domain(scene.domain);
    pass.dt = real(scene.time_step);
    pass.gravity = vec_cast<Real>(scene.gravity);
    // A little below the limits, so that what double precision would find is always looked at.
    pass.speed_limit = real(0.999 * smallest_radius / scene.time_step);
  }

 private:
  static Real real(double value) { return static_cast<Real>(value); }

  void configure_materials(const Scene& scene) {
    const ContactTable table(scene.materials, scene.contacts);
    const std::size_t n = scene.materials.size();
    pairs.assign(n * n, PairRow<Real>{});
    materials.assign(n, MaterialRow<Real>{});
    largest_radius = 0;
    smallest_radius = n == 0 ? 1 : std::numeric_limits<double>::infinity();
    has_drag = false;
    for (std::size_t a = 0; a < n; ++a) {
      const Material& m = scene.materials[a];
      const ContactCoefficients<double>& wall = table.wall(a);
      materials[a] = {real(wall.stiffness),
                      real(wall.shear),
                      real(wall.damping),
                      real(m.radius),
                      Real(1) / real(m.mass),
                      real(m.drag),
                      {}};
      has_drag = has_drag || m.drag > 0;
      largest_radius = std::max(largest_radius, m.radius);
      smallest_radius = std::min(smallest_radius, m.radius);
      for (std::size_t b = 0; b < n; ++b) {
        const ContactCoefficients<double>& c = table.pair(a, b);
        pairs[a * n + b] = {
            real(c.stiffness), real(c.shear), real(c.damping), real(m.radius) + real(scene.materials[b].radius), {}};
      }
    }
    pass.pairs = pairs.data();
    pass.materials = materials.data();
    pass.material_count = n;
  }

  void configure_domain(const Domain& domain) {
    rounding = 0;
    pass.min = vec_cast<Real>(domain.min);
    pass.max = vec_cast<Real>(domain.max);
    pass.length = pass.max - pass.min;
    pass.periodic_kind = PeriodicKind::none;
    for (int axis = 0; axis < 3; ++axis) {
      const Boundary boundary = domain.boundary[static_cast<std::size_t>(axis)];
      pass.wall[axis] = boundary == Boundary::spring;
      pass.periodic[axis] = boundary == Boundary::periodic;
      pass.open_or_periodic[axis] = boundary != Boundary::spring;
      pass.images[axis] = 0;
      if (!pass.periodic[axis]) continue;
      const double length = component(pass.length, axis);
      pass.images[axis] = static_cast<int>(2 * largest_radius / length) + 1;
      const bool only_nearest = length > 4.001 * largest_radius;
      if (!only_nearest) pass.periodic_kind = PeriodicKind::images;
      if (pass.periodic_kind == PeriodicKind::none) pass.periodic_kind = PeriodicKind::nearest;
      rounding = std::max(rounding, 4 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * length);
    }
  }
};

}  // namespace hooke
