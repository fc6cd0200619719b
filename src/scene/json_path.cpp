// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/json_path.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "hooke/base/printable.h"

namespace hooke::scene {
namespace {

// Bytes from 0x80 on belong to non-ASCII letters.
bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == '$' || static_cast<unsigned char>(c) >= 0x80;
}

// Appends a character below U+10000 as UTF-8.
void append_utf8(std::string& text, std::uint32_t code) {
  const auto byte = [&text](std::uint32_t value) { text += static_cast<char>(static_cast<unsigned char>(value)); };
  if (code < 0x80) return byte(code);
  if (code < 0x800) {
    byte(0xc0U | code >> 6U);
  } else {
    byte(0xe0U | code >> 12U);
    byte(0x80U | (code >> 6U & 0x3fU));
  }
  byte(0x80U | (code & 0x3fU));
}

// Takes the escape off the start of `text` whose backslash has been taken; a character that needs none stands for
// itself.
void take_escape(std::string_view& text, std::string& key) {
  constexpr std::string_view kLetters = "bfnrt", kMeaning = "\b\f\n\r\t";
  constexpr std::size_t kDigits = 4;
  const char letter = text.front();
  text.remove_prefix(1);
  std::uint32_t code = 0;
  const char* const digits = text.data();
  if (letter == 'u' && text.size() >= kDigits &&
      std::from_chars(digits, digits + kDigits, code, 16).ptr == digits + kDigits) {
    append_utf8(key, code);
    text.remove_prefix(kDigits);
  } else {
    const auto known = kLetters.find(letter);
    key += known == std::string_view::npos ? letter : kMeaning[known];
  }
}

// Takes one '["key"]' off the start of `text`.
std::optional<std::string> take_quoted(std::string_view& text) {
  std::string key;
  text.remove_prefix(2);
  while (!text.empty()) {
    const char c = text.front();
    text.remove_prefix(1);
    if (c == '"') {
      if (text.empty() || text.front() != ']') return std::nullopt;
      text.remove_prefix(1);
      return key;
    }
    if (c == '\\' && !text.empty()) {
      take_escape(text, key);
    } else {
      key += c;
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
  const std::string step = path_step(key);
  return parent.empty() && step.front() == '.' ? step.substr(1) : parent + step;
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

bool PathSet::contains_at_or_above(std::string_view path) const {
  if (paths_.empty()) return false;
  if (contains("") || contains(path)) return true;
  // The paths above are what stands before each step. Quoted keys hold dots and brackets that begin none.
  bool quoted = false;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (quoted) {
      if (path[i] == '\\')
        ++i;
      else if (path[i] == '"')
        quoted = false;
    } else if (path[i] == '"') {
      quoted = true;
    } else if ((path[i] == '.' || path[i] == '[') && contains(path.substr(0, i))) {
      return true;
    }
  }
  return false;
}

bool PathSet::contains_at_or_below(std::string_view path) const {
  if (path.empty()) return !paths_.empty();
  if (contains(path)) return true;
  for (const char step : {'.', '['}) {
    const std::string start = std::string(path) + step;
    const auto next = paths_.lower_bound(start);
    if (next != paths_.end() && next->compare(0, start.size(), start) == 0) return true;
  }
  return false;
}

}  // namespace hooke::scene
