// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <type_traits>

#include "hooke/base/real.h"

/// 1 where assertions are checked, else 0. CMake's option of the same name sets it for Hooke's libraries and, as a
/// usage requirement, for every program that links them. Inline functions of Hooke's headers hold assertions, so a
/// program in which only some files check them would have two definitions of one function, of which the linker keeps
/// either. A build by other means must define it alike for all files.
#if !defined(HOOKE_ASSERTIONS)
#define HOOKE_ASSERTIONS 0
#endif

// For the host only; never emitted out of line in an object file.
#define HOOKE_INLINED inline __attribute__((always_inline))

namespace hooke {

/// An assertion that does not hold. Its texts are valid only during the call of the handler.
struct AssertionFailure {
  const char* expression;   ///< as written: "index < count"
  const char* file;         ///< as the compiler calls it
  int line;
  const char* function;     ///< without the class name
  std::string_view values;  ///< "index = 7, count = 5"; empty where the assertion names none
};

/// Called when an assertion does not hold, by any thread, or by several at once. It may end the program or, as tests
/// do, throw; if it returns, the program is aborted, because the following code relies on the assertion. If its
/// exception reaches a function that lets none out, std::terminate is called.
using AssertHandler = void (*)(const AssertionFailure& failure);

/// Sets this program's handler, or the default handler if null, and returns the previous one. The default handler
/// writes one line to stderr and aborts. A program and a shared library that each link Hooke have separate handlers.
AssertHandler set_assert_handler(AssertHandler handler);

namespace detail {

template <class T>
inline constexpr bool kNeverTrue = false;

/// A value that an assertion shows: a number, a bool, an enumerator (its number), a vector, a string or a pointer.
/// Entirely inlined, so that files of different instruction sets share no function.
class AssertValue {
 public:
  enum class Kind : unsigned char { boolean, integer, natural, single, number, single_vector, vector, text, pointer };

  template <class T>
  HOOKE_INLINED AssertValue(const T& value) {  // NOLINT: the values of an assertion are lists of anything
    if constexpr (std::is_same_v<T, bool>) {
      set_natural(Kind::boolean, value ? 1 : 0);
    } else if constexpr (std::is_enum_v<T>) {
      set_integer(static_cast<long long>(value));
    } else if constexpr (std::is_integral_v<T> && std::is_signed_v<T>) {
      set_integer(value);
    } else if constexpr (std::is_integral_v<T>) {
      set_natural(Kind::natural, value);
    } else if constexpr (std::is_floating_point_v<T>) {
      kind_ = sizeof(T) == sizeof(float) ? Kind::single : Kind::number;
      number_[0] = static_cast<double>(value);
    } else if constexpr (std::is_null_pointer_v<T>) {
      set_pointer(nullptr);
    } else if constexpr (std::is_convertible_v<const T&, const char*>) {
      const char* const text = value;
      text == nullptr ? set_pointer(text) : set_text(text);
    } else if constexpr (std::is_convertible_v<const T&, std::string_view>) {
      set_text(value);
    } else if constexpr (std::is_pointer_v<T>) {
      set_pointer(value);
    } else if constexpr (requires { value.x + value.y + value.z; }) {
      kind_ = sizeof value.x == sizeof(float) ? Kind::single_vector : Kind::vector;
      number_[0] = static_cast<double>(value.x);
      number_[1] = static_cast<double>(value.y);
      number_[2] = static_cast<double>(value.z);
    } else {
      static_assert(kNeverTrue<T>, "an assertion can't show a value of this type");
    }
  }

 private:
  friend struct AssertText;

  HOOKE_INLINED void set_integer(long long value) {
    kind_ = Kind::integer;
    integer_ = value;
  }
  HOOKE_INLINED void set_natural(Kind kind, unsigned long long value) {
    kind_ = kind;
    natural_ = value;
  }
  HOOKE_INLINED void set_text(std::string_view value) {
    kind_ = Kind::text;
    text_ = {value.data(), value.size()};
  }
  HOOKE_INLINED void set_pointer(const void* value) {
    kind_ = Kind::pointer;
    pointer_ = value;
  }

  struct Text {
    const char* data;
    std::size_t size;
  };

  Kind kind_;
  union {
    long long integer_;
    unsigned long long natural_;
    double number_[3];
    Text text_;
    const void* pointer_;
  };
};

/// The place of an assertion in the source.
struct AssertSite {
  const char* expression;
  const char* names;  ///< of the values, as written
  const char* file;
  int line;
  const char* function;
};

/// Calls the handler. Compiled once, for any processor.
[[noreturn, gnu::cold]] void assertion_failed(const AssertSite& site, std::initializer_list<AssertValue> values);

/// Never called: lets the compiler check the values of a disabled assertion.
HOOKE_INLINED bool are_values(std::initializer_list<AssertValue>) { return true; }

}  // namespace detail
}  // namespace hooke

/// HOOKE_ASSERT(expression, values...): if the expression does not hold, the program has a mistake. The message shows
/// up to about a dozen values: HOOKE_ASSERT(index < count, index, count). Without HOOKE_ASSERTIONS, and in files that
/// nvcc compiles, neither is evaluated, but the expression must compile.
///
/// Only for mistakes of programmers: a mistake that a user can make is an Error (expected.h). A program with its own
/// macro may define it before it includes any header of Hooke, the same for all its files.
#if !defined(HOOKE_ASSERT)
#if defined(__CUDACC__)
#define HOOKE_ASSERT(expression, ...) static_cast<void>(sizeof(static_cast<bool>(expression)))
#elif HOOKE_ASSERTIONS
#define HOOKE_ASSERT(expression, ...)                                                                          \
  do {                                                                                                         \
    if (!(expression)) [[unlikely]] {                                                                          \
      ::hooke::detail::assertion_failed(                                                                       \
          {#expression, #__VA_ARGS__, __FILE__, __LINE__, static_cast<const char*>(__func__)}, {__VA_ARGS__}); \
    }                                                                                                          \
  } while (false)
#else
#define HOOKE_ASSERT(expression, ...) \
  static_cast<void>(false && static_cast<bool>(expression) && ::hooke::detail::are_values({__VA_ARGS__}))
#endif
#endif
