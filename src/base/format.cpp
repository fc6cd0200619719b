// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/base/format.h"

#include <array>
#include <charconv>
#include <cstddef>

#include "hooke/base/assert.h"

namespace hooke {

namespace {

// Longer than any number: a fixed one of 17 digits has at most 16 before its point.
using Digits = std::array<char, 64>;

template <class... Rules>
std::string_view written(Digits& digits, Rules... rules) {
  const std::to_chars_result end = std::to_chars(digits.data(), digits.data() + digits.size(), rules...);
  HOOKE_ASSERT(end.ec == std::errc());
  return {digits.data(), static_cast<std::size_t>(end.ptr - digits.data())};
}

// With the fewest digits; with an exponent only where the number is below 1e-4, or 1e16 or above.
template <class Real>
std::string_view shortest(Digits& digits, Real value) {
  const std::string_view scientific = written(digits, value, std::chars_format::scientific);
  const std::size_t e = scientific.find('e');
  if (e == std::string_view::npos) return scientific;  // inf or nan
  int exponent = 0;
  const char* const sign = scientific.data() + e + 1;
  std::from_chars(*sign == '+' ? sign + 1 : sign, scientific.data() + scientific.size(), exponent);
  if (exponent < -4 || exponent >= 16) return scientific;
  return written(digits, value, std::chars_format::fixed);
}

// `rule` is what stands between the braces: nothing, or ":.Ng".
void append(std::string& out, std::string_view rule, const FormatValue& value) {
  Digits digits;
  const auto show = [&]<class T>(const T& x) -> std::string_view {
    if constexpr (std::is_same_v<T, std::string_view>) {
      HOOKE_ASSERT(rule.empty(), rule);
      return x;
    } else if constexpr (std::is_floating_point_v<T>) {
      if (rule.empty()) return shortest(digits, x);
      HOOKE_ASSERT(is_precision(rule), rule);
      int precision = 6;
      std::from_chars(rule.data() + 2, rule.data() + rule.size() - 1, precision);
      return written(digits, x, std::chars_format::general, precision);
    } else {
      HOOKE_ASSERT(rule.empty(), rule);
      return written(digits, x);
    }
  };
  out += std::visit(show, value);
}

}  // namespace

std::string format_values(std::string_view pattern, std::initializer_list<FormatValue> values) {
  std::string out;
  for (const FormatValue& value : values) {
    const std::size_t open = pattern.find('{'), close = pattern.find('}', open);
    HOOKE_ASSERT(open != std::string_view::npos && close != std::string_view::npos, pattern);
    out += pattern.substr(0, open);
    append(out, pattern.substr(open + 1, close - open - 1), value);
    pattern.remove_prefix(close + 1);
  }
  return out.append(pattern);
}

}  // namespace hooke
