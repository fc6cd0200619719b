// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hooke::scene {

/// Keys and indices from the top of a JSON document: "materials.water.radius", "particles[0].block". A key with other
/// characters than letters, digits, '_', '-' and '$' is quoted, with the escapes of JSON: materials["salt water"].
using JsonPath = std::vector<std::variant<std::string, std::size_t>>;

/// The path `parent` extended by a key or an index, as text that a terminal can show.
std::string join_path(const std::string& parent, std::string_view key);
std::string join_path(const std::string& parent, std::size_t index);

/// A whole path as text.
std::string to_text(const JsonPath& path);

/// Parses the text of a path; nothing where the text is no path.
std::optional<JsonPath> parse_path(std::string_view text);

/// Whether the path `inner` equals `outer` or lies below it.
bool is_at_or_below(std::string_view inner, std::string_view outer);

/// Paths as text. A look-up takes no longer than its path is long, however many paths there are.
class PathSet {
 public:
  void insert(std::string_view path) { paths_.emplace(path); }
  bool contains(std::string_view path) const { return paths_.find(path) != paths_.end(); }
  /// Whether it holds `path`, or one that `path` lies below.
  bool contains_at_or_above(std::string_view path) const;
  /// Whether it holds `path`, or one below it.
  bool contains_at_or_below(std::string_view path) const;

 private:
  std::set<std::string, std::less<>> paths_;
};

}  // namespace hooke::scene
