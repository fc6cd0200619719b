// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hooke/base/box3.h"
#include "hooke/base/vec3.h"

namespace hooke {

/// Bytes to another rank, or from it.
struct Parcel {
  int rank = 0;
  std::vector<std::byte> bytes;
};

/// A place, m, and what is there to be shared out.
struct WeightedPoint {
  Vec3d at;
  double weight = 1;
};

/// How the ranks that compute one scene together talk to each other: processes of a cluster (comm/mpi), threads of a
/// test. Rank 0 leads: it reads, writes and speaks. Every rank calls each of these functions in the same order.
class Communicator {
 public:
  /// Adds one item to another: of equal type, trivially copyable, in any order of ranks with the same result.
  using Add = void (*)(const void* item, void* sum);

  /// Messages between the same ranks, of the same sizes, again and again.
  class Channel {
   public:
    virtual ~Channel() = default;
    /// Sends what is to be sent; returns when all that was to come has come.
    virtual void exchange() = 0;
  };
  /// What goes to a rank, or where what comes from it is put; the memory stays the caller's.
  struct Route {
    int rank = 0;
    std::span<std::byte> bytes;
  };

  virtual ~Communicator() = default;

  virtual int rank() const = 0;  ///< 0 to size() - 1
  virtual int size() const = 0;

  /// Every rank's `count` items of `bytes` bytes each become the sums over all ranks.
  virtual void combine(void* items, std::size_t count, std::size_t bytes, Add add) = 0;

  /// Everyone gets what rank 0 has.
  virtual void broadcast(std::vector<std::byte>& data) = 0;

  /// Sends these, at most one to each rank, and returns what others sent here, in order of their ranks. Nobody knows
  /// before who writes to whom; a rank may write to itself.
  virtual std::vector<Parcel> exchange(std::vector<Parcel> out) = 0;

  /// A channel: each route out has one in at the other end, of the same size. Routes of no bytes are left out.
  virtual std::unique_ptr<Channel> open(std::span<const Route> out, std::span<const Route> in) = 0;

  /// Cuts space into a box (m) for each rank, so that the boxes tile it and all ranks' points in each weigh about as
  /// much; a weight is above 0. The boxes' outer faces are at infinity. Every rank gets all of them.
  virtual std::vector<Box3d> cut(std::span<const WeightedPoint> points) = 0;

  /// Processor time so far of the thread that calls, s: what ranks balance their work by. Where it stands still, as in
  /// most tests, they balance their counts of particles.
  virtual double processor_seconds() const = 0;

  /// Ends the program on all ranks, where one alone knows that it can't go on: `why` is said on standard error.
  [[noreturn]] virtual void abort(const std::string& why) = 0;
};

}  // namespace hooke
