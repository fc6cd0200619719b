// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// LAMMPS dump, as text: snapshots one after the other, each of items ("ITEM: BOX BOUNDS pp pp ff"). The last item names
// the columns and holds one row per atom. The last snapshot is read unless another is asked for.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "hooke/physics/periodic.h"
#include "hooke/scene/json_reader.h"
#include "hooke/scene/particle_format.h"
#include "hooke/scene/words.h"

namespace hooke::scene {

namespace {

constexpr std::uint64_t kSmallestRow = 6;  // "0 0 0\n", bytes

struct Head {
  std::optional<std::uint64_t> count;
  std::optional<FileBox> box;
  std::array<std::array<double, 2>, 3> bounds{};  // of each axis, m; of a tilted box they are not its faces
  bool tilted = false;  // it is written as a tilted box is, whose tilts may be 0
  std::vector<std::string> titles;
};

struct Title {
  std::string_view name;
  Quantity quantity;
  bool scaled = false;
};
// Where a file has several columns for a quantity, the first in this list is used.
constexpr Title kTitles[] = {
    {"x", Quantity::x},
    {"y", Quantity::y},
    {"z", Quantity::z},
    {"xu", Quantity::x},
    {"yu", Quantity::y},
    {"zu", Quantity::z},
    {"xs", Quantity::x, true},
    {"ys", Quantity::y, true},
    {"zs", Quantity::z, true},
    {"xsu", Quantity::x, true},
    {"ysu", Quantity::y, true},
    {"zsu", Quantity::z, true},
    {"vx", Quantity::vx},
    {"vy", Quantity::vy},
    {"vz", Quantity::vz},
    {"id", Quantity::id},
    {"element", Quantity::material},
    {"type", Quantity::material},
    {"radius", Quantity::radius},
    {"diameter", Quantity::radius},
    {"mass", Quantity::mass},
};
const Title* known_title(std::string_view name) {
  const auto* found =
      std::find_if(std::begin(kTitles), std::end(kTitles), [name](const Title& t) { return t.name == name; });
  return found == std::end(kTitles) ? nullptr : found;
}

std::string_view need_line(FileScanner& in) {
  const auto line = in.line();
  if (!line) throw FileFault(in.line_number(), "ends within the head of a snapshot");
  return trimmed(*line);
}

// Reads the numbers of one line of BOX BOUNDS.
template <std::size_t kCount>
std::array<double, kCount> read_bounds(FileScanner& in) {
  std::string_view text = need_line(in);
  const std::string_view written = text;
  std::array<double, kCount> bounds{};
  for (double& bound : bounds) {
    if (read_number(take_word(text), bound)) continue;
    throw FileFault(in.line_number(), fmt::format("is \"{}\"; must be the bounds of the box", printable(written, 40)));
  }
  return bounds;
}

// A lower and an upper bound; of a box that may be tilted they enclose it, and its tilt follows: xy, xz, yz.
void read_axis(FileScanner& in, bool with_tilt, std::size_t axis, Head& head) {
  FileBox& box = *head.box;
  double low = 0, high = 0;
  if (with_tilt) {
    double& tilt = component(box.edge[axis == 0 ? 1 : 2], axis == 2 ? 1 : 0);
    std::tie(low, high, tilt) = std::tuple_cat(read_bounds<3>(in));
  } else {
    std::tie(low, high) = std::tuple_cat(read_bounds<2>(in));
  }
  component(box.edge[axis], static_cast<int>(axis)) = high - low;
  head.bounds[axis] = {low, high};
}

// An edge, and a number of the lower corner.
void read_edge(FileScanner& in, std::size_t axis, Head& head) {
  const auto [x, y, z, low] = read_bounds<4>(in);
  Vec3d& edge = head.box->edge[axis];
  edge = {x, y, z};
  head.bounds[axis] = {low, low + component(edge, static_cast<int>(axis))};
}

// "BOUNDS", then "xy xz yz" or "abc origin" where the box may be tilted, then one word an axis, "pp" where it is
// periodic; and a line an axis.
void read_box(FileScanner& in, std::string_view item, Head& head) {
  take_word(item);
  const bool edges = item.find("abc") != std::string_view::npos, tilts = item.find("xy") != std::string_view::npos;
  head.tilted = edges || tilts;
  for (int k = edges ? 2 : tilts ? 3 : 0; k > 0; --k) take_word(item);
  FileBox& box = head.box.emplace();
  box.line = in.line_number();
  for (bool& periodic : box.periodic) periodic = take_word(item) == "pp";
  for (std::size_t axis = 0; axis < 3; ++axis) edges ? read_edge(in, axis, head) : read_axis(in, tilts, axis, head);
}

// Reads the head of a snapshot, down to the names of its columns; nothing at the end of the file.
std::optional<Head> read_head(FileScanner& in) {
  constexpr std::string_view kItem = "ITEM: ";
  auto first = in.line();
  while (first && trimmed(*first).empty()) first = in.line();
  if (!first) return std::nullopt;
  if (first->substr(0, kItem.size()) != kItem) {
    throw FileFault(in.line_number(),
                    fmt::format("is \"{}\"; a snapshot must start with \"ITEM: \"", printable(*first, 40)));
  }
  Head head;
  for (std::string_view line = *first;; line = need_line(in)) {
    if (line.substr(0, kItem.size()) != kItem) continue;  // of an item that is not used
    std::string_view item = line.substr(kItem.size());
    const std::string_view word = take_word(item);
    if (word == "NUMBER") {
      std::uint64_t count = 0;
      const std::string_view text = need_line(in);
      if (!read_count(text, count)) {
        throw FileFault(in.line_number(), fmt::format("is \"{}\"; must be the number of atoms", printable(text, 40)));
      }
      head.count = count;
    } else if (word == "BOX") {
      read_box(in, item, head);
    } else if (word == "ATOMS") {
      if (!head.count) throw FileFault(in.line_number(), "comes before the item \"NUMBER OF ATOMS\"");
      for (auto title = take_word(item); !title.empty(); title = take_word(item)) head.titles.emplace_back(title);
      return head;
    }
  }
}

// Uses the best title of each quantity and skips the others.
std::vector<Column> columns_of(const std::vector<std::string>& titles) {
  std::array<const Title*, static_cast<std::size_t>(Quantity::passed_over)> best{};
  for (const std::string& title : titles) {
    const Title* known = known_title(title);
    if (known == nullptr) continue;
    const Title*& of_quantity = best[static_cast<std::size_t>(known->quantity)];
    if (of_quantity == nullptr || known < of_quantity) of_quantity = known;
  }
  std::vector<Column> columns;
  for (const std::string& title : titles) {
    const Title* known = known_title(title);
    const Quantity quantity = known == nullptr                                           ? Quantity::unknown
                              : known == best[static_cast<std::size_t>(known->quantity)] ? known->quantity
                                                                                         : Quantity::passed_over;
    columns.push_back({quantity, title});
  }
  return columns;
}

// Converts scaled positions and diameters to positions and radii. Between two neighbour lists LAMMPS lets particles
// leave through a periodic face and writes them there: they are brought back into its box.
struct Conversion {
  std::array<bool, 3> scaled{};
  bool diameter = false;

