// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hooke/scene/file_scanner.h"
#include "hooke/scene/words.h"

namespace hooke::scene {

// PLY, as text or binary in either byte order: a header that names elements and their properties, then the values of
// all elements in the header's order. Readers of particles and of meshes share what is here. No count of a file is
// believed: nothing is allocated for more than what the file's size allows.

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a value.
std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> count;  ///< of a list: the type of its length; empty for a single value
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  bool has_lists() const;
  /// Bytes of one entry; a list counts with its length only.
  std::size_t size() const;
  /// The index of the property `name`; the number of properties where there is none.
  std::size_t find(std::string_view name) const;
};

enum class PlyEncoding { text, little_endian, big_endian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::text;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;

  /// The index of the element `name`. Throws FileFault, at the line of the scanner, where there is none.
  std::size_t element(std::string_view name, const FileScanner& in) const;
};

/// Reads the header. Throws FileFault where it is wrong.
PlyHeader read_ply_header(FileScanner& in);

/// Values as text, one entry per line.
class PlyTextValues {
 public:
  explicit PlyTextValues(FileScanner& in) : in_(in) {}

  /// Where the current entry is: its line.
  std::uint64_t place() const { return in_.line_number(); }
  /// At most so many entries fit into the rest of the file.
  std::uint64_t most_entries(const PlyElement& element) const;
  /// Passes all entries of an element. False where the file ends within them.
  bool skip(const PlyElement& element) { return in_.skip_lines(element.count); }
  /// Goes to the next entry. False at the end of the file.
  bool start();
  /// The next value of the entry; empty where it has no more.
  std::optional<std::string_view> next(PlyType);
  /// Whether the entry has no more values.
  bool at_end() const { return trimmed(rest_).empty(); }

 private:
  FileScanner& in_;
  std::string_view rest_;
};

/// The same for binary values; places are bytes.
class PlyBinaryValues {
 public:
  /// `entry` is what messages call the thing that the file ends within: "particle".
  PlyBinaryValues(FileScanner& in, PlyEncoding encoding, std::string entry);

  std::uint64_t place() const { return place_; }
  std::uint64_t most_entries(const PlyElement& element) const;
  bool skip(const PlyElement& element);
  bool start();
  /// Throws FileFault at the end of the file.
  std::optional<double> next(PlyType type);
  static bool at_end() { return true; }

 private:
  FileScanner& in_;
  bool swap_;
  std::string entry_;
  std::uint64_t place_ = 0;
};

/// Passes the elements before the one with index `end`. Throws FileFault where the file ends within them.
template <class Values>
void skip_elements(const PlyHeader& header, std::size_t first, std::size_t end, Values& values);

extern template void skip_elements(const PlyHeader&, std::size_t, std::size_t, PlyTextValues&);
extern template void skip_elements(const PlyHeader&, std::size_t, std::size_t, PlyBinaryValues&);

}  // namespace hooke::scene
