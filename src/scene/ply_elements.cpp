// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/ply_elements.h"

#include <fmt/format.h>

#include <cstring>

#include "hooke/scene/json_reader.h"

namespace hooke::scene {
namespace {

constexpr std::size_t kMostProperties = 4096;  // of all elements
constexpr std::uint64_t kSmallestValue = 2;    // as text: "0 ", bytes

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr TypeName kTypes[] = {
    {"char", PlyType::int8},       {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},     {"short", PlyType::int16},     {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},   {"uint16", PlyType::uint16},   {"int", PlyType::int32},
    {"int32", PlyType::int32},     {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
    {"float", PlyType::float32},   {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64},
};

class HeaderReader {
 public:
  explicit HeaderReader(FileScanner& in) : in_(in) {}

  PlyHeader read() {
    const auto magic = in_.line();
    if (!magic || trimmed(*magic) != "ply") {
      throw FileFault(1, "is not \"ply\": it is no PLY file");
    }
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
        header_.comments.emplace_back(rest);
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
      header_.encoding = PlyEncoding::text;
    } else if (format == "binary_little_endian") {
      header_.encoding = PlyEncoding::little_endian;
    } else if (format == "binary_big_endian") {
      header_.encoding = PlyEncoding::big_endian;
    } else {
      refuse(fmt::format("has format \"{}\"; must be ascii, binary_little_endian or binary_big_endian",
                         printable(format, 40)));
    }
    if (version != "1.0") refuse(fmt::format("has version \"{}\"; must be 1.0", printable(version, 40)));
  }

  void read_element(std::string_view rest) {
    PlyElement element;
    element.name = take_word(rest);
    const std::string_view count = take_word(rest);
    if (!read_count(count, element.count)) {
      refuse(fmt::format("has \"{}\" elements; must be a whole number", printable(count, 40)));
    }
    header_.elements.push_back(std::move(element));
  }

  PlyType read_type(std::string_view name) const {
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
    PlyProperty property;
    std::string_view type = take_word(rest);
    if (type == "list") {
      property.count = read_type(take_word(rest));
      if (*property.count >= PlyType::float32) refuse("has a list whose length is no whole number");
      type = take_word(rest);
    }
    property.type = read_type(type);
    property.name = take_word(rest);
    if (property.name.empty()) refuse("is a property without a name");
    header_.elements.back().properties.push_back(std::move(property));
  }

  FileScanner& in_;
  PlyHeader header_;
  std::size_t properties_ = 0;
};

template <class T>
double as(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

// A value in this machine's order of bytes.
double value_of(PlyType type, const char* bytes) {
  switch (type) {
    case PlyType::int8:
      return as<std::int8_t>(bytes);
    case PlyType::uint8:
      return as<std::uint8_t>(bytes);
    case PlyType::int16:
      return as<std::int16_t>(bytes);
    case PlyType::uint16:
      return as<std::uint16_t>(bytes);
    case PlyType::int32:
      return as<std::int32_t>(bytes);
    case PlyType::uint32:
      return as<std::uint32_t>(bytes);
    case PlyType::float32:
      return as<float>(bytes);
    case PlyType::float64:
      break;
  }
  return as<double>(bytes);
}

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.count.has_value(); });
}

std::size_t PlyElement::size() const {
  std::size_t all = 0;
  for (const PlyProperty& p : properties) all += size_of(p.count.value_or(p.type));
  return all;
}

std::size_t PlyElement::find(std::string_view wanted) const {
  const auto found =
      std::find_if(properties.begin(), properties.end(), [&](const PlyProperty& p) { return p.name == wanted; });
  return static_cast<std::size_t>(found - properties.begin());
}

std::size_t PlyHeader::element(std::string_view wanted, const FileScanner& in) const {
  const auto found =
      std::find_if(elements.begin(), elements.end(), [&](const PlyElement& e) { return e.name == wanted; });
  if (found == elements.end()) {
    throw FileFault(in.line_number(), fmt::format("ends a header without the element \"{}\"", wanted));
  }
  return static_cast<std::size_t>(found - elements.begin());
}

PlyHeader read_ply_header(FileScanner& in) { return HeaderReader(in).read(); }

std::uint64_t PlyTextValues::most_entries(const PlyElement& element) const {
  const std::uint64_t smallest = kSmallestValue * std::max<std::size_t>(1, element.properties.size());
  return in_.remaining() / smallest + 1;
}

bool PlyTextValues::start() {
  auto line = in_.line();
  while (line && trimmed(*line).empty()) line = in_.line();
  rest_ = line.value_or("");
  return line.has_value();
}

std::optional<std::string_view> PlyTextValues::next(PlyType) {
  const std::string_view word = take_word(rest_);
  return word.empty() ? std::nullopt : std::optional(word);
}

PlyBinaryValues::PlyBinaryValues(FileScanner& in, PlyEncoding encoding, std::string entry)
    : in_(in),
      swap_((encoding == PlyEncoding::little_endian) != (std::endian::native == std::endian::little)),
      entry_(std::move(entry)) {}

std::uint64_t PlyBinaryValues::most_entries(const PlyElement& element) const {
  return in_.remaining() / std::max<std::size_t>(1, element.size());
}

bool PlyBinaryValues::skip(const PlyElement& element) {
  if (!element.has_lists()) {
    const std::size_t size = element.size();
    return size == 0 || (element.count <= in_.remaining() / size && in_.skip_bytes(element.count * size));
  }
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& p : element.properties) {
      if (in_.remaining() == 0) return false;
      const auto length = p.count ? next(*p.count) : std::optional(1.0);
      if (*length < 0 || !in_.skip_bytes(static_cast<std::uint64_t>(*length) * size_of(p.type))) return false;
    }
  }
  return true;
}

bool PlyBinaryValues::start() {
  place_ = in_.offset();
  return in_.remaining() > 0;
}

std::optional<double> PlyBinaryValues::next(PlyType type) {
  const std::size_t size = size_of(type);
  const char* bytes = in_.bytes(size);
  if (bytes == nullptr) throw FileFault(place_, "ends within this " + entry_);
  char value[8];
  std::copy_n(bytes, size, value);
  if (swap_) std::reverse(value, value + size);
  return value_of(type, value);
}

template <class Values>
void skip_elements(const PlyHeader& header, std::size_t first, std::size_t end, Values& values) {
  for (std::size_t i = first; i < end; ++i) {
    if (!values.skip(header.elements[i])) {
      throw FileFault(0, fmt::format("ends within the elements \"{}\"", printable(header.elements[i].name, 40)));
    }
  }
}

template void skip_elements(const PlyHeader&, std::size_t, std::size_t, PlyTextValues&);
template void skip_elements(const PlyHeader&, std::size_t, std::size_t, PlyBinaryValues&);

}  // namespace hooke::scene
