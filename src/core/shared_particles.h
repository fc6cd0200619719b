// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/base/box3.h"
#include "hooke/base/vec3.h"
#include "hooke/core/communicator.h"
#include "hooke/core/id_runs.h"
#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/core/sums.h"

namespace hooke {

/// Which rank owns which part of space: a particle belongs to the rank whose box holds its centre, lower faces
/// included, upper faces not. The boxes tile space.
struct Decomposition {
  std::vector<Box3d> boxes;  ///< m, by rank
  Domain domain;             ///< whose axes may be periodic

  bool owns(int rank, const Vec3d& x) const {
    const Box3d& box = boxes[static_cast<std::size_t>(rank)];
    return x.x >= box.min.x && x.y >= box.min.y && x.z >= box.min.z && x.x < box.max.x && x.y < box.max.y &&
           x.z < box.max.z;
  }
  /// The lowest rank whose box holds a place; kNobody where it is nowhere (NaN).
  int owner(const Vec3d& x) const;
  static constexpr int kNobody = -1;
  /// Whether a place is within `reach` (m) of a rank's box along every axis, also around a periodic one.
  bool is_near(int rank, const Vec3d& x, double reach) const;
};

/// How far a neighbour list and the copies of the others' particles reach, m.
struct GhostWidth {
  double skin = 0;   ///< of the list
  double slack = 0;  ///< beyond it: how far reference frames may move apart before there must be new copies
};

/// Which particles' copies other ranks need: those nearer to a rank's box than the largest particle of that rank can
/// reach, and the skin and the slack.
struct GhostZones {
  const Decomposition* space = nullptr;
  int here = 0;                         ///< this rank
  std::span<const double> largest;  ///< m, by rank: the largest interaction radius of its particles, below 0: none
  GhostWidth width;
  /// For particles of an interaction radius (m), the distance from a rank's box (m) at which it needs copies.
  double reach(int rank, double radius) const {
    return 1.001 * (radius + largest[static_cast<std::size_t>(rank)]) + width.skin + width.slack;
  }
};

/// Particles (indices of their ids) that a rank asks the others for.
struct WantedParticles {
  int rank = 0;
  std::vector<std::uint32_t> id_indices;  ///< ascending
};

/// The box around the displacements of reference frames since the copies were made: upper bounds along x, y, z, then
/// lower ones with the opposite sign, m. Below all numbers where there are none.
struct FrameDisplacements {
  double most[6] = {-1e300, -1e300, -1e300, -1e300, -1e300, -1e300};

  bool none() const { return most[0] + most[3] < 0; }
  Vec3d middle() const {
    if (none()) return {0, 0, 0};
    return {0.5 * (most[0] - most[3]), 0.5 * (most[1] - most[4]), 0.5 * (most[2] - most[5])};
  }
  /// The distance of its furthest point from a displacement, m; 0 where there is none.
  double furthest_from(const Vec3d& displacement) const;
};

/// A back end that holds one rank's part of a scene's particles, and ghosts: copies of the other ranks' particles that
/// may touch its own. All that it reports, sums and copies is of its own particles. Ranks (core/ranks.h) calls these
/// functions; bytes are in the layout of the back end, the same on all ranks of a run.
class SharedParticles {
 public:
  virtual ~SharedParticles() = default;

  /// Replaces all particles by this rank's part; `all`: the ids of all ranks' particles, ascending, no two
  /// runs next to each other. There are no ghosts then, and the neighbour list is stale.
  virtual void assign_part(const ParticleSet& own, std::span<const IdRun> all) = 0;

  /// Adds the positions (m) of some of its particles, each with the number of those that it stands for.
  virtual void sample(std::vector<WeightedPoint>& points) const = 0;

  // New ghosts, each time before a list is built ---------------------------------------------------------------------

  /// Removes the particles that other ranks own, and adds them to parcels, one for each of these ranks.
  virtual void move_out(const Decomposition& space, int here, std::vector<Parcel>& out) = 0;
  virtual void move_in(std::span<const Parcel> in) = 0;

  /// The largest interaction radius of its particles, m; below 0 where there are none that touch others.
  virtual double largest_radius() const = 0;
  /// The width for the next list; the largest of all ranks' is taken.
  virtual GhostWidth next_width() = 0;
  /// The particles that its own are tied to, by springs or in a cloth, and that it does not hold: ascending.
  virtual std::vector<std::uint32_t> wanted() const = 0;
  /// Whether every rank needs copies of all particles.
  virtual bool wants_all() const = 0;
  /// Adds copies of its particles to parcels, one for each rank that needs some, and remembers which: those in the
  /// zones, and those that are wanted.
  virtual void copy_out(const GhostZones& zones, std::span<const WantedParticles> wanted, std::vector<Parcel>& out) = 0;
  /// Replaces all ghosts.
  virtual void take_ghosts(std::span<const Parcel> in) = 0;

  // Springs (indices) ------------------------------------------------------------------------------------------------

  virtual bool has_springs() const = 0;
  /// Springs that tore here since the last call; and springs that have torn on other ranks.
  virtual std::vector<std::uint32_t> take_torn() = 0;
  virtual void tear(std::span<const std::uint32_t> springs) = 0;

  // Population -------------------------------------------------------------------------------------------------------

  /// Backend::insert() of those newborn particles whose places this rank owns; it learns the ids of the others. The
  /// elastic energy is left out.
  virtual RemovalSums insert_part(const ParticleSet& newborn, const Decomposition& space, int here) = 0;
  /// Whether particles act on each other across gaps.
  virtual bool has_cohesion() const = 0;
  /// Adds the energy of the contacts that end at its particles of these ids, half of it where both ends do.
  virtual void add_elastic_of(std::span<const std::uint64_t> ids, ExactSum& sum) = 0;
  /// Ids that it keeps, of all ranks' particles, also of some that are gone.
  virtual std::size_t id_count() const = 0;

  // Ghosts move with the particles that they are copies of -----------------------------------------------------------

  virtual std::uint64_t own_count() const = 0;
  virtual std::size_t copy_bytes() const = 0;  ///< that copy_out() writes for a particle
  virtual std::size_t packed_bytes() const = 0;  ///< that pack() does
  /// Particles that copy_out() has copied, and ghosts.
  virtual std::size_t copied_count() const = 0;
  virtual std::size_t ghost_count() const = 0;
  /// Where the copied particles are now, in the order of copy_out().
  virtual void pack(std::span<std::byte> out) const = 0;
  /// Where the ghosts are now, in the order of take_ghosts().
  virtual void unpack(std::span<const std::byte> in) = 0;

  // What all ranks decide from ---------------------------------------------------------------------------------------

  virtual FrameDisplacements displacements() const = 0;
  /// By how much this rank's list costs more than it is worth, in units that are the same on all ranks: where the sum
  /// is above 0, all get a new one.
  virtual std::int64_t list_excess() const = 0;
  /// Whether one of its outliers, which are not near their frames, may touch a particle that this rank does not know,
  /// or that does not know it. All ranks' frames are within half a slack of `common`, m, a displacement.
  virtual bool has_lost_outlier(const GhostZones& zones, const Vec3d& common) const = 0;
  /// Whether particles will leave through open faces.
  virtual bool has_departures() const = 0;
  /// After a new list: finds them again.
  virtual void find_departures() = 0;
};

}  // namespace hooke
