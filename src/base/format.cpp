// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/base/format.h"

#include <algorithm>
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

// With the fewest digits, and zeros where they are too few for a whole number; with an exponent only where the number
// is below 1e-4, or 1e16 or above.
template <class Real>
std::string shortest(Real value) {
  Digits digits;
  std::string scientific(written(digits, value, std::chars_format::scientific));
  const std::size_t e = scientific.find('e');
  if (e == std::string::npos) return scientific;  // inf or nan
  int exponent = 0;
  const char* const sign = scientific.data() + e + 1;
  std::from_chars(*sign == '+' ? sign + 1 : sign, scientific.data() + scientific.size(), exponent);
  if (exponent < -4 || exponent >= 16) return scientific;
  std::string whole = scientific.substr(0, e);
  std::erase(whole, '.');
  const std::size_t most = static_cast<std::size_t>(std::max(exponent, 0)) + (value < 0 ? 2 : 1);
  if (exponent < 0 || whole.size() > most) return std::string(written(digits, value, std::chars_format::fixed));
  return whole.append(most - whole.size(), '0');
}

// `rule` is what stands between the braces: nothing, or ":.Ng".
void append(std::string& out, std::string_view rule, const FormatValue& value) {
  Digits digits;
  const auto show = [&]<class T>(const T& x) -> std::string {
    if constexpr (std::is_same_v<T, std::string_view>) {
      return std::string(x);
    } else if constexpr (std::is_floating_point_v<T>) {
      if (rule.empty()) return shortest(x);
      HOOKE_ASSERT(is_precision(rule), rule);
      int precision = 6;
      std::from_chars(rule.data() + 2, rule.data() + rule.size() - 1, precision);
      return std::string(written(digits, x, std::chars_format::general, precision));
    } else {
      return std::string(written(digits, x));
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
