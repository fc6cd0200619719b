// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/backend.h"
#include "hooke/core/communicator.h"
#include "hooke/core/emission.h"
#include "hooke/core/ledger_sums.h"
#include "hooke/core/particle_slices.h"
#include "hooke/core/particles.h"
#include "hooke/core/ranks.h"
#include "hooke/core/scene.h"
#include "hooke/core/snapshot.h"

namespace hooke {

/// Everything that a run needs to go on with the same bits: what a checkpoint stores.
struct SimulationState {
  ParticleSet particles;      ///< with accelerations under velocity Verlet
  std::int64_t step = 0;      ///< steps done
  std::uint64_t next_id = 1;  ///< id of the next particle to be added
  LedgerSums ledger;
  std::shared_ptr<const Structure> structure;  ///< the scene's; used where a scene to resume has none
  std::vector<std::uint64_t> broken_springs;   ///< indices of its springs, ascending
  double initial_energy = 0;  ///< kinetic, potential, elastic, of springs and of attraction at step 0, J
  double initial_elastic = 0;  ///< of that, in contacts between particles and in springs, J
  Vec3d initial_momentum{0, 0, 0};
  EmissionState emission{};
};

/// A particle to be added.
struct NewParticle {
  std::size_t material = 0;  ///< index into Scene::materials
  Vec3d position{0, 0, 0};   ///< m
  Vec3d velocity{0, 0, 0};   ///< m/s
};

/// How Simulation::create() takes a scene.
struct CreateOptions {
  bool allow_unstable_step = false;  ///< takes steps beyond stable_step(), with which springs may gain energy
  /// The ranks that compute the scene together, of which this is rank 0; the others follow(). Null: one alone.
  std::shared_ptr<Communicator> communicator{};
};

/// One simulation: a scene's rules, its particles, and a back end that steps them.
///
///     auto backend = hooke::make_cpu_backend();
///     if (!backend) return complain(backend.error());
///     auto simulation = hooke::Simulation::create(scene, particles, std::move(*backend));
///     if (!simulation) return complain(simulation.error());
///     if (auto stepped = simulation->step(100); !stepped) return complain(stepped.error());
///     for (const hooke::Vec3d& x : simulation->positions()) draw(x);
///
/// Nothing here throws, prints or exits; what can fail returns Expected. Not thread-safe: one thread
/// calls, the back end uses as many as it was given.
class Simulation {
 public:
  /// Checks scene and particles (ids unique and ascending, materials known, everything finite, a stable step) and hands
  /// them to the back end. Error::Kind::bad_input with every finding otherwise; where `backend` is null, too.
  static Expected<Simulation> create(Scene scene, ParticleSet particles, std::unique_ptr<Backend> backend,
                                     const CreateOptions& options = {});

  /// Goes on from a saved state: the same bits as if it had never stopped. Errors as of create(), but that the step may
  /// be an unstable one, as it was when the state was saved.
  static Expected<Simulation> resume(Scene scene, SimulationState state, std::unique_ptr<Backend> backend,
                                     std::shared_ptr<Communicator> communicator = nullptr);

  /// create() and resume() for particles that are taken a slice at a time, several times over: where several ranks
  /// compute a scene without a structure, rank 0 never holds more than a slice and its own part of them. `particles` is
  /// let go of once they are dealt out. An error of theirs is returned as it is. state.particles is not looked at.
  static Expected<Simulation> create_in_slices(Scene scene, std::shared_ptr<const ParticleSlices> particles,
                                               std::unique_ptr<Backend> backend, const CreateOptions& options = {});
  static Expected<Simulation> resume_in_slices(Scene scene, SimulationState state,
                                               std::shared_ptr<const ParticleSlices> particles,
                                               std::unique_ptr<Backend> backend,
                                               std::shared_ptr<Communicator> communicator = nullptr);

  /// On ranks above 0, in place of create() or resume() on rank 0: holds this rank's part of the particles and takes
  /// part in all that rank 0's simulation is asked to do, until that one is gone. The same scene, without its
  /// particles, and a back end of the same precision. What goes wrong on any rank rank 0 reports. On several ranks a
  /// simulation steps, measures, and is read and saved; what changes it otherwise is refused.
  static void follow(Scene scene, std::unique_ptr<Backend> backend, std::shared_ptr<Communicator> communicator);

  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Takes `count` (>= 0) steps of Scene::time_step. Error::Kind::run_failed, with the step, the particles and the
  /// likely cause, when the run goes bad; the simulation then stays as it is and takes no more steps.
  Expected<void> step(std::int64_t count = 1);

  const Scene& scene() const;
  std::int64_t step_count() const;  ///< steps done since the start
  double time() const;  ///< step_count * time_step, s
  std::uint64_t particle_count() const;
  std::uint64_t next_id() const;
  BackendInfo backend_info() const;
  NeighbourStatistics neighbour_statistics() const;  ///< of several ranks, rank 0's, but for missed contacts
  /// What the ranks that compute it have cost since the last call.
  RankCosts rank_costs();
  /// Wall time of all calls of step() so far, by stage.
  const StageTimes& stage_times() const;

  /// The present particles: the same snapshot until the next call that steps or changes something. Keep it as long as
  /// you like, on any thread. The first call after a change copies the particles from the back end.
  std::shared_ptr<const Snapshot> snapshot() const;

