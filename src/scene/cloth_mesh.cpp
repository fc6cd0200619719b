// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/cloth_mesh.h"

#include <fmt/format.h>

#include <limits>
#include <string_view>

#include "hooke/scene/file_scanner.h"
#include "hooke/scene/words.h"

namespace hooke {
namespace {

// A general library reorders corners and doubles those at seams; pins and springs need the file's own numbering.
class ObjReader {
 public:
  explicit ObjReader(const std::filesystem::path& file) : in_(file) {}

  ClothMesh read() {
    while (const auto line = in_.line()) {
      split_words(*line, words_);
      if (words_.empty()) continue;
      if (words_[0] == "v") read_corner();
      if (words_[0] == "f") read_face();
    }
    if (mesh_.triangles.empty()) throw FileFault(0, "holds no faces");
    return std::move(mesh_);
  }

 private:
  void read_corner() {
    double x[3];
    for (std::size_t k = 0; k < 3; ++k) {
      if (k + 1 >= words_.size() || !read_number(words_[k + 1], x[k])) {
        throw FileFault(in_.line_number(), "must be \"v\" and three numbers");
      }
    }
    if (mesh_.position.size() == std::numeric_limits<std::uint32_t>::max()) throw FileFault(0, "has too many corners");
    mesh_.position.push_back({x[0], x[1], x[2]});
  }

  // "f 1 2 3", "f 1/7 2/8 3/9", "f 1//4 -2//5 -1//6": the number before the first slash is the corner; a negative one
  // counts backwards from the last corner.
  void read_face() {
    corners_.clear();
    for (std::size_t k = 1; k < words_.size(); ++k) {
      std::string_view word = words_[k].substr(0, words_[k].find('/'));
      const bool backwards = word.starts_with('-');
      if (backwards) word.remove_prefix(1);
      std::uint64_t index = 0;
      const std::uint64_t count = mesh_.position.size();
      if (!read_count(word, index) || index == 0 || index > count) {
        throw FileFault(in_.line_number(),
                        fmt::format("names the corner \"{}\"; {} are known there", words_[k].substr(0, 40), count));
      }
      corners_.push_back(static_cast<std::uint32_t>(backwards ? count - index : index - 1));
    }
    if (corners_.size() < 3) throw FileFault(in_.line_number(), "is a face of less than three corners");
    for (std::size_t k = 2; k < corners_.size(); ++k) {
      mesh_.triangles.insert(mesh_.triangles.end(), {corners_[0], corners_[k - 1], corners_[k]});
    }
  }

  FileScanner in_;
  std::vector<std::string_view> words_;
  std::vector<std::uint32_t> corners_;
  ClothMesh mesh_;
};

}  // namespace

Expected<ClothMesh> read_cloth_mesh(const std::filesystem::path& file) {
  try {
    return ObjReader(file).read();
  } catch (const FileFault& fault) {
    const std::string what = fault.what();
    return fail(Error::Kind::bad_input, "", fault.place() > 0 ? fmt::format("line {} {}", fault.place(), what) : what);
  }
}

}  // namespace hooke
