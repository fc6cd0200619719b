// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <type_traits>

#include "hooke/base/real.h"

/// 1 where assertions are checked, else 0. CMake's option of the same name gives it to Hooke's libraries and, as part
/// of their usage requirements, to every program that links them: inline functions of Hooke's headers hold assertions,
/// and a program in which some files check them and others don't has two definitions of one function, of which the
/// linker keeps either. Whoever builds by other means defines it alike for all files.
#if !defined(HOOKE_ASSERTIONS)
#define HOOKE_ASSERTIONS 0
#endif

// Of the host alone, and in no file's object code by itself.
#define HOOKE_INLINED inline __attribute__((always_inline))

namespace hooke {

/// An assertion that does not hold. Texts live as long as the call of the handler.
struct AssertionFailure {
  const char* expression;   ///< as it is written: "index < count"
  const char* file;         ///< as the compiler calls it
  int line;
  const char* function;     ///< without its class
  std::string_view values;  ///< "index = 7, count = 5"; empty where the assertion names none
};

/// What happens when an assertion does not hold. Any thread may call it, several at once. It may end the program or, as
/// tests do, throw; where it returns, the program is aborted, because what follows an assertion relies on it. What it
/// throws may pass through functions that leave no exception out: std::terminate is called there.
using AssertHandler = void (*)(const AssertionFailure& failure);

/// Sets the handler of this program, the default one where it is null, and returns the one before. The default handler
/// writes one line to stderr and aborts. A program and a shared library that each link Hooke have a handler each.
AssertHandler set_assert_handler(AssertHandler handler);

namespace detail {

template <class T>
inline constexpr bool kNeverTrue = false;

/// A value that an assertion shows: a number, a bool, an enumerator (its number), a vector, a string or a pointer. All
/// inlined, so that files of different instruction sets share no function.
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

/// Where an assertion stands.
struct AssertSite {
  const char* expression;
  const char* names;  ///< of the values, as they are written
  const char* file;
  int line;
  const char* function;
};

/// Calls the handler. Compiled once, for any processor.
[[noreturn, gnu::cold]] void assertion_failed(const AssertSite& site, std::initializer_list<AssertValue> values);

/// Never called: lets the compiler look at the values of an assertion that is off.
HOOKE_INLINED bool are_values(std::initializer_list<AssertValue>) { return true; }

}  // namespace detail
}  // namespace hooke

/// HOOKE_ASSERT(expression, values...): the expression holds, or the program has a mistake. Up to about a dozen values
/// are shown beside it: HOOKE_ASSERT(index < count, index, count). Without HOOKE_ASSERTIONS, and in files that nvcc
/// compiles, neither is evaluated, but the expression must compile.
///
/// For mistakes of programmers alone: what a user can get wrong is an Error (expected.h). A program that has its own
/// way may define the macro before it includes anything of Hooke's, the same for all its files.
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
