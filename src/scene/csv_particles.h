// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hooke/base/vec3.h"
#include "hooke/scene/findings.h"

namespace hooke {

/// What holds for the particles of a file where its columns say nothing.
struct CsvDefaults {
  std::vector<std::string> materials;     ///< names that a row may use, in the order of their indices
  std::optional<std::uint16_t> material;  ///< index
  Vec3d velocity{0, 0, 0};                ///< m/s
};

/// The rows of one file.
struct CsvParticles {
  std::vector<std::uint64_t> id;  ///< empty where the file has no such column
  std::vector<std::uint16_t> material;
  std::vector<Vec3d> position;      ///< m
  std::vector<Vec3d> velocity;      ///< m/s
  std::vector<std::uint32_t> line;  ///< that each row stands on; the header is line 1
  std::vector<std::string> ignored_columns;
};

/// Reads particles from CSV: a header, then a particle a line. Columns x, y, z are required; id, vx, vy, vz and
/// material (by name) are read where present. LF or CRLF, a byte order mark, quoted fields and blank lines are fine.
/// Findings name `name` and the line. Rows with a fault are left out.
CsvParticles read_csv_particles(const std::filesystem::path& file, const std::string& name, const CsvDefaults& defaults,
                                Findings& findings);

}  // namespace hooke
