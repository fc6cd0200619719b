// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// LAMMPS data file: a head of counts and bounds, then sections. "Atoms # sphere" names the style, which determines the
// columns. Names of types come from the section Atom Type Labels, from comments in the section Masses ("1 18.0 #
// water"), or from comments of the head ("# type 1 water").
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numbers>

#include "hooke/scene/json_reader.h"
#include "hooke/scene/particle_format.h"
#include "hooke/scene/spelling.h"
#include "hooke/scene/words.h"

namespace hooke::scene {

namespace {

constexpr std::uint64_t kSmallestRow = 10;  // "1 1 0 0 0\n", bytes

// The file gives a sphere's diameter and density; they stand for its radius and mass.
const Column kId{Quantity::id, "id"}, kType{Quantity::material, "type"}, kX{Quantity::x, "x"}, kY{Quantity::y, "y"},
    kZ{Quantity::z, "z"}, kDiameter{Quantity::radius, "diameter"}, kDensity{Quantity::mass, "density"},
    kOther{Quantity::passed_over, ""};

struct Style {
  std::string name;
  std::vector<Column> columns;
};
const std::vector<Style>& styles() {
  static const std::vector<Style> all{
      {"sphere", {kId, kType, kDiameter, kDensity, kX, kY, kZ}},
      {"atomic", {kId, kType, kX, kY, kZ}},
      {"charge", {kId, kType, kOther, kX, kY, kZ}},
      {"molecular", {kId, kOther, kType, kX, kY, kZ}},
      {"full", {kId, kOther, kType, kOther, kX, kY, kZ}},
  };
  return all;
}

class DataReader {
 public:
  DataReader(FileScanner& in, ParticleRows& rows) : in_(in), rows_(rows) {}

  void read() {
    if (!in_.line()) throw FileFault(0, "is empty");  // a title
    while (!done_) {
      const auto line = in_.line();
      if (!line) break;
      const auto hash = std::min(line->find('#'), line->size());
      read_line(trimmed(line->substr(0, hash)), trimmed(line->substr(std::min(hash + 1, line->size()))));
    }
    if (done_) return;
    if (!count_) throw FileFault(0, "has no line \"N atoms\": it is no LAMMPS data file");
    if (atoms_ < *count_) throw ends_early(in_, atoms_, *count_);
  }

 private:
  enum class Section { head, masses, labels, atoms, velocities, other };

  void read_line(std::string_view text, std::string_view comment) {
    if (text.empty()) {
      if (section_ == Section::head && take_word(comment) == "type") read_name(comment);
      return;
    }
    if (std::isalpha(static_cast<unsigned char>(text.front())) != 0) return start_section(text, comment);
    split_words(text, words_);
    switch (section_) {
      case Section::head:
        if (words_.size() == 2 && words_[1] == "atoms") read_atom_count();
        if (words_.size() >= 4) read_box();
        break;
      case Section::masses:
        if (!comment.empty()) name_type(words_[0], comment);
        break;
      case Section::labels:
        read_name(text);
        break;
      case Section::atoms:
        read_atom();
        break;
      case Section::velocities:
        read_velocity();
        break;
      case Section::other:
        break;
    }
  }

  void start_section(std::string_view text, std::string_view comment) {
    // A section ends where the next begins.
    if (section_ == Section::atoms && atoms_ < *count_) {
      throw FileFault(in_.line_number(), fmt::format("comes after {} of {} atoms", atoms_, *count_));
    }
    section_ = text == "Masses"             ? Section::masses
               : text == "Atom Type Labels" ? Section::labels
               : text == "Atoms"            ? Section::atoms
               : text == "Velocities"       ? Section::velocities
                                            : Section::other;
    if (section_ != Section::atoms) return;
    if (!count_) throw FileFault(in_.line_number(), "comes before the line \"N atoms\"");
    if (atoms_ > 0) throw FileFault(in_.line_number(), "is the second section Atoms");
    style_ = std::string(comment);
  }

  void read_atom_count() {
    std::uint64_t count = 0;
    if (!read_count(words_[0], count)) {
      throw FileFault(in_.line_number(),
                      fmt::format("is \"{}\"; must be the number of atoms", printable(words_[0], 40)));
    }
    count_ = count;
  }

