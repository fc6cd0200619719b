// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "hooke/base/box3.h"
#include "hooke/base/vec3.h"
#include "hooke/physics/collider.h"

namespace hooke {

// A scene's rules as loops read them: plain numbers and pointers, on a host or a device. This header and what it
// includes are compiled with the flags of every instruction set, so nothing in them may emit an inline function that
// the linker could share.

/// The law of one pair of materials, of a material and walls, or of a material and a collider: eight numbers, laid out
/// like a particle record so that a pack of rows loads like a pack of particles.
template <class Real>
struct alignas(8 * sizeof(Real)) PairRow {
  Real stiffness, shear, damping;           // N/m, N s/m, N s/m
  Real contact_distance;                               // r_i + r_p, or r_i, m
  Real friction, tension, cohesion, range;  // of surfaces: 1, N, N, m
};

/// What particles of one material have in common; zeros for a material that no particle has.
template <class Real>
struct alignas(4 * sizeof(Real)) MaterialRow {
  Real inverse_mass;  // 1/kg
  Real drag;          // kg/s
  Real mass;          // kg
  Real radius;        // m
};

/// Which periodic images of a particle can touch another.
enum class PeriodicKind {
  none,
  nearest,  // every periodic axis is at least two largest diameters long: only the nearest image
  images,   // shorter: all images up to a number
};

/// A scene's rules for the forces on its particles and for their motion. Points into the Rules that made it.
template <class Real>
struct RulesView {
  std::size_t material_count = 1;                // materials that particles may have
  const PairRow<Real>* pairs = nullptr;          // material_count squared
  const PairRow<Real>* wall_pairs = nullptr;     // material_count
  const PairRow<Real>* collider_pairs = nullptr;  // a row of material_count per collider of the scene
  const MaterialRow<Real>* materials = nullptr;  // material_count
  bool linear = true;                            // surfaces do nothing, here and with colliders
  bool has_drag = false;                         // some material has drag
  Real dt{};                                     // s
  Vec3<Real> gravity{};                          // m/s^2
  Real speed_limit{};                            // m/s: contacts that approach or part faster are checked closely
  Vec3<Real> min{}, max{}, length{};             // domain, m
  Vec3<Real> period{};                           // length along periodic axes, else 0
  bool wall[3]{};                                // spring walls across this axis
  bool periodic[3]{};
  bool open_or_periodic[3]{};
  PeriodicKind periodic_kind = PeriodicKind::none;
  int images[3]{};  // 0, or periodic: no image further than -n to n can touch
};

/// Where a scene's colliders are at one instant, each with its images across periodic faces.
template <class Real>
struct CollidersView {
  const PlacedCollider<Real>* placed = nullptr;  // in the scene's order, image by image
  const std::uint32_t* index = nullptr;          // each one's index in the scene
  std::size_t count = 0;
  Box3<Real> near;                          // m: outside of it no particle touches one
};

}  // namespace hooke
