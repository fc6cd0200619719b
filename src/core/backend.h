// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/ledger.h"
#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke {

/// What a back end found wrong while it worked, with the particles concerned. Devices set it, the step
/// reads it once, Simulation words it.
struct Condition {
  enum class Kind {
    good,
    not_finite,
    grid_overflow,
    approach_too_fast,
    wall_approach_too_fast,
    collider_approach_too_fast
  };
  Kind kind = Kind::good;
  std::uint64_t particle = 0;  ///< id
  std::uint64_t partner = 0;   ///< id of the other one, for approach_too_fast; index of the collider
  double speed = 0;            ///< approach speed, m/s

  bool good() const { return kind == Kind::good; }

  /// Of two findings the one to report: the one of the lower particle id, so that it is always the same.
  static Condition first(const Condition& a, const Condition& b) {
    if (a.good()) return b;
    if (b.good()) return a;
    return b.particle < a.particle ? b : a;
  }
};

/// Figures of one instant. Sums are exact before one last rounding.
struct Measurements {
  std::uint64_t particles = 0;
  std::uint64_t contacts = 0;             ///< touching pairs of particles, each counted once
  std::uint64_t wall_contacts = 0;
  double kinetic_energy = 0;              ///< J
  double potential_energy = 0;            ///< -sum m g.x, J
  double elastic_energy = 0;              ///< in the springs between particles, cohesion included, J
  double wall_elastic_energy = 0;         ///< in the springs of walls, J
  std::uint64_t springs = 0;              ///< that hold
  double spring_energy = 0;               ///< in them, J
  double attraction_energy = 0;           ///< of all particles with each other, J, <= 0
  Vec3d momentum{0, 0, 0};                ///< kg m/s
  Vec3d centre_of_mass{0, 0, 0};          ///< m
  double momentum_scale = 0;              ///< sum of m |v|, kg m/s: what rounding of the momentum is relative to
  double max_speed = 0;                   ///< m/s
  double max_overlap_ratio = 0;           ///< deepest pair: overlap / (r_i + r_p)
  double mean_overlap_ratio = 0;          ///< mean over touching pairs
  Vec3d min{0, 0, 0}, max{0, 0, 0};       ///< box around the centres, m; 0 where there is none
  Vec3d wall_force{0, 0, 0};              ///< by walls on particles at this instant, N
  double collider_elastic_energy = 0;     ///< in the springs of colliders, J
  std::vector<ColliderLoad> colliders;    ///< what particles do to each at this instant
};

/// A particle that takes up space.
struct Occupant {
  Vec3d position;     ///< m
  double radius = 0;  ///< m
};

/// What a back end is and holds.
struct BackendInfo {
  std::string device;  ///< "cpu", "reference"
  std::string isa;     ///< instruction set of the force loop, e.g. "avx512"
  Precision precision = Precision::double_precision;
  int threads = 1;
};

/// Cost and quality of the neighbour search so far.
struct NeighbourStatistics {
  std::uint64_t rebuilds = 0;
  double slots_per_particle = 0;  ///< list entries read a particle and step, padding included
  std::uint64_t missed_contacts =
      0;  ///< contacts that a list lacked, a side each; counted only where that is asked for
};

/// Wall time by stage, s. Stages don't overlap; what of a step is in none of them is the rest.
struct StageTimes {
  double sort = 0;    ///< numbering the cells, sorting particles into them
  double list = 0;    ///< listing who may touch whom
  double motion = 0;  ///< following who moves too far for the list, and mending it
  double force = 0;   ///< the pass: contacts, walls, drag, gravity, the integrator, and the step's sums
  double drift = 0;   ///< velocity Verlet's first half

  double total() const { return sort + list + motion + force + drift; }

  StageTimes& operator+=(const StageTimes& b) {
    sort += b.sort;
    list += b.list;
    motion += b.motion;
    force += b.force;
    drift += b.drift;
    return *this;
  }
  friend StageTimes operator-(const StageTimes& a, const StageTimes& b) {
    return {a.sort - b.sort, a.list - b.list, a.motion - b.motion, a.force - b.force, a.drift - b.drift};
  }
};

