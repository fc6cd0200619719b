// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "hooke/backends/cpu/particle_record.h"
#include "hooke/base/vec3.h"
#include "hooke/neighbours/group_anchor.h"
#include "hooke/neighbours/window_search.h"
#include "hooke/physics/collider.h"

namespace hooke {

// The force pass as seen from outside: plain data in, plain data out. This header and what it includes are compiled
// with the flags of every instruction set, so nothing in them may emit an inline function that the linker could share.

/// The law of one pair of materials, of a material and walls, or of a material and a collider: eight numbers, laid out
/// like a particle record so that a pack of rows loads like a pack of particles.
template <class Real>
struct alignas(8 * sizeof(Real)) PairRow {
  Real stiffness, shear, damping;           // N/m, N s/m, N s/m
  Real reach;                               // r_i + r_p, or r_i, m
  Real friction, tension, cohesion, range;  // of surfaces: 1, N, N, m
};
template <class Real>
struct alignas(4 * sizeof(Real)) MaterialRow {
  Real inverse_mass;  // 1/kg
  Real drag;          // kg/s
  Real mass;          // kg
  Real radius;        // m
};

/// The same numbers a column each, where materials are so few that a register or two hold a column.
template <class Real>
struct FewMaterials {
  static constexpr std::size_t kPairs = 16;
  alignas(64) Real stiffness[kPairs], shear[kPairs], damping[kPairs], reach[kPairs];       // by pair
  alignas(64) Real friction[kPairs], tension[kPairs], cohesion[kPairs], range[kPairs];     // likewise
  alignas(64) Real inverse_mass[kPairs], drag[kPairs], mass[kPairs];                  // by material
};

enum class PeriodicKind {
  none,
  nearest,  // every periodic axis is at least two largest diameters long: only the nearest image can touch
  images,   // shorter: look at all images
};

/// What every group of a pass needs.
template <class Real>
struct ForcePass {
  const ParticleRecord<Real>* in = nullptr;   // state before
  ParticleRecord<Real>* out = nullptr;        // state after
  Vec3<Real>* acceleration = nullptr;         // velocity Verlet: where a goes; null under symplectic Euler
  const Vec3<Real>* applied = nullptr;        // forces of springs and the like, N; null where there are none
  Columns<Real> listed_at;                    // positions when the list was built, m
  const PairRow<Real>* pairs = nullptr;       // material_count squared
  const PairRow<Real>* wall_pairs = nullptr;  // material_count
  bool linear = true;                         // surfaces do nothing, here and with colliders
  const MaterialRow<Real>* materials = nullptr;
  const FewMaterials<Real>* few = nullptr;    // null where there are more
  std::size_t material_count = 1;
  Real dt{};                                  // s
  Vec3<Real> gravity{};                       // m/s^2
  Vec3<Real> min{}, max{}, length{};          // domain, m
  bool has_drag = false;                      // some material's is not 0
  bool wall[3]{};                             // spring walls across this axis
  Vec3<Real> clear_of_walls_from{}, clear_of_walls_to{};  // m: the largest particles between these touch no wall
  const PlacedCollider<Real>* colliders = nullptr;        // where they are in this pass, images included
  const std::uint32_t* collider_of = nullptr;             // of each, which of the scene's it is
  std::size_t collider_count = 0;
  const PairRow<Real>* collider_pairs = nullptr;          // a row of material_count a collider of the scene
  Vec3<Real> near_colliders_from{}, near_colliders_to{};  // m: outside of this box none touches a collider
  bool open_or_periodic[3]{};
  bool periodic[3]{};
  int images[3]{};                            // PeriodicKind::images: -n to n are looked at
  PeriodicKind periodic_kind = PeriodicKind::none;
  Real speed_limit{};                         // m/s: contacts that approach faster are looked at closely
  const GroupAnchor<Real>* anchors = nullptr; // a window each: where its particles are expected
  const std::uint16_t* held = nullptr;        // a bit a particle, one entry a group: held still; null where none is
  Real next_step{};                           // steps of the anchors, this pass's drift included
};

/// What a group has to say beside its new state.
enum GroupNote : unsigned char {
  kLeftDomain = 1,      // a particle is outside an open or periodic face, or at no number
  kApproachTooFast = 2, // perhaps: look closely
};

/// What a pass sums over its particles: powers by cause, W, at twice the mean velocity of the kick; the same of the
/// kick to come, under velocity Verlet; forces, N. `count` is how many there are of each.
struct PassSum {
  enum Power {
    contact_spring,
    contact_shear,
    contact_damping,
    contact_friction,
    drag,
    gravity,
    wall,
    collider,
    powers
  };
  static constexpr int next = powers;  // and on: powers of the kick to come
  static constexpr int wall_force = 2 * powers, collider_force = wall_force + 3, drag_force = wall_force + 6;
  static constexpr int count = drag_force + 3;
};

/// Numbers whose exact sum stands for that of many more.
struct ExactParts {
  static constexpr std::size_t kMost = 1024;
  std::size_t count;
  double values[kMost];
};

/// The part of a pass that one thread does at a time: consecutive groups of 16 particles, their rows of the neighbour
/// list, and where they report.
template <class Real>
struct SegmentWork {
  std::size_t first = 0;                     // first particle
  std::size_t group_count = 0;
  bool alone = false;                        // no particle touches others: there are no rows, and none is ever far
  const std::uint32_t* rows = nullptr;
  const std::uint32_t* first_row = nullptr;  // group_count + 1
  unsigned char* notes = nullptr;            // GroupNote bits, one entry a group
  std::uint16_t* far = nullptr;  // a bit a particle, one entry a group: further from its anchor than allowed
  ExactParts* sums = nullptr;                // PassSum::count of them, which are added to
};

template <class Real>
using ForcePassFunction = void (*)(const ForcePass<Real>&, const SegmentWork<Real>&);

/// The entries of the neighbour list are offsets of records in units of 8 bytes.
template <class Real>
constexpr std::uint32_t record_offset(std::uint32_t index) {
  return index * static_cast<std::uint32_t>(sizeof(ParticleRecord<Real>) / 8);
}

#define HOOKE_DECLARE_FORCE_PASS(isa)                                              \
  namespace isa {                                                                  \
  void force_pass(const ForcePass<float>& pass, const SegmentWork<float>& work);   \
  void force_pass(const ForcePass<double>& pass, const SegmentWork<double>& work); \
  }
HOOKE_DECLARE_FORCE_PASS(portable)
HOOKE_DECLARE_FORCE_PASS(avx2)
HOOKE_DECLARE_FORCE_PASS(avx512)
#undef HOOKE_DECLARE_FORCE_PASS

}  // namespace hooke
