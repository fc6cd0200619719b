// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// STL, as text in any case or binary. A binary file may begin with "solid", too: what tells them apart is that the size
// of a binary file follows from its number of facets.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>

#include "hooke/scene/json_reader.h"
#include "hooke/scene/polygon_mesh.h"
#include "hooke/scene/words.h"

namespace hooke::scene {
namespace {

constexpr std::uint64_t kHeader = 80, kFacet = 50;  // bytes; the number of facets, 4 bytes, lies between

template <class T>
T little_endian(const char* bytes) {
  char value[sizeof(T)];
  std::copy_n(bytes, sizeof(T), value);
  if constexpr (std::endian::native == std::endian::big) std::reverse(value, value + sizeof(T));
  return std::bit_cast<T>(value);
}

void add_facet(const Vec3d (&corners)[3], std::uint64_t place, PolygonMesh& mesh) {
  if (mesh.vertices.size() + 3 > kMostVertices) throw FileFault(place, "is one facet too many");
  for (const Vec3d& x : corners) {
    mesh.corners.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
    mesh.vertices.push_back(x);
  }
  mesh.ends.push_back(mesh.corners.size());
}

class BinaryStl {
 public:
  BinaryStl(FileScanner& in, PolygonMesh& mesh) : in_(in), mesh_(mesh) {}

  void read(std::uint64_t facets) {
    for (std::uint64_t i = 0; i < facets; ++i) read_facet();
  }

 private:
  void read_facet() {
    const std::uint64_t place = in_.offset();
    const char* bytes = in_.bytes(kFacet);
    if (bytes == nullptr) throw FileFault(place, "ends within this facet");
    Vec3d corners[3];
    const char* next = bytes + 12;  // behind the normal
    for (Vec3d& x : corners) {
      for (int axis = 0; axis < 3; ++axis, next += sizeof(float)) {
        component(x, axis) = static_cast<double>(little_endian<float>(next));
        if (!std::isfinite(component(x, axis))) throw FileFault(place, "is a facet with a corner at no finite place");
      }
    }
    add_facet(corners, place, mesh_);
  }

  FileScanner& in_;
  PolygonMesh& mesh_;
};

class TextStl {
 public:
  TextStl(FileScanner& in, PolygonMesh& mesh) : in_(in), mesh_(mesh) {}

  void read() {
    while (const auto line = in_.line()) {
      split_words(*line, words_);
      if (!words_.empty()) read_line();
    }
    if (state_ != State::outside) refuse("ends a file that goes on, up to \"endsolid\"");
  }

 private:
  enum class State { outside, in_solid, in_facet };

  [[noreturn]] void refuse(const std::string& message) const { throw FileFault(in_.line_number(), message); }

  void read_line() {
    std::string keyword(words_[0].substr(0, 40));
    std::transform(keyword.begin(), keyword.end(), keyword.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    if (keyword == "solid") {
      expect(keyword, State::outside, State::in_solid);
    } else if (keyword == "facet") {
      expect(keyword, State::in_solid, State::in_facet);
      corners_ = 0;
    } else if (keyword == "vertex") {
      expect(keyword, State::in_facet, State::in_facet);
      read_vertex();
    } else if (keyword == "outer" || keyword == "endloop") {
      expect(keyword, State::in_facet, State::in_facet);
    } else if (keyword == "endfacet") {
      expect(keyword, State::in_facet, State::in_solid);
      if (corners_ != 3) refuse(fmt::format("ends a facet of {} corners; must be three", corners_));
      add_facet(at_, in_.line_number(), mesh_);
    } else if (keyword == "endsolid") {
      expect(keyword, State::in_solid, State::outside);
    } else {
      refuse(fmt::format("starts with \"{}\", which is no keyword of an STL file", printable(words_[0], 40)));
    }
  }

  void expect(const std::string& keyword, State state, State next) {
    if (state_ != state) refuse(fmt::format("starts with \"{}\", which is out of place there", keyword));
    state_ = next;
  }

  void read_vertex() {
    if (corners_ == 3) refuse("is the fourth corner of a facet; must be three");
    for (std::size_t k = 0; k < 3; ++k) {
      if (k + 1 >= words_.size() || !read_number(words_[k + 1], component(at_[corners_], static_cast<int>(k)))) {
        refuse("must be \"vertex\" and three numbers");
      }
    }
    ++corners_;
  }

  FileScanner& in_;
  PolygonMesh& mesh_;
  std::vector<std::string_view> words_;
  State state_ = State::outside;
  std::size_t corners_ = 0;  // of the current facet
  Vec3d at_[3] = {};
};

// Whether the first word of the file, behind blanks, is "solid", and no byte is 0, as some of a binary file are, whose
// title may be any text.
bool begins_as_text(FileScanner& in) {
  const FileScanner::Place start = in.place();
  std::string_view first;
  // Whole lines would be looked for in a binary file, too, and may be long there.
  const std::size_t at_hand = std::min<std::uint64_t>(in.remaining(), FileScanner::kLongestLine);
  std::string_view text(in.bytes(at_hand), at_hand);
  text.remove_prefix(std::min(text.size(), text.find_first_not_of(" \t\r\n")));
  first = text.substr(0, 5);
  const bool is_text =
      first.size() == 5 && strncasecmp(first.data(), "solid", 5) == 0 && text.find('\0') == std::string_view::npos;
  in.go_back(start);
  return is_text;
}

}  // namespace

void read_stl(FileScanner& in, PolygonMesh& mesh) {
  const FileScanner::Place start = in.place();
  const std::uint64_t size = in.remaining();
  const char* head = in.bytes(kHeader + 4);
  const std::uint64_t facets = head != nullptr ? little_endian<std::uint32_t>(head + kHeader) : 0;
  const std::uint64_t expected = kHeader + 4 + kFacet * facets;
  if (head == nullptr || size != expected) {
    in.go_back(start);
    if (begins_as_text(in)) return TextStl(in, mesh).read();
    if (head == nullptr || facets == 0 || size < expected) {
      throw FileFault(0, fmt::format("is no STL file: it does not begin with \"solid\", as text does, and binary data "
                                     "would be {} bytes for {} facets; it has {}",
                                     expected, facets, size));
    }
    mesh.warnings.push_back(
        fmt::format("holds {} bytes behind its {} facets, which are passed over", size - expected, facets));
    in.bytes(kHeader + 4);
  }
  mesh.binary = true;
  BinaryStl(in, mesh).read(facets);
}

}  // namespace hooke::scene