/// Where particles live and step: reference (all pairs, the specification), cpu, and others to come. A back
/// end owns the particles' state in its own layout and order; everything that comes out is by id. Stages
/// are coarse: fusing inside one is its own affair. core/step.cpp says in which order they run. Scenes are valid, and
/// particles are those of the scene (are_particles_of).
class Backend {
 public:
  virtual ~Backend() = default;

  virtual BackendInfo info() const = 0;

  /// Takes the rules. Before particles, and again when a material changes; particles stay.
  virtual void configure(const Scene& scene) = 0;

  /// Breaks these springs of the scene's structure (indices, ascending), and no others. Before particles.
  virtual void break_springs(const std::vector<std::uint64_t>& broken) = 0;

  /// Indices of the broken ones, ascending.
  virtual std::vector<std::uint64_t> broken_springs() const = 0;

  /// Replaces all particles. Those with an id >= `first_new_id` have no acceleration of a last step yet:
  /// under velocity Verlet it is evaluated here, a(x, v), before anything moves. The neighbour list is stale after.
  /// `ledger` continues.
  virtual Condition upload(const ParticleSet& particles, std::uint64_t first_new_id, const Ledger& ledger) = 0;

  /// All particles, by id. `out.acceleration` is filled under velocity Verlet only.
  virtual void download(ParticleSet& out) const = 0;

  /// The scene's clock, s, for all that follows: what fields go by. Before upload, and before every step.
  virtual void set_time(double seconds) = 0;

  /// Moves the colliders of the scene, one pose each, for all that follows. Before upload, and before every step.
  virtual void place_colliders(std::span<const ColliderPose> poses) = 0;

  /// First half of velocity Verlet: v += dt/2 a; x += dt v; then the domain's boundaries (periodic
  /// coordinates wrap, particles outside open faces are removed).
  virtual void half_kick_and_drift() = 0;

  /// Whether a pair not on the neighbour list could touch now. Always right; never depends on an old speed.
  virtual bool neighbours_stale() const = 0;

  /// Sorts particles into cells and lists who may touch whom until the next time this is stale.
  virtual Condition build_neighbours() = 0;

  /// The heart: all forces, and in the same pass what the integrator does with them. Springs that are stretched too
  /// far when it begins break when it ends.
  ///   symplectic Euler   v += dt a; x += dt v; then the domain's boundaries
  ///   velocity Verlet    v += dt/2 a
  virtual Condition apply_forces() = 0;

  // What comes and goes at the end of a step. Whoever is taken away is booked with the momentum and energy that it has;
  // under velocity Verlet with those after the half kick to come, whose work the ledger has booked ahead.

  /// Takes away the particles whose centres are inside of the scene's sinks.
  virtual void sink_particles() = 0;

  /// Takes away the particles of these ids, whose life has ended. `was_there` tells of each whether it still was.
  virtual void expire(std::span<const std::uint64_t> ids, std::vector<std::uint8_t>& was_there) = 0;

  /// Adds particles, their ids above all that there ever were, with no acceleration of a last step: under velocity
  /// Verlet their first half kick is none.
  virtual void give_birth(const ParticleSet& newborn) = 0;

  /// Appends the particles that touch others (Material::interacts) and whose centres are in a box, in any order.
  virtual void find_inside(const ShapeBounds& box, std::vector<Occupant>& out) const = 0;

  virtual std::uint64_t particle_count() const = 0;
  virtual const Ledger& ledger() const = 0;

  /// Sum over the particles of a mix of id and of the bits of position and velocity, modulo 2^64: in the
  /// precision of this back end, in no order.
  virtual std::uint64_t particles_hash() const = 0;

  /// Figures of this instant; makes the neighbour list fresh first if it must.
  virtual Expected<Measurements> measure() = 0;

  virtual NeighbourStatistics neighbour_statistics() const = 0;

  /// Of everything so far, also of what was not a step.
  virtual StageTimes stage_times() const = 0;
};

}  // namespace hooke
