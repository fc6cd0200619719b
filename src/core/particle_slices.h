// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "hooke/base/expected.h"
#include "hooke/core/particles.h"

namespace hooke {

/// Particles that follow each other in ascending order of id: columns of one length. Accelerations may be left out.
struct ParticleSlice {
  std::span<const std::uint64_t> id;
  std::span<const std::uint16_t> material;
  std::span<const Vec3d> position;      ///< m
  std::span<const Vec3d> velocity;      ///< m/s
  std::span<const Vec3d> acceleration;  ///< m/s^2

  ParticleSlice() = default;
  ParticleSlice(const ParticleSet& set, std::size_t first, std::size_t count)
      : id(std::span(set.id).subspan(first, count)),
        material(std::span(set.material).subspan(first, count)),
        position(std::span(set.position).subspan(first, count)),
        velocity(std::span(set.velocity).subspan(first, count)) {
    if (!set.acceleration.empty()) acceleration = std::span(set.acceleration).subspan(first, count);
  }

  std::size_t size() const { return id.size(); }

  /// A sum over its particles, modulo 2^64, that differs where their ids or materials do: the sum over all slices of
  /// a set is the set's, in whatever way it is cut.
  std::uint64_t identity() const;
};

/// Particles that are taken at a time where nothing else asks for a number: 60 to 80 MB of them.
inline constexpr std::size_t kSliceRows = std::size_t{1} << 20U;

/// Particles, in ascending order of id, for those who take them a slice at a time because they could not hold all of
/// them: files, and rank 0 of several.
class ParticleSlices {
 public:
  using Take = std::function<void(const ParticleSlice&)>;

  virtual ~ParticleSlices() = default;
  virtual std::uint64_t size() const = 0;
  virtual std::uint64_t identity() const = 0;  ///< ParticleSlice::identity() of all
  virtual bool has_accelerations() const = 0;
  /// All of them, where they are held.
  virtual const ParticleSet* set() const { return nullptr; }
  /// Calls `take`, which does not throw, with `rows` (> 0) particles at a time, the last time with those left. May be
  /// called again. An error, of a file for example, ends it early.
  virtual Expected<void> visit(std::size_t rows, const Take& take) const = 0;
};

/// Those of a set, which must outlive this.
class SlicesOfSet final : public ParticleSlices {
 public:
  explicit SlicesOfSet(const ParticleSet& set) : set_(set) {}

  std::uint64_t size() const override { return set_.size(); }
  std::uint64_t identity() const override { return ParticleSlice(set_, 0, set_.size()).identity(); }
  const ParticleSet* set() const override { return &set_; }
  bool has_accelerations() const override { return !set_.acceleration.empty(); }
  Expected<void> visit(std::size_t rows, const Take& take) const override {
    for (std::size_t first = 0; first < set_.size(); first += rows) {
      take(ParticleSlice(set_, first, std::min(rows, set_.size() - first)));
    }
    return {};
  }

 private:
  const ParticleSet& set_;
};

/// All of them as a set.
inline Expected<ParticleSet> collected(const ParticleSlices& particles) {
  ParticleSet all;
  all.reserve(particles.size());
  auto visited = particles.visit(std::size_t{1} << 16U, [&all](const ParticleSlice& slice) {
    all.id.insert(all.id.end(), slice.id.begin(), slice.id.end());
    all.material.insert(all.material.end(), slice.material.begin(), slice.material.end());
    all.position.insert(all.position.end(), slice.position.begin(), slice.position.end());
    all.velocity.insert(all.velocity.end(), slice.velocity.begin(), slice.velocity.end());
    all.acceleration.insert(all.acceleration.end(), slice.acceleration.begin(), slice.acceleration.end());
  });
  if (!visited) return fail(visited.error());
  return all;
}

}  // namespace hooke