  // "0 4 xlo xhi"; of a tilted box "1.0 0.5 0.0 xy xz yz", or its edges, "4 0 0 avec".
  void read_box() {
    struct Line {
      std::vector<std::string_view> keys;
      std::vector<std::pair<std::size_t, int>> places;  // edge and component of each number
    };
    static const std::vector<Line> lines{{{"xy", "xz", "yz"}, {{1, 0}, {2, 0}, {2, 1}}},
                                         {{"avec"}, {{0, 0}, {0, 1}, {0, 2}}},
                                         {{"bvec"}, {{1, 0}, {1, 1}, {1, 2}}},
                                         {{"cvec"}, {{2, 0}, {2, 1}, {2, 2}}}};
    constexpr std::string_view kBounds[] = {"xlo", "ylo", "zlo"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double low = 0, high = 0;
      if (words_[2] != kBounds[axis] || !read_number(words_[0], low) || !read_number(words_[1], high)) continue;
      set_edge(axis, static_cast<int>(axis), high - low);
    }
    for (const Line& line : lines) {
      const std::size_t count = line.places.size();
      if (words_.size() != count + line.keys.size() ||
          !std::equal(line.keys.begin(), line.keys.end(), words_.begin() + static_cast<std::ptrdiff_t>(count))) {
        continue;
      }
      for (std::size_t k = 0; k < count; ++k) {
        double value = 0;
        if (read_number(words_[k], value)) set_edge(line.places[k].first, line.places[k].second, value);
      }
    }
  }

  // Findings name the line that says that it is tilted, or else where it begins.
  void set_edge(std::size_t edge, int axis, double value) {
    if (!box_) box_.emplace().line = in_.line_number();
    const bool was_tilted = box_->is_tilted();
    component(box_->edge[edge], axis) = value;
    if (!was_tilted && box_->is_tilted()) box_->line = in_.line_number();
  }

  void read_name(std::string_view text) {
    const std::string_view number = take_word(text);
    name_type(number, trimmed(text));
  }

  void name_type(std::string_view number, std::string_view name) {
    std::uint64_t type = 0;
    if (read_count(number, type) && !name.empty()) labels_.names[type] = name;
  }

  // Without a named style, the number of columns is the only clue.
  void choose_style() {
    constexpr std::size_t kAtomic = 5;
    if (style_.empty() && (words_.size() == kAtomic || words_.size() == kAtomic + kImageFlags)) style_ = "atomic";
    std::vector<std::string> known;
    for (const Style& style : styles()) {
      known.push_back(style.name);
      if (style.name == style_) columns_ = style.columns;
    }
    if (columns_.empty()) {
      throw FileFault(in_.line_number(),
                      fmt::format("is of atom style \"{}\"; the section must be headed \"Atoms # STYLE\", of {}",
                                  printable(style_, 40), quoted_list(known)));
    }
    if (box_) rows_.set_box(*box_);
    rows_.set_labels(labels_);
    const bool usable = rows_.set_columns(columns_, in_.line_number());
    done_ = !usable || !rows_.expect(*count_, in_.remaining() / kSmallestRow + 2);
  }

  void read_atom() {
    if (columns_.empty()) choose_style();
    if (done_) return;
    if (atoms_++ == *count_) {
      throw FileFault(in_.line_number(), fmt::format("is more than the {} atoms of the head", *count_));
    }
    std::span<const std::string_view> values = words_;
    if (values.size() == columns_.size() + kImageFlags) values = values.first(columns_.size());
    Row row = rows_.blank();
    if (!rows_.read(values, row, in_.line_number())) return;
    if (style_ == "sphere") {
      const double diameter = row[Quantity::radius];
      row[Quantity::radius] = diameter / 2;
      row[Quantity::mass] *= std::numbers::pi / 6 * diameter * diameter * diameter;
    }
    rows_.add(row, in_.line_number());
  }

  // "id vx vy vz"; spheres have three more numbers, their spin.
  void read_velocity() {
    const std::uint64_t line = in_.line_number();
    if (words_.size() != 4 && words_.size() != 7) {
      return rows_.complain(line, fmt::format("has {} fields; a velocity is id vx vy vz", words_.size()));
    }
    Row row = rows_.blank();
    bool good = rows_.read(Quantity::id, "id", words_[0], row, line);
    good = rows_.read(Quantity::vx, "vx", words_[1], row, line) && good;
    good = rows_.read(Quantity::vy, "vy", words_[2], row, line) && good;
    good = rows_.read(Quantity::vz, "vz", words_[3], row, line) && good;
    if (good) rows_.set_velocity(row.id, {row[Quantity::vx], row[Quantity::vy], row[Quantity::vz]}, line);
  }

  static constexpr std::size_t kImageFlags = 3;  // columns that may follow: how often an atom went around

  FileScanner& in_;
  ParticleRows& rows_;
  Section section_ = Section::head;
  std::optional<std::uint64_t> count_;
  std::optional<FileBox> box_;
  std::uint64_t atoms_ = 0;
  std::string style_;
  std::vector<Column> columns_;
  MaterialLabels labels_{"type", true, 1, {}};
  std::vector<std::string_view> words_;
  bool done_ = false;
};

}  // namespace

void read_lammps_data(FileScanner& in, ParticleRows& rows) { DataReader(in, rows).read(); }

}  // namespace hooke::scene
