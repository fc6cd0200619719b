// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hooke {

/// Keys and indices from the top of a JSON document: "materials.water.radius", "particles[0].block". A key with other
/// characters than letters, digits, '_', '-' and '$' is quoted: materials["salt water"].
using JsonPath = std::vector<std::variant<std::string, std::size_t>>;

/// The path `parent` extended by a key or an index, as text.
std::string join_path(const std::string& parent, std::string_view key);
std::string join_path(const std::string& parent, std::size_t index);

/// A whole path as text.
std::string to_text(const JsonPath& path);

/// Parses the text of a path; nothing where the text is no path.
std::optional<JsonPath> parse_path(std::string_view text);

/// Whether the path `inner` equals `outer` or lies below it.
bool is_at_or_below(std::string_view inner, std::string_view outer);

}  // namespace hooke