  /// The present particles slice by slice: where several ranks compute, none of them ever holds all. Valid until the
  /// next call that steps or changes something.
  std::unique_ptr<const ParticleSlices> slices() const;

  /// Of snapshot(), by ascending id. Valid until the next call that steps or changes something.
  const ParticleSet& particles() const;
  std::span<const std::uint64_t> ids() const;
  std::span<const Vec3d> positions() const;  ///< m
  std::span<const Vec3d> velocities() const;  ///< m/s

  /// Copies the particles into the caller's columns, of particle_count() entries, in ascending order of id: for callers
  /// that need only part of a snapshot, or floats.
  Expected<void> copy_particles(const ParticleColumns<double>& out) const;
  Expected<void> copy_particles(const ParticleColumns<float>& out) const;

  /// Adds particles; returns their ids, in order. Under velocity Verlet they begin as births do, with no acceleration
  /// of a last step. Materials must exist, values be finite, positions inside the domain.
  Expected<std::vector<std::uint64_t>> add_particles(std::span<const NewParticle> particles);
  /// Removes particles by id; none of them is removed where one is unknown.
  Expected<void> remove_particles(std::span<const std::uint64_t> ids);
  /// One particle as it is. For a few of many: it does not copy the others, as particles() does.
  Expected<ParticleAt> find(std::uint64_t id) const;
  /// v += impulse / m (N s) of one particle.
  Expected<void> apply_impulse(std::uint64_t id, const Vec3d& impulse);
  /// Moves one particle and sets its velocity (m, m/s): for particles led by hand.
  Expected<void> set_particle(std::uint64_t id, const Vec3d& position, const Vec3d& velocity);
  /// Pushes each of these particles with its force (N) in every evaluation of the forces from now on (velocity Verlet's
  /// next first half kick is still by the last one), in place of the forces that were set before; empty ones end it.
  /// Ids must exist and be unique, forces finite. Forces are not part of the state: a saved state does not have them,
  /// and set_material() and restore() end them. Their work is in the ledger (Cause::external).
  Expected<void> set_external_forces(std::span<const std::uint64_t> ids, std::span<const Vec3d> forces);
  /// Breaks springs of the scene's structure (indices) for good, in any order; those that are broken already are passed
  /// over, but one must be whole. The ledger counts them as broken, with their energy less what contacts between their
  /// ends gain. Ends forces of set_external_forces(), as set_material() does.
  Expected<void> cut_springs(std::span<const std::uint64_t> springs);
  /// Replaces the material of the same name, from the next step on.
  Expected<void> set_material(const Material& material);

  /// Where the colliders of the scene are now, in its order.
  std::span<const ColliderPose> collider_poses() const;
  /// Gives the collider `name` another motion, from now on: a HeldMotion puts it where a hand holds it. Like a material
  /// it belongs to the scene, not to the state: to go on from a saved state, change it again.
  Expected<void> set_collider_motion(const std::string& name, const Motion& motion);

  /// The complete state; restore() goes back to one, and the same bits follow.
  SimulationState state() const;
  /// state() without the particles, for callers of slices().
  SimulationState state_besides_particles() const;
  Expected<void> restore(SimulationState state);

  /// 64 bits that are equal only where every id, position and velocity, the clock and the id counter are
  /// (docs/determinism.md).
  std::uint64_t state_hash() const;

  /// Figures of this instant.
  Expected<Measurements> measure() const;
  /// Sums over all steps so far.
  Ledger ledger() const;
  /// Which springs of Scene::structure are broken: indices, ascending.
  std::vector<std::uint64_t> broken_springs() const;
  /// Kinetic, potential, elastic, springs' and attraction's energy at step 0, J, and momentum, kg m/s: the references
  /// of drifts. Particles that are later added, removed or pushed by hand change this momentum, but not this energy.
  double initial_energy() const;
  double initial_elastic() const;  ///< of that, in contacts between particles and in springs, J
  const Vec3d& initial_momentum() const;

 private:
  struct Impl;
  explicit Simulation(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// |momentum - what gravity, walls, colliders, drag and departures account for| over the sum of m |v| and of those
/// impulses. Rounding alone leaves about 1e-7 in single precision.
double momentum_drift(const Measurements& now, const Ledger& ledger, const Vec3d& initial_momentum);

/// The work of contacts between particles and of springs, plus the change of the energy in them: 0 but for the
/// integrator's error, J (docs/theory.md section 6). Positive where the integrator has made energy.
double integration_error(const Measurements& now, const Ledger& ledger, double initial_elastic);

/// The largest stable step, s (docs/theory.md eq. 9): of the scene's stiffest and lightest materials, of the springs
/// around each of `particles`, and of drag; and which coefficient limits it.
struct StableStep {
  double seconds = 0;  ///< infinite where nothing can oscillate
  /// e.g. "stiffness and damping of water - water", "stiffness of the springs around particle 7 (cloths[0], silk)"
  std::string limit;
};
StableStep stable_step(const Scene& scene, const ParticleSet& particles = {});
/// The same for a simulation's present state. Reads its particles only where the scene has a structure.
StableStep stable_step(const Simulation& simulation);
/// Empty where Scene::time_step is stable; otherwise a sentence with both steps and the coefficient that limits it.
std::string unstable_step(const Scene& scene, const StableStep& stable);

}  // namespace hooke
