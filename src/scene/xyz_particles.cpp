// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// XYZ: snapshots one after the other, each a count, a comment line and one row per particle. Plain rows hold species
// and position; the comment of extended XYZ names the columns: Properties=species:S:1:pos:R:3:velo:R:3:id:I:1. The
// first snapshot is read unless another is asked for.
#include <fmt/format.h>

#include <algorithm>

#include "hooke/scene/json_reader.h"
#include "hooke/scene/particle_format.h"
#include "hooke/scene/words.h"

namespace hooke::scene {

namespace {

constexpr std::uint64_t kSmallestRow = 6;  // "0 0 0\n", bytes
constexpr std::uint64_t kMostColumns = 4096;

struct Property {
  std::string_view name;
  std::size_t width;
  Quantity first;
};
constexpr Property kProperties[] = {
    {"pos", 3, Quantity::x},
    {"velo", 3, Quantity::vx},
    {"vel", 3, Quantity::vx},
    {"velocity", 3, Quantity::vx},
    {"velocities", 3, Quantity::vx},
    {"id", 1, Quantity::id},
    {"species", 1, Quantity::material},
    {"type", 1, Quantity::material},
    {"material", 1, Quantity::material},
    {"radius", 1, Quantity::radius},
    {"mass", 1, Quantity::mass},
};

// The value of a key in "key=value key="with blanks" ...", or empty.
std::string value_of(std::string_view wanted, std::string_view text) {
  while (true) {
    text = trimmed(text);
    if (text.empty()) return "";
    const auto key_end = std::min(text.find_first_of("= \t"), text.size());
    const std::string_view key = text.substr(0, key_end);
    text = trimmed(text.substr(key_end));
    if (text.empty() || text.front() != '=') continue;  // a key alone
    text = trimmed(text.substr(1));
    std::string value;
    const char quote = text.empty() ? ' ' : text.front() == '{' ? '}' : text.front() == '[' ? ']' : text.front();
    if (quote == '"' || quote == '\'' || quote == '}' || quote == ']') {
      text.remove_prefix(1);
      while (!text.empty() && text.front() != quote) {
        if (text.front() == '\\' && text.size() > 1) text.remove_prefix(1);
        value += text.front();
        text.remove_prefix(1);
      }
      if (!text.empty()) text.remove_prefix(1);
    } else {
      value = take_word(text);
    }
    if (key == wanted) return value;
  }
}

// "name:T:width", repeated.
std::vector<Column> columns_of(std::string_view properties, std::uint64_t line) {
  const auto take = [&properties] {
    const auto colon = properties.find(':');
    const std::string_view part = properties.substr(0, colon);
    properties.remove_prefix(colon == std::string_view::npos ? properties.size() : colon + 1);
    return part;
  };
  std::vector<Column> columns;
  while (!properties.empty()) {
    const std::string_view name = take();
    const std::string_view type = take();
    const std::string_view width_text = take();
    std::uint64_t width = 0;
    const bool good = !name.empty() && type.size() == 1 && read_count(width_text, width) && width > 0;
    if (!good || width + columns.size() > kMostColumns) {
      throw FileFault(line, fmt::format("has Properties with \"{}:{}:{}\"; must be name:type:columns, as pos:R:3",
                                        printable(name, 40), printable(type, 40), printable(width_text, 40)));
    }
    const auto* known = std::find_if(std::begin(kProperties), std::end(kProperties),
                                     [&](const Property& p) { return p.name == name && p.width == width; });
    for (std::size_t i = 0; i < width; ++i) {
      const Quantity quantity = known == std::end(kProperties)
                                    ? Quantity::unknown
                                    : static_cast<Quantity>(static_cast<std::size_t>(known->first) + i);
      columns.push_back({quantity, std::string(name)});
    }
  }
  // A species is a name, which is clearer than the number of a type.
  const auto has_species = std::any_of(columns.begin(), columns.end(), [](const Column& c) {
    return c.quantity == Quantity::material && c.title != "type";
  });
  for (Column& c : columns) {
    if (has_species && c.title == "type") c.quantity = Quantity::passed_over;
  }
  return columns;
}

// Lattice="ax ay az bx by bz cx cy cz" and pbc="T F T" of a comment; all axes are periodic where it names none.
std::optional<FileBox> box_of(std::string_view comment, std::uint64_t line) {
  std::vector<std::string_view> words;
  const std::string lattice = value_of("Lattice", comment);
  split_words(lattice, words);
  constexpr std::size_t kNumbers = 9;
  if (words.size() != kNumbers) return std::nullopt;
  FileBox box;
  box.line = line;
  for (std::size_t i = 0; i < kNumbers; ++i) {
    if (!read_number(words[i], component(box.edge[i / 3], static_cast<int>(i % 3)))) return std::nullopt;
  }
  const std::string periodic = value_of("pbc", comment);
  split_words(periodic, words);
  for (std::size_t axis = 0; axis < 3 && words.size() == 3; ++axis) {
    box.periodic[axis] = words[axis].front() != 'F' && words[axis].front() != 'f' && words[axis] != "0";
  }
  return box;
}

// Species, position, and any further columns of the first row.
std::vector<Column> plain_columns(std::size_t width) {
  std::vector<Column> columns{
      {Quantity::material, "species"}, {Quantity::x, "x"}, {Quantity::y, "y"}, {Quantity::z, "z"}};
  for (std::size_t i = columns.size(); i < std::min<std::size_t>(width, kMostColumns); ++i) {
    columns.push_back({Quantity::unknown, fmt::format("{}", i + 1)});
  }
  return columns;
}

// Reads the count at the start of a snapshot; nothing at the end of the file.
std::optional<std::uint64_t> read_head(FileScanner& in) {
  auto line = in.line();
  while (line && trimmed(*line).empty()) line = in.line();
  if (!line) return std::nullopt;
  std::uint64_t count = 0;
  if (!read_count(trimmed(*line), count)) {
    throw FileFault(in.line_number(), fmt::format("is \"{}\"; must be the number of particles of a snapshot",
                                                  printable(trimmed(*line), 40)));
  }
  return count;
}

}  // namespace

void read_xyz_particles(FileScanner& in, ParticleRows& rows) {
  go_to_frame(in, rows.rules().frame.value_or(0), [&in] {
    const auto count = read_head(in);
    if (count) in.line();  // the comment
    if (count) skip_rows(in, *count);
    return count.has_value();
  });
  const auto count = read_head(in);
  const std::string comment(in.line().value_or(""));
  const std::uint64_t comment_line = in.line_number();
  if (const auto box = box_of(comment, comment_line)) rows.set_box(*box);
  const std::string properties = value_of("Properties", comment);
  const FileScanner::Place start = in.place();
  std::vector<std::string_view> words;
  if (properties.empty()) split_words(in.line().value_or(""), words);
  in.go_back(start);

  rows.set_labels({"species", true, 1, {}});
  if (!rows.set_columns(properties.empty() ? plain_columns(words.size()) : columns_of(properties, comment_line),
                        comment_line)) {
    return;
  }
  if (!rows.expect(*count, in.remaining() / kSmallestRow + 1)) return;
  for (std::uint64_t i = 0; i < *count; ++i) {
    const auto line = in.line();
    if (!line) throw ends_early(in, i, *count);
    split_words(*line, words);
    Row row = rows.blank();
    if (rows.read(words, row, in.line_number())) rows.add(row, in.line_number());
  }
}

}  // namespace hooke::scene
