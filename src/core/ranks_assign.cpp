// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// How rank 0 deals particles out at the start, a slice at a time.

#include <algorithm>
#include <new>
#include <utility>

#include "hooke/base/assert.h"
#include "hooke/base/bytes.h"
#include "hooke/core/id_runs.h"
#include "hooke/core/particle_parcels.h"
#include "hooke/core/ranks.h"

namespace hooke {
namespace {

constexpr std::size_t kMostSamples = 1'000'000;

// What rank 0 says before the others do as it does.
enum class Word : std::uint8_t { slice, all, failure };

Word spread(Communicator& communicator, Word word) {
  std::vector<std::byte> bytes;
  append_bytes(bytes, word);
  communicator.broadcast(bytes);
  std::span<const std::byte> from = bytes;
  take_bytes(from, word);
  return word;
}

template <class T>
void spread(Communicator& communicator, std::vector<T>& values) {
  std::vector<std::byte> bytes;
  append_bytes(bytes, values.data(), values.size());
  communicator.broadcast(bytes);
  values.resize(bytes.size() / sizeof(T));
  std::span<const std::byte> from = bytes;
  take_bytes(from, values.data(), values.size());
}

// Some of all positions, evenly.
Expected<std::vector<WeightedPoint>> sample_of(const ParticleSlices& particles) {
  std::vector<WeightedPoint> sample;
  const std::uint64_t stride = particles.size() / kMostSamples + 1;
  std::uint64_t next = 0;  // that is taken, counted from the first of the slice
  auto visited = particles.visit(kSliceRows, [&](const ParticleSlice& slice) {
    for (; next < slice.size(); next += stride) sample.push_back({slice.position[next]});
    next -= slice.size();
  });
  if (!visited) return fail(std::move(visited).error());
  return sample;
}

// The rank that owns each place; the leader has those that are nowhere.
class Owners {
 public:
  explicit Owners(const Decomposition& space) : space_(space) {}
  std::size_t of(const Vec3d& x) {
    if (!space_.owns(last_, x)) last_ = std::max(space_.owner(x), 0);
    return static_cast<std::size_t>(last_);
  }

 private:
  const Decomposition& space_;
  int last_ = 0;  // of the place before: neighbours often have the same
};

// How many particles each rank will about have.
std::vector<std::uint64_t> expected_parts(const Decomposition& space, const std::vector<WeightedPoint>& sample,
                                          std::uint64_t all) {
  std::vector<std::uint64_t> counts(space.boxes.size());
  Owners owners(space);
  for (const WeightedPoint& p : sample) ++counts[owners.of(p.at)];
  const double each = 1.02 * static_cast<double>(all) / std::max(1.0, static_cast<double>(sample.size()));
  for (std::uint64_t& count : counts) count = static_cast<std::uint64_t>(each * static_cast<double>(count));
  return counts;
}

// A slice as parcels, to those that own some of it.
std::vector<Parcel> dealt(const Decomposition& space, const ParticleSlice& slice) {
  std::vector<std::vector<std::size_t>> of(space.boxes.size());
  Owners owners(space);
  for (std::size_t i = 0; i < slice.size(); ++i) of[owners.of(slice.position[i])].push_back(i);
  std::vector<Parcel> out;
  for (std::size_t rank = 0; rank < of.size(); ++rank) {
    if (of[rank].empty()) continue;
    append_particles(out.emplace_back(Parcel{static_cast<int>(rank), {}}).bytes, slice, of[rank]);
    of[rank] = {};
  }
  return out;
}

}  // namespace

Expected<void> Ranks::assign(Backend& backend, const Scene& scene, const ParticleSlices& particles) {
  if (is_serial()) {
    if (const ParticleSet* const set = particles.set()) {
      backend.assign(*set);
      return {};
    }
    const auto all = collected(particles);
    if (!all) return fail(all.error());
    backend.assign(*all);
    return {};
  }
  channel_ = nullptr;
  stale_ = true;
  space_.domain = scene.domain;
  Expected<std::vector<WeightedPoint>> sample{std::vector<WeightedPoint>()};
  if (leads()) sample = sample_of(particles);
  if (spread(*communicator_, sample ? Word::all : Word::failure) == Word::failure)
    return sample ? fail(Error::Kind::run_failed, "particles", "rank 0 can't deal them out") : fail(sample.error());
  space_.boxes = communicator_->cut(*sample);
  ++statistics_.cuts;
  balance_.forget();
  ParticleSet own;
  std::vector<IdRun> ids;
  if (auto all = take_part(particles, *sample, own, ids); !all) return all;
  backend.shared()->assign_part(own, ids);
  return {};
}

// Each rank's particles, and the ids of all. Rank 0 hands out slices for as long as there are some.
Expected<void> Ranks::take_part(const ParticleSlices& particles, std::vector<WeightedPoint>& sample, ParticleSet& own,
                                std::vector<IdRun>& ids) {
  std::vector<std::uint64_t> parts;
  if (leads()) parts = expected_parts(space_, sample, particles.size());
  sample = {};
  spread(*communicator_, parts);
  own.reserve(parts[static_cast<std::size_t>(communicator_->rank())]);
  const auto take = [&](std::vector<Parcel> out) {
    for (const Parcel& parcel : exchange(std::move(out))) take_particles(parcel.bytes, own);
  };
  if (leads()) {
    auto visited = particles.visit(kSliceRows, [&](const ParticleSlice& slice) {
      try {
        append_ids(ids, slice.id);
        std::vector<Parcel> out = dealt(space_, slice);
        spread(*communicator_, Word::slice);
        take(std::move(out));
      } catch (const std::bad_alloc&) {
        communicator_->abort("particles: a slice of them does not fit into memory");
      }
    });
    spread(*communicator_, visited ? Word::all : Word::failure);
    if (!visited) return visited;
  } else {
    Word word = Word::slice;
    while ((word = spread(*communicator_, word)) == Word::slice) take({});
    if (word == Word::failure) return fail(Error::Kind::run_failed, "particles", "rank 0 can't deal them out");
  }
  spread(*communicator_, ids);
  return {};
}

}  // namespace hooke
