// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "hooke/scene/file_scanner.h"
#include "hooke/scene/particle_rows.h"

namespace hooke {

/// Reads what the scanner stands before and puts it into `rows`: says what columns there are and how many rows to
/// expect, and unless that was all that is asked for, adds the rows. Throws FileFault where it can't go on.
using ParticleReader = void(FileScanner& in, ParticleRows& rows);

/// Puts the scanner before a snapshot, counted from 0, or the last one. `skip` passes over a snapshot, or returns false
/// at the end of the file.
void go_to_frame(FileScanner& in, std::uint64_t frame, const std::function<bool()>& skip);

/// Passes over the lines of `count` particles.
void skip_rows(FileScanner& in, std::uint64_t count);

/// The fault of a file that ends after `rows` particles of `count`.
FileFault ends_early(const FileScanner& in, std::uint64_t rows, std::uint64_t count);

// One a format, each in a file of its own; particle_file.cpp lists them.
ParticleReader read_csv_particles;
ParticleReader read_ply_particles;
ParticleReader read_xyz_particles;
ParticleReader read_lammps_data;
ParticleReader read_lammps_dump;

}  // namespace hooke
