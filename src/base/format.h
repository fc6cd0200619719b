// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

namespace hooke {

// Messages of the engine's own libraries, which need the C++20 library alone; GCC 12's has no std::format.

/// A value that a message shows.
using FormatValue = std::variant<long long, unsigned long long, float, double, std::string_view>;

/// Any number, or a text, which must outlive the value.
template <class T>
FormatValue format_value(const T& value) {
  static_assert(!std::is_same_v<T, bool> && !std::is_same_v<T, char>, "has no form here");
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

/// Whether what stands between the braces of a place is ":.Ng".
constexpr bool is_precision(std::string_view rule) {
  return (rule.size() == 4 || rule.size() == 5) && rule.starts_with(":.") && rule.ends_with("g") &&
         rule.find_first_not_of("0123456789", 2) == rule.size() - 1;
}

/// A pattern that has a place for each value: "{}", or for floating-point numbers "{:.3g}". Another does not compile.
template <class... Values>
struct FormatPattern {
  consteval FormatPattern(const char* pattern) : text(pattern) {  // NOLINT: patterns are written as literals
    constexpr bool kHasPrecision[] = {std::is_floating_point_v<Values>..., false};
    std::size_t place = 0;
    for (std::size_t i = text.find_first_of("{}"); i != std::string_view::npos; i = text.find_first_of("{}", i + 1)) {
      const std::size_t close = text.find('}', i);
      if (text[i] == '}' || close == std::string_view::npos) throw "a brace without its other";
      if (place == sizeof...(Values)) throw "a place without a value";
      const std::string_view rule = text.substr(i + 1, close - i - 1);
      if (!rule.empty() && !(kHasPrecision[place] && is_precision(rule))) throw "no form of this value";
      ++place;
      i = close;
    }
    if (place != sizeof...(Values)) throw "a value without a place";
  }
  std::string_view text;
};

std::string format_values(std::string_view pattern, std::initializer_list<FormatValue> values);

/// `pattern` with its places filled, as std::format would fill them. "{}" shows a number with the fewest digits that
/// lead back to it, "{:.Ng}" with up to N (1 to 17) significant digits, as printf.
template <class... Values>
std::string formatted(FormatPattern<std::type_identity_t<Values>...> pattern, const Values&... values) {
  return format_values(pattern.text, {format_value(values)...});
}

}  // namespace hooke
