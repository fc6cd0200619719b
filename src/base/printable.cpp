// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/base/printable.h"

#include <algorithm>
#include <cstdint>

namespace hooke {
namespace {

constexpr std::uint32_t kReplacement = 0xfffd;

struct Character {
  std::uint32_t code = kReplacement;
  std::size_t size = 1;  // bytes
  bool valid = false;
};

// The character that a text of at least one byte begins with (RFC 3629).
Character first_character(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t size = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || size > text.size()) return {};
  std::uint32_t code = lead & (0x7fU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return {};
    code = code << 6U | (byte(i) & 0x3fU);
  }
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  return code >= kLeast[size] && code <= 0x10ffff && !surrogate ? Character{code, size, true} : Character{};
}

// Control characters, what ends a line, and what turns the direction of writing; all are below U+10000.
bool is_control(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code <= 0x9f) || code == 0x061c || code == 0x200e || code == 0x200f ||
         (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069) || code == 0xfeff;
}

void append_escape(std::string& out, std::uint32_t code) {
  constexpr std::string_view kShort = "\b\f\n\r\t", kLetters = "bfnrt";
  out += '\\';
  if (const auto at = code < 0x20 ? kShort.find(static_cast<char>(code)) : std::string_view::npos;
      at != std::string_view::npos) {
    out += kLetters[at];
    return;
  }
  constexpr std::string_view kDigits = "0123456789abcdef";
  out += 'u';
  for (int shift = 12; shift >= 0; shift -= 4) out += kDigits[code >> static_cast<unsigned>(shift) & 0xfU];
}

void append_shown(std::string& out, std::string_view bytes, const Character& c) {
  if (!c.valid) {
    out += "\xef\xbf\xbd";
  } else if (is_control(c.code)) {
    append_escape(out, c.code);
  } else {
    out += bytes;
  }
}

bool is_plain_ascii(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '$';
}

// Letters beyond ASCII need no quotes.
bool is_plain(std::string_view key) {
  while (!key.empty()) {
    const Character c = first_character(key);
    if (!c.valid || is_control(c.code) || (c.size == 1 && !is_plain_ascii(key.front()))) return false;
    key.remove_prefix(c.size);
  }
  return true;
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  std::string shown;
  std::size_t read = 0;
  while (!text.empty()) {
    const Character c = first_character(text);
    if (read + c.size > most) return shown + "...";
    append_shown(shown, text.substr(0, c.size), c);
    text.remove_prefix(c.size);
    read += c.size;
  }
  return shown;
}

std::string path_step(std::string_view key) {
  if (!key.empty() && is_plain(key)) return '.' + std::string(key);
  std::string step = "[\"";
  while (!key.empty()) {
    const Character c = first_character(key);
    if (key.front() == '"' || key.front() == '\\') step += '\\';
    append_shown(step, key.substr(0, c.size), c);
    key.remove_prefix(c.size);
  }
  return step + "\"]";
}

}  // namespace hooke
