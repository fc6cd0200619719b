// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "hooke/scene/file_scanner.h"
#include "hooke/scene/particle_rows.h"

namespace hooke::scene {

/// Reads particles from the scanner's position into `rows`: sets the columns and the expected number of rows, then adds
/// the rows unless only their number was asked for. Throws FileFault where it can't go on.
using ParticleReader = void(FileScanner& in, ParticleRows& rows);

/// Moves the scanner to the start of a snapshot, counted from 0, or of the last one. `skip` skips one snapshot, or
/// returns false at the end of the file.
void go_to_frame(FileScanner& in, std::uint64_t frame, const std::function<bool()>& skip);

/// Skips the lines of `count` particles.
void skip_rows(FileScanner& in, std::uint64_t count);

/// The fault of a file that ends after `rows` particles of `count`.
FileFault ends_early(const FileScanner& in, std::uint64_t rows, std::uint64_t count);

// One reader per format, each in its own file; particle_file.cpp lists them.
ParticleReader read_csv_particles;
ParticleReader read_ply_particles;
ParticleReader read_xyz_particles;
ParticleReader read_lammps_data;
ParticleReader read_lammps_dump;

}  // namespace hooke::scene
