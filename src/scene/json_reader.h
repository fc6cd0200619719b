// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/scene/findings.h"

namespace hooke {

/// JSON whose objects keep the order in which they were written.
using Json = nlohmann::ordered_json;

/// A value, nested at most this deep.
inline constexpr std::size_t kDepthLimit = 64;

struct JsonReading {
  std::optional<Json> value;      ///< nothing where the text can't be read to its end
  bool syntax_error = false;      ///< the text is no JSON; else, without a value, it is too deeply nested
  LineMap lines;                  ///< of every value, by its path
  /// Doubled keys and numbers too large for a double, by path; the first of two equal keys is kept, and 0 stands in
  /// for the number. And what stopped the reading, if anything did, at "name:line:column".
  std::vector<std::pair<std::string, std::string>> faults;
  std::optional<Finding> stopped;
};

/// Reads JSON with // and /* */ comments. `name` is what messages call the text, `path` where its value belongs.
JsonReading read_json(std::string_view text, const std::string& name, const std::string& path = "");

/// A value in few words, for messages: at most 60 bytes or so, always valid UTF-8.
std::string brief(const Json& value);

/// `text` with what is no valid UTF-8 or no printable character replaced, and cut to `most` bytes.
std::string printable(std::string_view text, std::size_t most = 200);

/// JSON for people: two spaces a level, lists of plain values on one line; numbers with the shortest digits that
/// read back to the same value.
std::string pretty(const Json& value);

}  // namespace hooke
