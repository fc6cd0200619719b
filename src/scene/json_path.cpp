// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/json_path.h"

#include <algorithm>
#include <charconv>

namespace hooke {
namespace {

// Bytes from 0x80 on belong to non-ASCII letters.
bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == '$' || static_cast<unsigned char>(c) >= 0x80;
}

// Takes one '["key"]' off the start of `text`.
std::optional<std::string> take_quoted(std::string_view& text) {
  std::string key;
  for (std::size_t i = 2; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size()) {
      key += text[++i];
    } else if (text[i] == '"') {
      if (i + 1 >= text.size() || text[i + 1] != ']') return std::nullopt;
      text.remove_prefix(i + 2);
      return key;
    } else {
      key += text[i];
    }
  }
  return std::nullopt;
}

// Takes one "[12]" off the start of `text`.
std::optional<std::size_t> take_index(std::string_view& text) {
  std::size_t index = 0;
  const char* end = text.data() + text.size();
  const auto [stop, fault] = std::from_chars(text.data() + 1, end, index);
  if (fault != std::errc() || stop == end || *stop != ']') return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()) + 1);
  return index;
}

}  // namespace

std::string join_path(const std::string& parent, std::string_view key) {
  if (!key.empty() && std::all_of(key.begin(), key.end(), is_plain)) {
    return parent.empty() ? std::string(key) : parent + '.' + std::string(key);
  }
  std::string quoted = parent + "[\"";
  for (const char c : key) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"]";
}

std::string join_path(const std::string& parent, std::size_t index) {
  return parent + '[' + std::to_string(index) + ']';
}

std::string to_text(const JsonPath& path) {
  std::string text;
  for (const auto& part : path) text = std::visit([&text](const auto& p) { return join_path(text, p); }, part);
  return text;
}

std::optional<JsonPath> parse_path(std::string_view text) {
  JsonPath path;
  while (!text.empty()) {
    if (text.substr(0, 2) == "[\"") {
      auto key = take_quoted(text);
      if (!key) return std::nullopt;
      path.emplace_back(std::move(*key));
    } else if (text.front() == '[') {
      const auto index = take_index(text);
      if (!index || path.empty()) return std::nullopt;
      path.emplace_back(*index);
    } else {
      if (!path.empty()) {
        if (text.front() != '.') return std::nullopt;
        text.remove_prefix(1);
      }
      const auto end = static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_plain) - text.begin());
      if (end == 0) return std::nullopt;
      path.emplace_back(std::string(text.substr(0, end)));
      text.remove_prefix(end);
    }
  }
  if (path.empty()) return std::nullopt;
  return path;
}

bool is_at_or_below(std::string_view inner, std::string_view outer) {
  if (inner.substr(0, outer.size()) != outer) return false;
  return outer.empty() || inner.size() == outer.size() || inner[outer.size()] == '.' || inner[outer.size()] == '[';
}

}  // namespace hooke
