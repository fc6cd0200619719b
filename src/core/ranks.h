// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <source_location>
#include <span>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/backend.h"
#include "hooke/core/communicator.h"
#include "hooke/core/ledger_sums.h"
#include "hooke/core/particle_slices.h"
#include "hooke/core/rank_balance.h"
#include "hooke/core/shared_particles.h"

namespace hooke {

/// A figure of all ranks.
struct RankFigure {
  double sum = 0, most = 0;
};

/// What a simulation on several ranks, or one, has cost in some time.
struct RankCosts {
  int ranks = 1;
  RankFigure processor;         ///< time of their processes, s
  RankFigure waiting;           ///< of it, of the thread that waits in messages, s
  RankFigure ghosts;            ///< summed over all exchanges
  RankFigure messages, bytes;   ///< sent for ghosts that moved
  RankFigure particles;         ///< now
  RankFigure peak_bytes;        ///< largest resident memory of the processes so far
  std::uint64_t exchanges = 0;  ///< times that all ranks got new ghosts
  std::uint64_t cuts = 0;       ///< times that the ranks' boxes were cut
  double uneven_particles = 1;  ///< the largest count of particles over the mean, on average over the steps
  double uneven_time = 1;       ///< of the time of force passes from one exchange to the next, likewise
};

/// What all ranks' particles are together.
struct SlicesHeader {
  std::uint64_t count = 0;
  std::uint64_t identity = 0;  ///< ParticleSlice::identity() of all
  bool accelerated = false;    ///< whether they have accelerations
};

/// What the ranks that compute one scene do together. Each rank's back end holds the particles in the rank's box and
/// ghosts of those near it, and reports of its own; every rank calls each of these functions at the same point of the
/// same step. All sums are exact, so it does not matter who adds them up. A scene on one rank alone needs none of this.
class Ranks {
 public:
  /// Null: one rank alone.
  explicit Ranks(std::shared_ptr<Communicator> communicator = nullptr);

  bool is_serial() const { return communicator_ == nullptr; }
  bool leads() const { return is_serial() || communicator_->rank() == 0; }
  Communicator& communicator() { return *communicator_; }

  // A step -----------------------------------------------------------------------------------------------------------

  /// Around the force pass of each step: notes how long this rank takes for it, for the balance. It is most of a step,
  /// and right after it ranks wait for each other: what else they do, lists and outliers, they do between other waits.
  class ForcePass {
   public:
    ForcePass(Ranks& ranks, Backend& backend);
    ~ForcePass();
    ForcePass(const ForcePass&) = delete;
    ForcePass& operator=(const ForcePass&) = delete;

   private:
    Ranks& ranks_;
    Backend& backend_;
    double start_;
  };

  /// Whether a list has become stale on any rank, or ghosts are missing.
  bool neighbours_stale(Backend& backend);
  /// Gives every particle to the rank that owns its place, renews the ghosts, and builds the list.
  Condition build_neighbours(Backend& backend);
  /// After particles have moved: ghosts, list and decisions follow. Returns the one to report of what all ranks have
  /// found in the step so far.
  Condition follow_motion(Backend& backend, const Condition& here);
  /// The one to report of all ranks' conditions; good where all are good.
  Condition first(const Condition& here);

  /// Backend::remove_sunk(), remove() and insert() of what is to be in all ranks' boxes together.
  RemovalSums remove_sunk(Backend& backend);
  Removal remove(Backend& backend, std::span<const std::uint64_t> ids);
  RemovalSums insert(Backend& backend, const Scene& scene, const ParticleSet& newborn);
  /// Backend::find_inside() of all ranks, on all ranks.
  void find_inside(const Backend& backend, const Box3d& box, std::vector<Occupant>& out);

  // At the start -----------------------------------------------------------------------------------------------------

  /// Deals particles out: `particles` are rank 0's, which visits them twice. Where it can't, all ranks return an error,
  /// rank 0 that of the visit, and the back ends' particles are not to be relied on.
  Expected<void> assign(Backend& backend, const Scene& scene, const ParticleSlices& particles);

  // What is asked of the whole scene ---------------------------------------------------------------------------------

  /// Rank 0 gets the sums over all ranks.
  void sum(LedgerSums& sums);
  void sum(MeasurementSums& sums);
  void sum(std::uint64_t& count);  ///< modulo 2^64: of particles, of their hashes
  /// Rank 0 gets the springs that are broken on any rank, ascending.
  void unite(std::vector<std::uint64_t>& broken_springs);
  /// Rank 0 gets all ranks' particles, in ascending order of id.
  void gather(ParticleSet& particles);
  /// The same slice by slice, `rows` (> 0) of them at a time: rank 0 calls `take`. `own`: this rank's particles, in
  /// ascending order of id.
  void visit(const ParticleSet& own, std::size_t rows, const ParticleSlices::Take& take);
  void sum(SlicesHeader& header);

  /// What all ranks' share of the work has cost since the last call: rank 0 gets it.
  RankCosts costs(std::uint64_t particles);

 private:
  // Of this rank, since the last costs().
  struct Statistics {
    std::uint64_t exchanges = 0, ghosts = 0;  // new ghosts, and how many in all
    std::uint64_t cuts = 0;  // of the boxes
    std::uint64_t messages = 0, bytes = 0;  // sent for ghosts that moved
    double processor_before = 0, waited_before = 0;  // processor_seconds(), waited_ at the last costs()
    double steps = 0, uneven_particles = 0, uneven_time = 0;  // summed over these steps
  };

  using Place = std::source_location;

  template <class T, class Body>
  void combine(std::span<T> items, const Body& body, const Place& here = Place::current());
  template <class T, class Body>
  void combine(T& item, const Body& body, const Place& here = Place::current());
  std::vector<Parcel> exchange(std::vector<Parcel> out, const Place& here = Place::current());
  void expect_all(const Place& here);
  void refresh(SharedParticles& shared);
  void cut(SharedParticles& shared);
  std::vector<std::uint64_t> slice_starts(std::span<const std::uint64_t> own_ids, std::size_t rows);
  void end_interval(std::uint64_t particles);
  void exchange_particles(SharedParticles& shared);
  void forget_removed_ids(Backend& backend, const Scene& scene);
  void share_torn(SharedParticles& shared);
  std::vector<WantedParticles> exchange_wanted(const SharedParticles& shared);
  void renew_ghosts(SharedParticles& shared);
  Expected<void> take_part(const ParticleSlices& particles, std::vector<WeightedPoint>& sample, ParticleSet& own,
                           std::vector<IdRun>& ids);
  Condition decide(Backend& backend, SharedParticles& shared, const Condition& here);
  GhostZones zones() const { return {&space_, communicator_->rank(), largest_, width_}; }

  std::shared_ptr<Communicator> communicator_;
  Decomposition space_;
  std::vector<double> largest_;  // GhostZones::largest
  GhostWidth width_;
  Vec3d middle_, last_middle_;  // FrameDisplacements::middle() of all ranks, of the last two steps since then
  bool stale_ = true;
  RankBalance balance_{1};
  double waited_ = 0;  // processor time of this thread in messages, s
  std::vector<std::byte> out_, in_;  // of the channel
  std::unique_ptr<Communicator::Channel> channel_;
  std::size_t partners_ = 0;  // that it sends to
  Statistics statistics_;
};

}  // namespace hooke
