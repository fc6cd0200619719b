// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/physics/contact.h"
#include "hooke/physics/integrate.h"
#include "hooke/physics/wall.h"

namespace hooke::bench {

/// The plain way to step spheres, done properly, for Hooke to be measured against. Each step sorts the particles into
/// cells of one diameter by counting, so that neighbours lie close in memory; then each particle is tested against
/// every particle in the 27 cells around it. The law, walls, gravity and integrator (symplectic Euler) are Hooke's,
/// from the same headers, for scenes of one material in a box of spring walls. Sums have no defined order, so the bits
/// are not Hooke's. Runs on the threads of the task arena that it is called in.
template <class Real>
class CellLoop {
 public:
  struct Particle {
    Vec3<Real> x;  ///< m
    Vec3<Real> v;  ///< m/s
    std::uint32_t index;  ///< in the set that the particle came from
  };

  CellLoop(const Scene& scene, const ParticleSet& particles) : dt_(static_cast<Real>(scene.time_step)) {
    const Material& m = scene.materials.at(0);
    radius_ = static_cast<Real>(m.radius);
    inverse_mass_ = Real(1) / static_cast<Real>(m.mass);
    law_ = {static_cast<Real>(m.contact.stiffness), static_cast<Real>(m.contact.shear),
            static_cast<Real>(m.contact.damping)};
    gravity_ = vec_cast<Real>(scene.gravity);
    min_ = vec_cast<Real>(scene.domain.min);
    max_ = vec_cast<Real>(scene.domain.max);
    for (int axis = 0; axis < 3; ++axis) {
      cells_[axis] = std::max(1, static_cast<int>(scene.domain.length(axis) / (2 * m.radius)));
      per_metre_[axis] = static_cast<Real>(cells_[axis] / scene.domain.length(axis));
    }
    const std::size_t cells =
        static_cast<std::size_t>(cells_[0]) * static_cast<std::size_t>(cells_[1]) * static_cast<std::size_t>(cells_[2]);
    first_.resize(cells + 1);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      now_.push_back({vec_cast<Real>(particles.position[i]), vec_cast<Real>(particles.velocity[i]),
                      static_cast<std::uint32_t>(i)});
    }
    sorted_.resize(now_.size());
    cell_.resize(now_.size());
  }

  void step() {
    sort();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sorted_.size(), 1024), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const Vec3<Real> a = inverse_mass_ * force_on(sorted_[i]) + gravity_;
        const Vec3<Real> v = kick(sorted_[i].v, a, dt_);
        now_[i] = {drift(sorted_[i].x, v, dt_), v, sorted_[i].index};
      }
    });
  }

  /// In no order.
  const std::vector<Particle>& particles() const { return now_; }

 private:
  // The cell of x along `axis`; a point outside the box belongs to the cell at the box's edge.
  int cell_along(Real x, int axis) const {
    const int cell = static_cast<int>((x - component(min_, axis)) * per_metre_[axis]);
    return std::clamp(cell, 0, cells_[axis] - 1);
  }
  std::size_t number_of(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(cells_[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(cells_[0]) +
           static_cast<std::size_t>(x);
  }

  void sort() {
    std::fill(first_.begin(), first_.end(), 0U);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, now_.size(), 4096), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const Vec3<Real>& x = now_[i].x;
        cell_[i] = static_cast<std::uint32_t>(number_of(cell_along(x.x, 0), cell_along(x.y, 1), cell_along(x.z, 2)));
      }
    });
    for (const std::uint32_t cell : cell_) ++first_[cell];
    std::uint32_t end = 0;
    for (std::uint32_t& first : first_) first = end += first;
    for (std::size_t i = now_.size(); i-- > 0;) sorted_[--first_[cell_[i]]] = now_[i];
  }

  Vec3<Real> force_on(const Particle& own) const {
    Vec3<Real> force{Real(0), Real(0), Real(0)};
    const int x = cell_along(own.x.x, 0), y = cell_along(own.x.y, 1), z = cell_along(own.x.z, 2);
    for (int cz = std::max(z - 1, 0); cz <= std::min(z + 1, cells_[2] - 1); ++cz) {
      for (int cy = std::max(y - 1, 0); cy <= std::min(y + 1, cells_[1] - 1); ++cy) {
        for (int cx = std::max(x - 1, 0); cx <= std::min(x + 1, cells_[0] - 1); ++cx) {
          const std::size_t cell = number_of(cx, cy, cz);
          for (std::uint32_t p = first_[cell]; p < first_[cell + 1]; ++p) add_contact(own, sorted_[p], force);
        }
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      const Real at = component(own.x, axis);
      add_wall(own, wall_normal(axis, Real(1)), lower_wall_overlap(at, component(min_, axis), radius_), force);
      add_wall(own, wall_normal(axis, Real(-1)), upper_wall_overlap(at, component(max_, axis), radius_), force);
    }
    return force;
  }

  void add_contact(const Particle& own, const Particle& other, Vec3<Real>& force) const {
    const Vec3<Real> x_ip = own.x - other.x;
    const Real distance2 = dot(x_ip, x_ip);
    if (distance2 >= Real(4) * radius_ * radius_ || other.index == own.index) return;
    const Real distance = std::sqrt(distance2);
    const Real tie = own.index > other.index ? Real(1) : Real(-1);
    const Vec3<Real> normal = contact_normal(x_ip, distance, tie);
    force += contact_forces(Real(2) * radius_ - distance, normal, other.v - own.v, law_).total();
  }

  void add_wall(const Particle& own, const Vec3<Real>& normal, Real overlap, Vec3<Real>& force) const {
    if (overlap > 0) force += contact_forces(overlap, normal, -own.v, law_).total();
  }

  Real dt_, radius_{}, inverse_mass_{};
  ContactCoefficients<Real> law_;
  Vec3<Real> gravity_{}, min_{}, max_{};
  int cells_[3]{};
  Real per_metre_[3]{};  // cells a metre, along each axis
  std::vector<Particle> now_, sorted_;
  std::vector<std::uint32_t> cell_;   // cell of each particle of now_
  std::vector<std::uint32_t> first_;  // first particle of each cell in sorted_, and the end
};

}  // namespace hooke::bench
