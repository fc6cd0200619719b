// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/base/printable.h"
#include "hooke/scene/findings.h"

namespace hooke::scene {

/// JSON whose objects keep the order in which their keys were written.
using Json = nlohmann::ordered_json;

/// Values may be nested at most this deep.
inline constexpr std::size_t kDepthLimit = 64;

struct JsonReading {
  std::optional<Json> value;      ///< nothing where the text can't be read to its end
  bool syntax_error = false;      ///< the text is not JSON; if false and `value` is empty, it is nested too deeply
  /// Duplicate keys and numbers too large for a double, by path, no more than findings are kept; the first of two equal
  /// keys is kept, and 0 replaces the number.
  std::vector<std::pair<std::string, std::string>> faults;
  /// What stopped the reading, if anything did, at "name:line:column".
  std::optional<Finding> stopped;
  std::string readable;  ///< the text with each number replaced that is too large; empty where there is none
};

/// Reads JSON with // and /* */ comments. `name` is the name of the text in messages, `path` the path of its value.
JsonReading read_json(std::string_view text, const std::string& name, const std::string& path = "");

/// A value in few words for messages: at most about 60 bytes, always valid UTF-8.
std::string brief(const Json& value);

/// JSON for people: two spaces a level, lists of plain values on one line; numbers have the fewest digits that read
/// back to the same value.
std::string pretty(const Json& value);

}  // namespace hooke::scene
