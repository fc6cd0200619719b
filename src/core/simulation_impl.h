// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hooke/base/bytes.h"
#include "hooke/base/format.h"
#include "hooke/core/ranks.h"
#include "hooke/core/simulation.h"
#include "hooke/core/snapshot_pool.h"
#include "hooke/core/step.h"

namespace hooke {

inline Unexpected no_backend() { return fail(Error::Kind::bad_input, "backend", "there is none: it is null"); }

struct Simulation::Impl {
  explicit Impl(std::shared_ptr<Communicator> communicator) : ranks(std::move(communicator)) {}
  ~Impl() { lead(Order::end); }

  Scene scene;
  std::unique_ptr<Backend> backend;
  Ranks ranks;
  RunState run;
  double initial_energy = 0, initial_elastic = 0;
  Vec3d initial_momentum{0, 0, 0};

  // The particles on the host: copied on the first access after a change, null before.
  std::shared_ptr<const Snapshot> host;
  SnapshotPool pool;
  // On several ranks: this rank's particles, for slices(); null before.
  std::shared_ptr<const ParticleSet> own_part;
  StageTimes stage_times;  // of steps

  bool failed = false;
  Error failure;

  bool single() const { return scene.precision == Precision::single_precision; }
  double mass_of(std::size_t material) const { return scene.materials[material].mass; }

  // On every rank --------------------------------------------------------------------------------------------------

  // The particles have changed.
  void forget_copies() {
    host.reset();
    own_part.reset();
  }
  const std::shared_ptr<const Snapshot>& snapshot();
  Expected<ParticleAt> find(std::uint64_t id) const;
  void edit(const ParticleAt& before, const ParticleAt& after);

  // A back end in double precision, like the reference, takes every scene; one in single must not be given a scene that
  // asks for double.
  Expected<void> check_precision() const;
  // Hands all particles to the back end. Under velocity Verlet those that are new get their first accelerations.
  Expected<void> start(const ParticleSlices& particles, bool are_new, const std::vector<std::uint64_t>& broken_springs);
  Expected<void> start_here(const ParticleSlices& particles, bool take_accelerations,
                            const std::vector<std::uint64_t>& broken_springs);
  // The same for a saved state. `findings` are those of its particles, `largest_id` is theirs.
  Expected<void> restore(SimulationState& state, const ParticleSlices& particles, std::vector<Finding> findings,
                         std::uint64_t largest_id);
  // The simulation that has been started with new particles, measured.
  static Expected<Simulation> begin(std::unique_ptr<Impl> started);
  Expected<void> take_steps(std::int64_t count);

  // Runs what changes or asks the back end. If memory runs out or a device fails, the back end's state is unknown: the
  // simulation fails.
  template <class Body>
  auto guarded(const Body& body) -> decltype(body()) {
    if (failed) return fail(failure);
    try {
      return body();
    } catch (const std::bad_alloc&) {
      return out_of_memory();
    } catch (const DeviceFailure& of_device) {
      return device_failed(of_device);
    }
  }
  Unexpected out_of_memory();
  Unexpected device_failed(const DeviceFailure& of_device);

  Expected<void> check(const Condition& condition);
  std::string describe(const Condition& condition);
  std::string likely_cause();

  // Rank 0 orders, the others follow -------------------------------------------------------------------------------

  // What several ranks can't do yet.
  Expected<void> check_ranks() const;
  // For what changes single particles, materials and motions, of which the other ranks would not know.
  Expected<void> check_alone() const;

  // What rank 0 has the others do (follow()), each time that it does so itself.
  enum class Order : std::uint8_t {
    start,
    step,
    count,
    hash,
    ledger,
    measure,
    gather,
    slices,
    visit,
    broken,
    neighbours,
    costs,
    end
  };
  struct StartOrder {
    std::int64_t step;
    std::uint64_t next_id;
    double kick;  // LedgerSums::kick
    bool take_accelerations;
  };
  template <class... Details>
  void lead(Order order, const Details&... details) {
    if (ranks.is_serial() || !ranks.leads()) return;
    std::vector<std::byte> bytes;
    append_bytes(bytes, order);
    (append_bytes(bytes, details), ...);
    ranks.communicator().broadcast(bytes);
  }
  void lead_start(bool take_accelerations, const std::vector<std::uint64_t>& broken_springs);
  void follow_start(std::span<const std::byte> from);
  // Ranks above 0: does what rank 0 orders, until it ends. A failure is that of all ranks, and rank 0 reports it.
  void follow();

  // Of all ranks, for rank 0.
  void gather(ParticleSet& particles);
  class SlicesOfRanks;
  class SlicesOfSnapshot;
  std::unique_ptr<const ParticleSlices> slices();
  SlicesHeader begin_slices();
  void visit(std::size_t rows, const ParticleSlices::Take& take);
  std::uint64_t particle_count();
  std::vector<std::uint64_t> broken_springs();
  RankCosts rank_costs();
  NeighbourStatistics neighbour_statistics();
  std::uint64_t particles_hash();
  LedgerSums ledger();
  Expected<Measurements> measure();
};

}  // namespace hooke
