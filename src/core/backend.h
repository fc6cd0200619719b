// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/condition.h"
#include "hooke/core/measurements.h"
#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/core/sums.h"

namespace hooke {

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
  double slots_per_particle = 0;  ///< list entries read per particle and step, padding included
  std::uint64_t missed_contacts =
      0;  ///< contacts that a list lacked, counted from each side; counted only where that is asked for
};

/// Wall time by stage, s. Stages don't overlap; some time of a step is in none of them.
struct StageTimes {
  double sort = 0;    ///< numbering the cells, sorting particles into them
  double list = 0;    ///< listing the pairs that may touch
  double motion = 0;  ///< finding particles that move too far for the list, and patching it
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

/// When forces are evaluated, and where the colliders of the scene are then.
struct Instant {
  double time = 0;                      ///< the scene's clock, s, on which fields depend
  std::span<const ColliderPose> poses;  ///< one per collider of the scene, in its order
  bool moved = false;  ///< whether a step has brought the particles to their places, with the velocities that they have
};

/// A particle by its id.
struct ParticleAt {
  std::uint64_t id = 0;
  std::size_t material = 0;  ///< index into Scene::materials
  Vec3d position{0, 0, 0};  ///< m
  Vec3d velocity{0, 0, 0};  ///< m/s
};

/// What particles that were removed by their ids took along, and which of them were there.
struct Removal {
  RemovalSums sums;
  std::vector<std::uint8_t> was_there;  ///< 0 or 1, one per id
};

/// A back end throws it where its device has failed: what it holds is lost. Simulation::step() returns it as an error.
class DeviceFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class SharedParticles;

/// Holds and steps particles: reference (all pairs, the specification), cpu, and others to come. A back end is three
/// things: a store of particles in its own layout and order, which is read by id; the stages of a step, which are
/// coarse, so that a back end can fuse the work inside a stage; and an observer of the state. core/step.cpp runs the
/// stages in their order and keeps the ledger: a back end reports what its own particles did and keeps no totals.
/// Scenes must be valid, and particles must be the scene's (are_particles_of).
class Backend {
 public:
  virtual ~Backend() = default;

  virtual BackendInfo info() const = 0;

  // The store -------------------------------------------------------------------------------------------------------

  /// Takes the rules. Called before assign(), and again, before another assign(), when a material changes.
  virtual void configure(const Scene& scene) = 0;

  /// Breaks these springs of the scene's structure (indices, ascending), and no others. Called before assign().
  virtual void break_springs(const std::vector<std::uint64_t>& broken) = 0;

  /// Indices of the broken springs, ascending.
  virtual std::vector<std::uint64_t> broken_springs() const = 0;

  /// Replaces all particles. The neighbour list is stale after.
  virtual void assign(const ParticleSet& particles) = 0;

  /// Copies all particles, in parallel, into columns of particle_count() entries: in double without loss, in float
  /// rounded where the back end computes in double.
  virtual void download(const ParticleColumns<double>& out) const = 0;
  virtual void download(const ParticleColumns<float>& out) const = 0;

  virtual std::uint64_t particle_count() const = 0;

  /// The particle of an id as it is stored; nothing where there is none.
  virtual std::optional<ParticleAt> find(std::uint64_t id) const = 0;

  /// Gives existing particles another position and velocity; their materials and accelerations stay. Moved particles
  /// are handled one by one until the next neighbour list; many of them make a new list necessary.
  virtual void edit(std::span<const ParticleAt> edited) = 0;

  /// Adds particles with ids above all earlier ones. They have no acceleration of a last step: under velocity Verlet,
  /// their first half kick is 0. Returns what they bring along.
  virtual RemovalSums insert(const ParticleSet& newborn) = 0;