  Conversion(const std::vector<Column>& columns, const Head& head, std::uint64_t line) {
    for (const Column& column : columns) {
      const Title* title = known_title(column.title);
      if (title == nullptr || column.quantity == Quantity::passed_over) continue;
      if (title->scaled) scaled[static_cast<std::size_t>(title->quantity)] = true;
      if (title->name == "diameter") diameter = true;
      if (!title->scaled || (head.box && !head.tilted)) continue;
      throw FileFault(line, fmt::format("has scaled positions (\"{}\"), {}", column.title,
                                        head.box ? "which are not read in a tilted box" : "but no BOX BOUNDS before"));
    }
  }

  // False, with a finding, where a position is not finite.
  bool apply(const Head& head, ParticleRows& rows, Row& row, std::uint64_t line) const {
    bool good = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto quantity = static_cast<Quantity>(axis);
      const auto& [low, high] = head.bounds[axis];
      if (scaled[axis]) {
        good = rows.read(quantity, kTitles[axis].name, low + row[quantity] * (high - low), row, line) && good;
      }
      const bool periodic = head.box && head.box->periodic[axis] && !head.tilted;
      if (periodic && low < high) row[quantity] = wrap_coordinate(row[quantity], low, high);
    }
    if (diameter) row[Quantity::radius] /= 2;
    return good;
  }
};

}  // namespace

void read_lammps_dump(FileScanner& in, ParticleRows& rows) {
  go_to_frame(in, rows.rules().frame.value_or(kLastFrame), [&in] {
    const auto head = read_head(in);
    if (head) skip_rows(in, *head->count);
    return head.has_value();
  });
  const Head head = read_head(in).value();
  if (head.box) rows.set_box(*head.box);
  const std::vector<Column> columns = columns_of(head.titles);
  const Conversion conversion(columns, head, in.line_number());
  rows.set_labels({"type", true, 1, {}});
  if (!rows.set_columns(columns, in.line_number())) return;
  if (!rows.expect(*head.count, in.remaining() / kSmallestRow + 1)) return;
  std::vector<std::string_view> words;
  for (std::uint64_t i = 0; i < *head.count; ++i) {
    const auto line = in.line();
    if (!line) throw ends_early(in, i, *head.count);
    split_words(*line, words);
    Row row = rows.blank();
    const bool good = rows.read(words, row, in.line_number());
    if (good && conversion.apply(head, rows, row, in.line_number())) rows.add(row, in.line_number());
  }
}

}  // namespace hooke::scene
