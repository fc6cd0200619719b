// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// CSV: a header, then a particle a line. LF or CRLF, a byte order mark, quoted fields and blank lines are fine.
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "hooke/scene/particle_format.h"
#include "hooke/scene/words.h"

namespace hooke {

namespace {

constexpr std::array<std::pair<std::string_view, Field>, 8> kNames{{{"x", Field::x},
                                                                    {"y", Field::y},
                                                                    {"z", Field::z},
                                                                    {"vx", Field::vx},
                                                                    {"vy", Field::vy},
                                                                    {"vz", Field::vz},
                                                                    {"id", Field::id},
                                                                    {"material", Field::material}}};

// The fields of one line. Their text is that of the line, or of `unquoted` where quotes had to be taken off.
struct Fields {
  std::vector<std::string_view> at;
  std::vector<std::string> unquoted;
  bool open_quote = false;

  void split(std::string_view line) {
    at.clear();
    unquoted.clear();
    open_quote = false;
    if (line.find('"') != std::string_view::npos) return split_quoted(line);
    while (true) {
      const auto comma = line.find(',');
      at.push_back(trimmed(line.substr(0, comma)));
      if (comma == std::string_view::npos) return;
      line.remove_prefix(comma + 1);
    }
  }

 private:
  void split_quoted(std::string_view line) {
    std::string field;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '"' && open_quote && i + 1 < line.size() && line[i + 1] == '"') {
        field += line[i++];  // a doubled quote within quotes is one
      } else if (line[i] == '"') {
        open_quote = !open_quote;
      } else if (line[i] == ',' && !open_quote) {
        unquoted.push_back(std::exchange(field, ""));
      } else {
        field += line[i];
      }
    }
    unquoted.push_back(std::move(field));
    for (const std::string& text : unquoted) at.push_back(trimmed(text));
  }
};

std::vector<Column> columns_of(const Fields& header) {
  std::vector<Column> columns;
  for (const std::string_view title : header.at) {
    const auto* known =
        std::find_if(kNames.begin(), kNames.end(), [title](const auto& entry) { return entry.first == title; });
    columns.push_back({known == kNames.end() ? Field::unknown : known->second, std::string(title)});
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
  const std::string first(in.line().value_or(""));
  std::string_view header = first;
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (header.substr(0, kByteOrderMark.size()) == kByteOrderMark) header.remove_prefix(kByteOrderMark.size());
  if (trimmed(header).empty() && only_blanks_follow(in)) {
    throw FileFault(1, "is empty; it must start with a header that has columns x, y, z");
  }
  Fields fields;
  fields.split(header);
  if (!rows.set_columns(columns_of(fields), 1)) return;
  // Nothing but the lines themselves says how many there are.
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

}  // namespace hooke
