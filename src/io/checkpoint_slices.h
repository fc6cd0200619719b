// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "hooke/core/particle_slices.h"
#include "hooke/io/checkpoint.h"

namespace hooke::io {

/// A checkpoint whose particles are read when they are visited, a slice at a time, from the file, which stays open.
struct CheckpointInSlices {
  Checkpoint rest;  ///< without particles
  std::shared_ptr<const ParticleSlices> particles;
};

/// Opens a checkpoint for those who could not hold all of its particles; like read_checkpoint() in all else.
Expected<CheckpointInSlices> read_checkpoint_in_slices(const std::filesystem::path& file);

}  // namespace hooke::io
