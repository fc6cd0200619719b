// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

namespace hooke {

// Messages of the engine's own libraries, which need the C++20 library alone; GCC 12's has no std::format.

/// A value that a message shows.
using FormatValue = std::variant<long long, unsigned long long, float, double, std::string_view>;

/// Any number, enumerators apart, or a text, which must outlive the value.
template <class T>
FormatValue format_value(const T& value) {
  if constexpr (std::is_same_v<T, float> || std::is_same_v<T, double>) {
    return value;
  } else if constexpr (std::signed_integral<T>) {
    return static_cast<long long>(value);
  } else if constexpr (std::unsigned_integral<T>) {
    return static_cast<unsigned long long>(value);
  } else {
    return std::string_view(value);
  }
}

/// A pattern that has a place "{}" or "{:.3g}" for each value; another number of places does not compile.
template <class... Values>
struct FormatPattern {
  consteval FormatPattern(const char* pattern) : text(pattern) {  // NOLINT: patterns are written as literals
    if (std::count(text.begin(), text.end(), '{') != sizeof...(Values)) throw "a place for each value";
  }
  std::string_view text;
};

std::string format_values(std::string_view pattern, std::initializer_list<FormatValue> values);

/// `pattern` with its places filled, as std::format would. "{}" shows a number with the fewest digits that lead back to
/// it, "{:.Ng}" with up to N (1 to 17) significant digits, as printf.
template <class... Values>
std::string formatted(FormatPattern<std::type_identity_t<Values>...> pattern, const Values&... values) {
  return format_values(pattern.text, {format_value(values)...});
}

}  // namespace hooke
