// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// PLY, as text or binary in either byte order: one particle per vertex. Other elements and colours are skipped.
// Materials are numbers from 0, and comments may name them: "comment material 0 water". PLY has no 64-bit integers: a
// property id_high holds the upper half of an id.
#include <fmt/format.h>

#include <algorithm>

#include "hooke/scene/json_reader.h"
#include "hooke/scene/particle_format.h"
#include "hooke/scene/ply_elements.h"
#include "hooke/scene/words.h"

namespace hooke::scene {

namespace {

struct PropertyName {
  std::string_view name;
  Quantity quantity;
};
constexpr PropertyName kNames[] = {
    {"x", Quantity::x},
    {"y", Quantity::y},
    {"z", Quantity::z},
    {"vx", Quantity::vx},
    {"vy", Quantity::vy},
    {"vz", Quantity::vz},
    {"velocity", Quantity::vx},  // a list of three
    {"velocity_x", Quantity::vx},
    {"velocity_y", Quantity::vy},
    {"velocity_z", Quantity::vz},
    {"radius", Quantity::radius},
    {"pscale", Quantity::radius},
    {"mass", Quantity::mass},
    {"id", Quantity::id},
    {"material", Quantity::material},
    {"red", Quantity::passed_over},
    {"green", Quantity::passed_over},
    {"blue", Quantity::passed_over},
    {"alpha", Quantity::passed_over},
};

struct Property {
  PlyProperty ply;
  Quantity quantity = Quantity::unknown;
  bool id_high = false;
};

Property meaning_of(PlyProperty ply) {
  Property property{std::move(ply), Quantity::unknown, false};
  const auto* known = std::find_if(std::begin(kNames), std::end(kNames),
                                   [&property](const PropertyName& n) { return n.name == property.ply.name; });
  // The velocity is the only list that is used.
  if (known != std::end(kNames) && property.ply.count.has_value() == (property.ply.name == "velocity")) {
    property.quantity = known->quantity;
  }
  if (property.ply.name == "id_high" && !property.ply.count) {
    property.id_high = true;
    property.quantity = Quantity::passed_over;
  }
  return property;
}

using Properties = std::vector<Property>;

Properties properties_of(const PlyElement& vertex) {
  Properties properties;
  for (const PlyProperty& p : vertex.properties) properties.push_back(meaning_of(p));
  return properties;
}

// The comments "material NUMBER NAME".
MaterialLabels labels_of(const PlyHeader& header) {
  MaterialLabels labels{"material", true, 0, {}};
  for (std::string_view rest : header.comments) {
    std::uint64_t number = 0;
    if (take_word(rest) != "material" || !read_count(take_word(rest), number) || trimmed(rest).empty()) continue;
    labels.names[number] = trimmed(rest);
  }
  return labels;
}

std::optional<std::uint64_t> whole(std::string_view text) {
  std::uint64_t value = 0;
  return read_count(text, value) ? std::optional(value) : std::nullopt;
}
std::optional<std::uint64_t> whole(double value) {
  return value >= 0 ? std::optional(static_cast<std::uint64_t>(value)) : std::nullopt;
}

// Reads one vertex. False, with findings, where it is not valid.
template <class Values>
bool read_vertex(const Properties& vertex, Values& values, ParticleRows& rows, Row& row) {
  const std::uint64_t place = values.place();
  bool good = true;
  std::uint64_t id_high = 0;
  for (const Property& p : vertex) {
    const std::string& name = p.ply.name;
    const auto missing = [&] {
      rows.complain(place, fmt::format("ends before {}", printable(name, 40)));
      return false;
    };
    std::uint64_t length = 1;
    if (p.ply.count) {
      const auto written = values.next(*p.ply.count);
      if (!written) return missing();
      const auto read = whole(*written);
      if (!read || (p.quantity == Quantity::vx && *read != 3)) {
        rows.complain(place, fmt::format("has a list {} of length {}; must be {}", printable(name, 40), *written,
                                         p.quantity == Quantity::vx ? "3" : "a whole number"));
        if (!read) throw FileFault(place, "can't be read on from there");
        good = false;
      }
      length = *read;
    }
    for (std::uint64_t i = 0; i < length; ++i) {
      const auto value = values.next(p.ply.type);
      if (!value) return missing();
      if (p.id_high) {
        Row upper = rows.blank();
        good = rows.read(Quantity::id, name, *value, upper, place) && good;
        id_high = upper.id;
      } else if (p.quantity < Quantity::passed_over && i < 3) {
        const auto quantity = static_cast<Quantity>(static_cast<std::uint64_t>(p.quantity) + i);
        good = rows.read(quantity, name, *value, row, place) && good;
      }
    }
  }
  if (!values.at_end()) {
    rows.complain(place, "has more values than the header has properties");
    good = false;
  }
  constexpr std::uint64_t kMostHigh = 0x7ffffffe;
  if (id_high > kMostHigh || row.id > 0xffffffff) {
    rows.complain(place, fmt::format("id_high is {}; must be a whole number up to {}", id_high, kMostHigh));
    good = false;
  }
  row.id += id_high << 32U;
  return good;
}

std::vector<Column> columns_of(const Properties& vertex) {
  std::vector<Column> columns;
  for (const Property& p : vertex) {
    const std::string& name = p.ply.name;
    columns.push_back({p.quantity, name});
    if (p.ply.count && p.quantity == Quantity::vx)
      columns.insert(columns.end(), {{Quantity::vy, name}, {Quantity::vz, name}});
  }
  return columns;
}

template <class Values>
void read_body(const PlyHeader& header, std::size_t vertex_index, Values values, ParticleRows& rows) {
  skip_elements(header, 0, vertex_index, values);
  const PlyElement& vertex = header.elements[vertex_index];
  const Properties properties = properties_of(vertex);
  if (!rows.expect(vertex.count, values.most_entries(vertex))) return;
  for (std::uint64_t i = 0; i < vertex.count; ++i) {
    if (!values.start()) {
      throw FileFault(values.place(), fmt::format("ends here, after {} of {} particles", i, vertex.count));
    }
    Row row = rows.blank();
    if (read_vertex(properties, values, rows, row)) rows.add(row, values.place());
  }
}

}  // namespace

void read_ply_particles(FileScanner& in, ParticleRows& rows) {
  const PlyHeader header = read_ply_header(in);
  const std::size_t index = header.element("vertex", in);
  rows.set_labels(labels_of(header));
  if (!rows.set_columns(columns_of(properties_of(header.elements[index])), in.line_number())) return;
  for (std::size_t i = 0; i < header.elements.size(); ++i) {
    if (i != index) rows.ignore(fmt::format("element {}", printable(header.elements[i].name, 40)));
  }
  if (header.encoding == PlyEncoding::text) return read_body(header, index, PlyTextValues(in), rows);
  rows.set_binary();
  read_body(header, index, PlyBinaryValues(in, header.encoding, "particle"), rows);
}

}  // namespace hooke::scene
