// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hooke/core/particle_slices.h"
#include "hooke/core/scene.h"
#include "hooke/scene/load_scene.h"
#include "hooke/scene/particle_source.h"

namespace hooke::scene {

/// The particles of a scene's sources, the same as those of the whole set, made when they are visited: a lattice slice
/// by slice, every other source at once. The one of these that was made last is held until another one takes its place.
class SourceSlices final : public ParticleSlices {
 public:
  SourceSlices(const Scene& scene, std::vector<ParticleSource> sources);

  /// To be called first: makes all particles once and looks at them. False where only the whole set will do: something
  /// is or may be wrong, which is to be said of the whole set, or ids don't ascend from source to source.
  bool prepare(const LoadOptions& options, std::vector<Finding>& warnings);

  std::uint64_t size() const override;
  std::uint64_t identity() const override { return identity_; }
  bool has_accelerations() const override { return false; }
  Expected<void> visit(std::size_t rows, const Take& take) const override;

 private:
  // The particles of a source that is no lattice. Columns that are one value for all are empty.
  struct Made {
    std::vector<std::uint64_t> id;
    std::vector<std::uint16_t> material;
    std::vector<Vec3d> position;
    std::vector<Vec3d> velocity;
  };
  class Slicer;

  Made make(const ParticleSource& source, Findings& findings, std::vector<Finding>& warnings) const;
  Expected<void> hold(std::size_t source) const;
  void hand_out(std::size_t source, Slicer& to) const;
  double largest_radius() const;
  double expected_size() const;

  // Of the scene, which may be moved away.
  Domain domain_;
  std::vector<Material> materials_;
  std::optional<Attraction> attraction_;

  std::vector<ParticleSource> sources_;
  std::vector<std::uint64_t> counts_;  // of each source
  std::uint64_t identity_ = 0;
  mutable Made made_;
  mutable std::optional<std::size_t> made_source_;  // whose made_ is
};

}  // namespace hooke::scene
