// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// PLY, as text or binary in either byte order: one particle per vertex. Other elements and colours are skipped.
// Materials are numbers from 0, and comments may name them: "comment material 0 water". PLY has no 64-bit integers: a
// property id_high holds the upper half of an id.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "hooke/scene/json_reader.h"
#include "hooke/scene/particle_format.h"
#include "hooke/scene/words.h"

namespace hooke {

namespace {

constexpr std::size_t kMostProperties = 4096;  // of all elements
constexpr std::uint64_t kSmallestRow = 6;      // as text: "0 0 0\n", bytes

enum class Type : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct TypeName {
  std::string_view name;
  Type type;
};
constexpr TypeName kTypes[] = {
    {"char", Type::int8},     {"int8", Type::int8},       {"uchar", Type::uint8},    {"uint8", Type::uint8},
    {"short", Type::int16},   {"int16", Type::int16},     {"ushort", Type::uint16},  {"uint16", Type::uint16},
    {"int", Type::int32},     {"int32", Type::int32},     {"uint", Type::uint32},    {"uint32", Type::uint32},
    {"float", Type::float32}, {"float32", Type::float32}, {"double", Type::float64}, {"float64", Type::float64},
};

constexpr std::size_t size_of(Type type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

struct PropertyName {
  std::string_view name;
  Field field;
};
constexpr PropertyName kNames[] = {
    {"x", Field::x},
    {"y", Field::y},
    {"z", Field::z},
    {"vx", Field::vx},
    {"vy", Field::vy},
    {"vz", Field::vz},
    {"velocity", Field::vx},  // a list of three
    {"velocity_x", Field::vx},
    {"velocity_y", Field::vy},
    {"velocity_z", Field::vz},
    {"radius", Field::radius},
    {"pscale", Field::radius},
    {"mass", Field::mass},
    {"id", Field::id},
    {"material", Field::material},
    {"red", Field::passed_over},
    {"green", Field::passed_over},
    {"blue", Field::passed_over},
    {"alpha", Field::passed_over},
};

struct Property {
  std::string name;
  Field field = Field::unknown;
  Type type = Type::float32;
  std::optional<Type> count;  // of a list: the type of its length; empty for a single value
  bool id_high = false;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  bool has_lists() const {
    return std::any_of(properties.begin(), properties.end(), [](const Property& p) { return p.count.has_value(); });
  }
  // Bytes of one entry; a list counts with its length only.
  std::size_t size() const {
    std::size_t all = 0;
    for (const Property& p : properties) all += size_of(p.count.value_or(p.type));
    return all;
  }
};

enum class Encoding { text, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
  MaterialLabels labels{"material", true, 0, {}};
};

class HeaderReader {
 public:
  explicit HeaderReader(FileScanner& in) : in_(in) {}

  Header read() {
    const auto magic = in_.line();
    if (!magic || trimmed(*magic) != "ply") throw FileFault(1, "is not \"ply\": it is no PLY file");
    bool has_format = false;
    while (true) {
      const auto line = in_.line();
      if (!line) refuse("ends within the header");
      std::string_view rest = *line;
      const std::string_view keyword = take_word(rest);
      if (keyword == "end_header") break;
      if (keyword == "format") {
        read_format(rest);
        has_format = true;
      } else if (keyword == "comment") {
        read_comment(rest);
      } else if (keyword == "element") {
        read_element(rest);
      } else if (keyword == "property") {
        read_property(rest);
      } else if (keyword != "obj_info" && !keyword.empty()) {
        refuse(fmt::format("starts with \"{}\", which is no keyword of a PLY header", printable(keyword, 40)));
      }
    }
    if (!has_format) refuse("ends a header that has no line \"format\"");
    return std::move(header_);
  }

 private:
  [[noreturn]] void refuse(const std::string& message) const { throw FileFault(in_.line_number(), message); }

  void read_format(std::string_view rest) {
    const std::string_view format = take_word(rest);
    const std::string_view version = take_word(rest);
    if (format == "ascii") {
      header_.encoding = Encoding::text;
    } else if (format == "binary_little_endian") {
      header_.encoding = Encoding::little_endian;
    } else if (format == "binary_big_endian") {
      header_.encoding = Encoding::big_endian;
    } else {
      refuse(fmt::format("has format \"{}\"; must be ascii, binary_little_endian or binary_big_endian",
                         printable(format, 40)));
    }
    if (version != "1.0") refuse(fmt::format("has version \"{}\"; must be 1.0", printable(version, 40)));
  }

  // "material NUMBER NAME"
  void read_comment(std::string_view rest) {
    std::uint64_t number = 0;
    if (take_word(rest) != "material" || !read_count(take_word(rest), number) || trimmed(rest).empty()) return;
    header_.labels.names[number] = trimmed(rest);
  }

  void read_element(std::string_view rest) {
    Element element;
    element.name = take_word(rest);
    const std::string_view count = take_word(rest);
    if (!read_count(count, element.count)) {
      refuse(fmt::format("has \"{}\" elements; must be a whole number", printable(count, 40)));
    }
    header_.elements.push_back(std::move(element));
  }

  Type read_type(std::string_view name) const {
    const auto* known =
        std::find_if(std::begin(kTypes), std::end(kTypes), [name](const TypeName& t) { return t.name == name; });
    if (known == std::end(kTypes)) {
      refuse(fmt::format("has type \"{}\"; must be char, uchar, short, ushort, int, uint, float or double",
                         printable(name, 40)));
    }
    return known->type;
  }

  void read_property(std::string_view rest) {
    if (header_.elements.empty()) refuse("is a property of no element");
    if (++properties_ > kMostProperties) refuse(fmt::format("is more than {} properties", kMostProperties));
    Property property;
    std::string_view type = take_word(rest);
    if (type == "list") {
      property.count = read_type(take_word(rest));
      if (*property.count >= Type::float32) refuse("has a list whose length is no whole number");
      type = take_word(rest);
    }
    property.type = read_type(type);
    property.name = take_word(rest);
    if (property.name.empty()) refuse("is a property without a name");
    const auto* known = std::find_if(std::begin(kNames), std::end(kNames),
                                     [&property](const PropertyName& n) { return n.name == property.name; });
    // The velocity is the only list that is used.
    if (known != std::end(kNames) && property.count.has_value() == (property.name == "velocity")) {
      property.field = known->field;
    }
    if (property.name == "id_high" && !property.count) {
      property.id_high = true;
      property.field = Field::passed_over;
    }
    header_.elements.back().properties.push_back(std::move(property));
  }

  FileScanner& in_;
  Header header_;
  std::size_t properties_ = 0;
};

// Values as text, one entry per line.
class TextValues {
 public:
  explicit TextValues(FileScanner& in) : in_(in) {}

  std::uint64_t place() const { return in_.line_number(); }
  std::uint64_t most_entries(const Element&) const { return in_.remaining() / kSmallestRow + 1; }
  bool skip(const Element& element) { return in_.skip_lines(element.count); }
  bool start() {
    auto line = in_.line();
    while (line && trimmed(*line).empty()) line = in_.line();
    rest_ = line.value_or("");
    return line.has_value();
  }
  std::optional<std::string_view> next(Type) {
    const std::string_view word = take_word(rest_);
    return word.empty() ? std::nullopt : std::optional(word);
  }
  bool at_end() const { return trimmed(rest_).empty(); }

 private:
  FileScanner& in_;
  std::string_view rest_;
};

class BinaryValues {
 public:
  BinaryValues(FileScanner& in, std::endian order) : in_(in), swap_(order != std::endian::native) {}

  std::uint64_t place() const { return place_; }
  std::uint64_t most_entries(const Element& element) const { return in_.remaining() / element.size(); }
  bool skip(const Element& element) {
    if (!element.has_lists()) {
      const std::size_t size = element.size();
      return size == 0 || (element.count <= in_.remaining() / size && in_.skip_bytes(element.count * size));
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const Property& p : element.properties) {
        const auto length = p.count ? next(*p.count) : std::optional(1.0);
        if (!length || *length < 0 || !in_.skip_bytes(static_cast<std::uint64_t>(*length) * size_of(p.type)))
          return false;
      }
    }
    return true;
  }
  bool start() {
    place_ = in_.offset();
    return in_.remaining() > 0;
  }
  std::optional<double> next(Type type) {
    const std::size_t size = size_of(type);
    const char* bytes = in_.bytes(size);
    if (bytes == nullptr) throw FileFault(place_, "ends within this particle");
    char value[8];
    std::copy_n(bytes, size, value);
    if (swap_) std::reverse(value, value + size);
    switch (type) {
      case Type::int8:
        return as<std::int8_t>(value);
      case Type::uint8:
        return as<std::uint8_t>(value);
      case Type::int16:
        return as<std::int16_t>(value);
      case Type::uint16:
        return as<std::uint16_t>(value);
      case Type::int32:
        return as<std::int32_t>(value);
      case Type::uint32:
        return as<std::uint32_t>(value);
      case Type::float32:
        return as<float>(value);
      case Type::float64:
        return as<double>(value);
    }
    return std::nullopt;
  }
  static bool at_end() { return true; }

 private:
  template <class T>
  static double as(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  }

  FileScanner& in_;
  bool swap_;
  std::uint64_t place_ = 0;
};

std::optional<std::uint64_t> whole(std::string_view text) {
  std::uint64_t value = 0;
  return read_count(text, value) ? std::optional(value) : std::nullopt;
}
std::optional<std::uint64_t> whole(double value) {
  return value >= 0 ? std::optional(static_cast<std::uint64_t>(value)) : std::nullopt;
}

// Reads one vertex. False, with findings, where it is not valid.
template <class Values>
bool read_vertex(const Element& vertex, Values& values, ParticleRows& rows, Row& row) {
  const std::uint64_t place = values.place();
  bool good = true;
  std::uint64_t id_high = 0;
  for (const Property& p : vertex.properties) {
    const auto missing = [&] {
      rows.complain(place, fmt::format("ends before {}", printable(p.name, 40)));
      return false;
    };
    std::uint64_t length = 1;
    if (p.count) {
      const auto written = values.next(*p.count);
      if (!written) return missing();
      const auto read = whole(*written);
      if (!read || (p.field == Field::vx && *read != 3)) {
        rows.complain(place, fmt::format("has a list {} of length {}; must be {}", printable(p.name, 40), *written,
                                         p.field == Field::vx ? "3" : "a whole number"));
        if (!read) throw FileFault(place, "can't be read on from there");
        good = false;
      }
      length = *read;
    }
    for (std::uint64_t i = 0; i < length; ++i) {
      const auto value = values.next(p.type);
      if (!value) return missing();
      if (p.id_high) {
        Row upper = rows.blank();
        good = rows.read(Field::id, p.name, *value, upper, place) && good;
        id_high = upper.id;
      } else if (p.field < Field::passed_over && i < 3) {
        const auto field = static_cast<Field>(static_cast<std::uint64_t>(p.field) + i);
        good = rows.read(field, p.name, *value, row, place) && good;
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

std::vector<Column> columns_of(const Element& vertex) {
  std::vector<Column> columns;
  for (const Property& p : vertex.properties) {
    columns.push_back({p.field, p.name});
    if (p.count && p.field == Field::vx) columns.insert(columns.end(), {{Field::vy, p.name}, {Field::vz, p.name}});
  }
  return columns;
}

template <class Values>
void read_body(const Header& header, std::size_t vertex_index, Values values, ParticleRows& rows) {
  for (std::size_t i = 0; i < vertex_index; ++i) {
    if (!values.skip(header.elements[i])) {
      throw FileFault(0, fmt::format("ends within the elements \"{}\"", printable(header.elements[i].name, 40)));
    }
  }
  const Element& vertex = header.elements[vertex_index];
  if (!rows.expect(vertex.count, values.most_entries(vertex))) return;
  for (std::uint64_t i = 0; i < vertex.count; ++i) {
    if (!values.start()) {
      throw FileFault(values.place(), fmt::format("ends here, after {} of {} particles", i, vertex.count));
    }
    Row row = rows.blank();
    if (read_vertex(vertex, values, rows, row)) rows.add(row, values.place());
  }
}

}  // namespace

void read_ply_particles(FileScanner& in, ParticleRows& rows) {
  const Header header = HeaderReader(in).read();
  const auto vertex =
      std::find_if(header.elements.begin(), header.elements.end(), [](const Element& e) { return e.name == "vertex"; });
  if (vertex == header.elements.end())
    throw FileFault(in.line_number(), "ends a header without the element \"vertex\"");
  rows.set_labels(header.labels);
  if (!rows.set_columns(columns_of(*vertex), in.line_number())) return;
  for (const Element& element : header.elements) {
    if (&element != &*vertex) rows.ignore(fmt::format("element {}", printable(element.name, 40)));
  }
  const auto index = static_cast<std::size_t>(vertex - header.elements.begin());
  if (header.encoding == Encoding::text) return read_body(header, index, TextValues(in), rows);
  rows.set_binary();
  const std::endian order = header.encoding == Encoding::little_endian ? std::endian::little : std::endian::big;
  read_body(header, index, BinaryValues(in, order), rows);
}

}  // namespace hooke
