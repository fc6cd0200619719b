// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Wavefront OBJ: the lines "v" and "f"; all others are skipped, so no file that this one names is ever opened.
#include <fmt/format.h>

#include <string_view>

#include "hooke/scene/json_reader.h"
#include "hooke/scene/polygon_mesh.h"
#include "hooke/scene/words.h"

namespace hooke::scene {
namespace {

class ObjReader {
 public:
  ObjReader(FileScanner& in, PolygonMesh& mesh) : in_(in), mesh_(mesh) {}

  void read() {
    while (const auto line = next_line()) {
      split_words(*line, words_);
      if (words_.empty()) continue;
      if (words_[0] == "v") read_vertex();
      if (words_[0] == "f") read_face();
    }
    if (highest_ > mesh_.vertices.size()) throw unknown(highest_line_, std::to_string(highest_));
  }

 private:
  // A line that ends with a backslash goes on in the next one.
  std::optional<std::string_view> next_line() {
    auto line = in_.line();
    if (!line) return line;
    if (!line->ends_with('\\')) return line;
    joined_.clear();
    while (line && line->ends_with('\\')) {
      joined_.append(line->substr(0, line->size() - 1)).push_back(' ');
      line = in_.line();
    }
    if (line) joined_.append(*line);
    return joined_;
  }

  FileFault unknown(std::uint64_t line, std::string_view index) const {
    return {line, fmt::format("names the vertex \"{}\"; the vertices have the numbers 1 to {}", printable(index, 40),
                              mesh_.vertices.size())};
  }

  void read_vertex() {
    double x[3];
    for (std::size_t k = 0; k < 3; ++k) {
      if (k + 1 >= words_.size() || !read_number(words_[k + 1], x[k])) {
        throw FileFault(in_.line_number(), "must be \"v\" and three numbers");
      }
    }
    if (mesh_.vertices.size() == kMostVertices) throw FileFault(in_.line_number(), "is one vertex too many");
    mesh_.vertices.push_back({x[0], x[1], x[2]});
  }

  // "f 1 2 3", "f 1/7 2/8 3/9", "f 1//4 -2//5 -1//6": the number before the first slash is the vertex; a negative one
  // counts backwards from the last vertex, a positive one may name a vertex that follows.
  void read_face() {
    for (std::size_t k = 1; k < words_.size(); ++k) {
      std::string_view word = words_[k].substr(0, words_[k].find('/'));
      const bool backwards = word.starts_with('-');
      if (backwards) word.remove_prefix(1);
      std::uint64_t index = 0;
      const std::uint64_t count = mesh_.vertices.size();
      if (!read_count(word, index) || index == 0 || index > (backwards ? count : kMostVertices)) {
        throw unknown(in_.line_number(), words_[k]);
      }
      if (backwards) index = count - index + 1;
      if (index > highest_) {
        highest_ = index;
        highest_line_ = in_.line_number();
      }
      mesh_.corners.push_back(static_cast<std::uint32_t>(index - 1));
    }
    if (words_.size() < 4) throw FileFault(in_.line_number(), "is a face of less than three corners");
    mesh_.ends.push_back(mesh_.corners.size());
  }

  FileScanner& in_;
  PolygonMesh& mesh_;
  std::vector<std::string_view> words_;
  std::string joined_;
  std::uint64_t highest_ = 0;  // of all vertices that faces name, from 1
  std::uint64_t highest_line_ = 0;
};

}  // namespace

void read_obj(FileScanner& in, PolygonMesh& mesh) { ObjReader(in, mesh).read(); }

}  // namespace hooke::scene