  /// From now on, pushes the particles of these ids, which are unique, with these forces, N, and no others. Particles
  /// that are gone later are left out, and configure() ends all forces. Returns the first id that no particle has, if
  /// there is one; then nothing changes.
  virtual std::optional<std::uint64_t> set_external_forces(std::span<const std::uint64_t> ids,
                                                           std::span<const Vec3d> forces) = 0;

  /// Removes the particles of these ids, which are unique. Returns the momentum and energy that they take along; under
  /// velocity Verlet, those after the coming half kick, whose work is booked ahead.
  virtual Removal remove(std::span<const std::uint64_t> ids) = 0;

  /// Removes the particles whose centres are inside of the scene's sinks. Returns what they take along, as remove().
  virtual RemovalSums remove_sunk() = 0;

  // The stages of a step --------------------------------------------------------------------------------------------

  /// First half of velocity Verlet: v += dt/2 a; x += dt v. follow_motion() and remove_departed() are to follow.
  virtual void half_kick_and_drift() = 0;

  /// Called after particles have moved. When it returns, periodic coordinates are wrapped, and the neighbour list has
  /// followed the motion or is stale.
  virtual void follow_motion() = 0;

  /// Then removes the particles outside open faces, and reports them in `left`.
  virtual void remove_departed(RemovalSums& left) = 0;

  /// Whether a pair not on the neighbour list could touch now. Always right; never depends on an old speed.
  virtual bool neighbours_stale() = 0;

  /// Sorts particles into cells and lists the pairs that may touch until the list is stale.
  virtual Condition build_neighbours() = 0;

  /// The main stage: all forces at `now` and, in the same pass, the integrator's part. Springs that are
  /// stretched too far when it begins break when it ends. Reports the condition and the sums.
  ///   symplectic Euler   v += dt a; x += dt v. follow_motion() and remove_departed() are to follow.
  ///   velocity Verlet    v += dt/2 a
  virtual void apply_forces(const Instant& now, StepReport& report) = 0;

  /// Symplectic Euler: how many steps apply_forces_in_a_row() may well take now, 1 or more.
  virtual std::size_t most_in_a_row() const { return 1; }

  /// Symplectic Euler: apply_forces() at these instants, a step apart, with the motion between them, as far as nothing
  /// but follow_motion() would have to be called in between: until a list is stale, a particle is outside an open face,
  /// a spring breaks, or a condition is found. Returns how many of the steps it took, 1 or more; the report is of all
  /// of them, its condition that of the last. follow_motion() and remove_departed() are to follow.
  virtual std::size_t apply_forces_in_a_row(std::span<const Instant> steps, StepReport& report) {
    apply_forces(steps.front(), report);
    return 1;
  }

  /// Velocity Verlet: evaluates the accelerations a(x, v) of all particles at `now`, which have none of a last step.
  /// Nothing moves. After build_neighbours() where the list was stale.
  virtual void evaluate_accelerations(const Instant& now, StepReport& report) = 0;

  // The observer ----------------------------------------------------------------------------------------------------

  /// Appends the particles that touch others (Material::interacts) and whose centres are in a box, in any order.
  virtual void find_inside(const Box3d& box, std::vector<Occupant>& out) const = 0;

  /// Sum over the particles of a mix of id and of the bits of position and velocity, modulo 2^64: in the
  /// precision of this back end, in any order.
  virtual std::uint64_t particles_hash() const = 0;

  /// The sums behind the figures at `now`; first rebuilds the neighbour list if it is stale.
  virtual Expected<MeasurementSums> measure(const Instant& now) = 0;

  virtual NeighbourStatistics neighbour_statistics() const = 0;

  /// Times of everything so far, also outside of steps.
  virtual StageTimes stage_times() const = 0;

  /// This back end as one of several that hold a scene's particles together; null where it can't be one.
  virtual SharedParticles* shared() { return nullptr; }
};

/// All particles of a back end, with accelerations under velocity Verlet.
void download(const Backend& backend, Integrator integrator, ParticleSet& out);

}  // namespace hooke
