// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// CSV: a header, then one particle per line. Quoted fields and blank lines are allowed.
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "hooke/scene/csv_fields.h"
#include "hooke/scene/particle_format.h"
#include "hooke/scene/words.h"

namespace hooke::scene {

namespace {

constexpr std::array<std::pair<std::string_view, Quantity>, 8> kNames{{{"x", Quantity::x},
                                                                       {"y", Quantity::y},
                                                                       {"z", Quantity::z},
                                                                       {"vx", Quantity::vx},
                                                                       {"vy", Quantity::vy},
                                                                       {"vz", Quantity::vz},
                                                                       {"id", Quantity::id},
                                                                       {"material", Quantity::material}}};

std::vector<Column> columns_of(const CsvFields& header) {
  std::vector<Column> columns;
  for (const std::string_view title : header.at) {
    const auto* known =
        std::find_if(kNames.begin(), kNames.end(), [title](const auto& entry) { return entry.first == title; });
    columns.push_back({known == kNames.end() ? Quantity::unknown : known->second, std::string(title)});
  }
  return columns;
}

bool only_blanks_follow(FileScanner& in) {
  while (const auto line = in.line()) {
    if (!trimmed(*line).empty()) return false;
  }
  return true;
}

}  // namespace

void read_csv_particles(FileScanner& in, ParticleRows& rows) {
  const std::string header(in.line().value_or(""));
  if (trimmed(header).empty() && only_blanks_follow(in)) {
    throw FileFault(1, "is empty; it must start with a header that has columns x, y, z");
  }
  CsvFields fields;
  fields.split(header);
  if (!rows.set_columns(columns_of(fields), 1)) return;
  // The number of rows is only known by counting the lines.
  const FileScanner::Place start = in.place();
  while (in.line()) {}
  const std::uint64_t lines = in.line_number() - 1;
  if (!rows.expect(lines, lines)) return;
  in.go_back(start);
  while (const auto line = in.line()) {
    if (trimmed(*line).empty()) continue;
    fields.split(*line);
    Row row = rows.blank();
    if (fields.open_quote) {
      rows.complain(in.line_number(), "has a quote that is not closed");
    } else if (rows.read(fields.at, row, in.line_number())) {
      rows.add(row, in.line_number());
    }
  }
}

}  // namespace hooke::scene
