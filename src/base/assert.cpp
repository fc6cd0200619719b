// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/base/assert.h"

#include <array>
#include <atomic>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace hooke {
namespace {

void write_and_abort(const AssertionFailure& failure) {
  const auto length = static_cast<int>(failure.values.size());
  std::fprintf(stderr, "%s:%d: %s: assertion failed: %s%s%.*s\n", failure.file, failure.line, failure.function,
               failure.expression, length > 0 ? ", with " : "", length, failure.values.data());
  std::abort();
}

std::atomic<AssertHandler>& current_handler() {
  static constinit std::atomic<AssertHandler> handler{&write_and_abort};
  return handler;
}

// Takes the next name off `names`, which are separated by commas outside brackets and quotes.
std::string_view take_name(std::string_view& names) {
  std::size_t end = 0;
  int depth = 0;
  char quote = 0;
  for (; end < names.size(); ++end) {
    const char c = names[end];
    if (quote != 0) {
      if (c == '\\') {
        ++end;
      } else if (c == quote) {
        quote = 0;
      }
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '(' || c == '[' || c == '{') {
      ++depth;
    } else if (c == ')' || c == ']' || c == '}') {
      --depth;
    } else if (c == ',' && depth == 0) {
      break;
    }
  }
  std::string_view name = names.substr(0, end);
  names.remove_prefix(end < names.size() ? end + 1 : names.size());
  while (!name.empty() && name.front() == ' ') name.remove_prefix(1);
  return name;
}

}  // namespace

namespace detail {

/// Text in its own memory, because an assertion may fail when there is no other. Text that is too long is cut off.
struct AssertText {
  void add(std::string_view text) {
    for (const char c : text) {
      if (size < bytes.size()) bytes[size++] = c;
    }
  }

  template <class Number>
  void add_number(Number number) {
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    add({digits.data(), static_cast<std::size_t>(end - digits.data())});
  }

  template <class Real>
  void add_vector(const double (&v)[3]) {
    for (int axis = 0; axis < 3; ++axis) {
      add(axis == 0 ? "(" : ", ");
      add_number(static_cast<Real>(v[axis]));
    }
    add(")");
  }

  void add_value(const AssertValue& value) {
    using Kind = AssertValue::Kind;
    switch (value.kind_) {
      case Kind::boolean:
        return add(value.natural_ != 0 ? "true" : "false");
      case Kind::integer:
        return add_number(value.integer_);
      case Kind::natural:
        return add_number(value.natural_);
      case Kind::single:
        return add_number(static_cast<float>(value.number_[0]));
      case Kind::number:
        return add_number(value.number_[0]);
      case Kind::single_vector:
        return add_vector<float>(value.number_);
      case Kind::vector:
        return add_vector<double>(value.number_);
      case Kind::text:
        add("\"");
        add({value.text_.data, value.text_.size});
        return add("\"");
      case Kind::pointer:
        if (value.pointer_ == nullptr) return add("null");
        std::array<char, 32> digits;
        add("0x");
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(),
                                       reinterpret_cast<std::uintptr_t>(value.pointer_), 16)
                             .ptr;
        add({digits.data(), static_cast<std::size_t>(end - digits.data())});
        return;
    }
  }

  std::array<char, 1000> bytes;
  std::size_t size = 0;
};

void assertion_failed(const AssertSite& site, std::initializer_list<AssertValue> values) {
  AssertText text;
  std::string_view names = site.names;
  for (const AssertValue& value : values) {
    if (text.size > 0) text.add(", ");
    text.add(take_name(names));
    text.add(" = ");
    text.add_value(value);
  }
  current_handler().load()({site.expression, site.file, site.line, site.function, {text.bytes.data(), text.size}});
  std::abort();
}

}  // namespace detail

AssertHandler set_assert_handler(AssertHandler handler) {
  return current_handler().exchange(handler != nullptr ? handler : &write_and_abort);
}

}  // namespace hooke
