// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// PLY: the places of the elements "vertex" and the lists "vertex_indices" of the elements "face"; all others are
// skipped.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "hooke/scene/json_reader.h"
#include "hooke/scene/ply_elements.h"
#include "hooke/scene/polygon_mesh.h"

namespace hooke::scene {
namespace {

std::optional<double> number(std::string_view text) {
  double value = 0;
  return read_number(text, value) ? std::optional(value) : std::nullopt;
}
std::optional<double> number(double value) { return std::isfinite(value) ? std::optional(value) : std::nullopt; }

std::string shown(std::string_view text) { return printable(text, 40); }
double shown(double value) { return value; }

template <class Values>
class PlyMeshReader {
 public:
  PlyMeshReader(const PlyHeader& header, const FileScanner& in, Values values, PolygonMesh& mesh)
      : header_(header),
        values_(std::move(values)),
        mesh_(mesh),
        vertex_(header.element("vertex", in)),
        face_(header.element("face", in)) {
    const PlyElement &vertex = header.elements[vertex_], &face = header.elements[face_];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      places_[axis] = find_property(vertex, {std::string_view(&"xyz"[axis], 1)}, false, in);
    }
    indices_ = find_property(face, {"vertex_indices", "vertex_index"}, true, in);
    if (vertex.count > kMostVertices)
      throw FileFault(0, fmt::format("states {} vertices; at most {} are possible", vertex.count, kMostVertices));
  }

  void read() {
    for (std::size_t i = 0; i <= std::max(vertex_, face_); ++i) {
      if (i == vertex_) {
        read_entries([this] { read_vertex(); }, i);
      } else if (i == face_) {
        read_entries([this] { read_face(); }, i);
      } else {
        skip_elements(header_, i, i + 1, values_);
      }
    }
  }

 private:
  static std::size_t find_property(const PlyElement& element, std::initializer_list<std::string_view> names, bool list,
                                   const FileScanner& in) {
    for (const std::string_view name : names) {
      const std::size_t index = element.find(name);
      if (index < element.properties.size() && element.properties[index].count.has_value() == list) return index;
    }
    throw FileFault(in.line_number(), fmt::format("ends a header whose element \"{}\" has no {} \"{}\"", element.name,
                                                  list ? "list" : "property", *names.begin()));
  }

  [[noreturn]] void refuse(const std::string& message) const { throw FileFault(values_.place(), message); }

  template <class Read>
  void read_entries(const Read& read, std::size_t index) {
    const PlyElement& element = header_.elements[index];
    const std::uint64_t most = std::min(element.count, values_.most_entries(element));
    (index == vertex_ ? mesh_.vertices.reserve(most) : mesh_.ends.reserve(most));
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!values_.start())
        refuse(fmt::format("ends here, after {} of {} elements \"{}\"", i, element.count, element.name));
      read();
    }
  }

  auto next(const PlyProperty& property, PlyType type) {
    const auto value = values_.next(type);
    if (!value) refuse(fmt::format("ends before {}", printable(property.name, 40)));
    return *value;
  }

  std::uint64_t length_of(const PlyProperty& property) {
    const auto written = next(property, *property.count);
    const auto length = number(written);
    if (!length || !(*length >= 0) || *length != std::floor(*length) || *length > static_cast<double>(kMostVertices)) {
      refuse(fmt::format("has a list {} of length {}; must be a whole number", printable(property.name, 40),
                         shown(written)));
    }
    return static_cast<std::uint64_t>(*length);
  }

  void pass(const PlyProperty& property) {
    const std::uint64_t length = property.count ? length_of(property) : 1;
    for (std::uint64_t i = 0; i < length; ++i) next(property, property.type);
  }

  void read_vertex() {
    Vec3d x{0, 0, 0};
    const std::vector<PlyProperty>& properties = header_.elements[vertex_].properties;
    for (std::size_t p = 0; p < properties.size(); ++p) {
      const auto axis = static_cast<int>(std::find(places_.begin(), places_.end(), p) - places_.begin());
      if (axis == 3) {
        pass(properties[p]);
        continue;
      }
      const auto written = next(properties[p], properties[p].type);
      const auto value = number(written);
      if (!value) refuse(fmt::format("has {} = {}; must be a finite number", properties[p].name, shown(written)));
      component(x, axis) = *value;
    }
    end_entry();
    mesh_.vertices.push_back(x);
  }

  void read_face() {
    const std::vector<PlyProperty>& properties = header_.elements[face_].properties;
    for (std::size_t p = 0; p < properties.size(); ++p) {
      if (p == indices_) {
        read_indices(properties[p]);
      } else {
        pass(properties[p]);
      }
    }
    end_entry();
  }

  void read_indices(const PlyProperty& property) {
    const std::uint64_t length = length_of(property), count = header_.elements[vertex_].count;
    const std::size_t begin = mesh_.corners.size();
    for (std::uint64_t i = 0; i < length; ++i) {
      const auto written = next(property, property.type);
      const auto index = number(written);
      if (!index || !(*index >= 0 && *index < static_cast<double>(count)) || *index != std::floor(*index)) {
        refuse(fmt::format("names the vertex {}; the {} vertices have the numbers from 0", shown(written), count));
      }
      mesh_.corners.push_back(static_cast<std::uint32_t>(*index));
    }
    if (length >= 3) {
      mesh_.ends.push_back(mesh_.corners.size());
    } else {
      mesh_.corners.resize(begin);  // a point or a line
    }
  }

  void end_entry() const {
    if (!values_.at_end()) refuse("has more values than the header has properties");
  }

  const PlyHeader& header_;
  Values values_;
  PolygonMesh& mesh_;
  std::size_t vertex_, face_;             // elements
  std::array<std::size_t, 3> places_{};   // properties of vertices: x, y, z
  std::size_t indices_ = 0;               // property of faces
};

}  // namespace

void read_ply_mesh(FileScanner& in, PolygonMesh& mesh) {
  const PlyHeader header = read_ply_header(in);
  if (header.encoding == PlyEncoding::text) return PlyMeshReader(header, in, PlyTextValues(in), mesh).read();
  PlyMeshReader reader(header, in, PlyBinaryValues(in, header.encoding, "entry"), mesh);
  mesh.binary = true;
  reader.read();
}

}  // namespace hooke::scene
