// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "hooke/base/parallel.h"
#include "hooke/base/vec3.h"
#include "hooke/io/output_file.h"

namespace hooke::io {

/// Writes `count` rows in order; append(text, i) appends row `i`. All threads make rows at once, some megabytes at a
/// time, because turning numbers into digits takes most of the time of text formats.
template <class Append>
void write_rows(OutputFile& out, std::size_t count, const Append& append) {
  constexpr std::size_t kGrain = 2048;
  std::array<std::string, 32> pieces;
  for (std::size_t begin = 0; begin < count; begin += kGrain * pieces.size()) {
    for (std::string& piece : pieces) piece.clear();
    parallel_ranges(std::min(count - begin, kGrain * pieces.size()), kGrain, [&](std::size_t first, std::size_t last) {
      std::string& piece = pieces[first / kGrain];
      for (std::size_t i = first; i < last; ++i) append(piece, begin + i);
    });
    for (const std::string& piece : pieces) out.write(piece);
  }
}

/// A name as a CSV field, quoted if necessary: readers drop blanks at the ends of a field that is not.
inline std::string csv_field(const std::string& name) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  const bool kept = name.empty() || (!is_blank(name.front()) && !is_blank(name.back()));
  if (kept && name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

/// "x y z" with the given separator, rounded to Real.
template <class Real>
void append_vector(std::string& text, const Vec3d& v, const char* separator = " ") {
  append_number(text, static_cast<Real>(v.x));
  text += separator;
  append_number(text, static_cast<Real>(v.y));
  text += separator;
  append_number(text, static_cast<Real>(v.z));
}

}  // namespace hooke::io
