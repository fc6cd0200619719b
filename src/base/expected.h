// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "hooke/base/assert.h"

namespace hooke {

/// One fault, and its place.
struct Finding {
  std::string where;    ///< JSON path ("materials.water.radius"), "file.csv:12", or a file's name; may be empty
  std::string message;  ///< what is wrong, the value, and what is allowed

  friend bool operator==(const Finding&, const Finding&) = default;
};

/// Why an operation failed. Errors are values: Hooke's libraries never print or exit, and no exception leaves a public
/// function.
struct Error {
  enum class Kind {
    bad_input,   ///< the caller's input can't be used (exit status 2)
    run_failed,  ///< a simulation went bad (exit status 3)
    io,          ///< a file could not be read or written (3 while running, 2 before)
  };
  Kind kind = Kind::bad_input;
  std::vector<Finding> findings;  ///< all findings at once, at least one

  /// All findings, one per line, "where: message".
  std::string text() const {
    std::string all;
    for (const Finding& f : findings) {
      if (!all.empty()) all += '\n';
      all += f.where.empty() ? f.message : f.where + ": " + f.message;
    }
    return all;
  }
};

/// What Expected::value() throws where there is an error: for programs that report errors by exceptions.
class BadExpectedAccess : public std::exception {
 public:
  explicit BadExpectedAccess(Error error)
      : shared_(std::make_shared<const std::pair<Error, std::string>>(error, error.text())) {}
  const Error& error() const { return shared_->first; }
  const char* what() const noexcept override { return shared_->second.c_str(); }

 private:
  std::shared_ptr<const std::pair<Error, std::string>> shared_;  // exceptions are copied
};

/// An error that is on its way out of a function: what fail() returns and every Expected takes.
struct Unexpected {
  Error error;
};

/// `return fail(Error::Kind::io, path, "can't be opened");`
inline Unexpected fail(Error::Kind kind, std::string where, std::string message) {
  return {Error{kind, {{std::move(where), std::move(message)}}}};
}
inline Unexpected fail(Error error) {
  HOOKE_ASSERT(!error.findings.empty());
  return {std::move(error)};
}

/// A value, or the error for which there is none: C++23's std::expected<T, Error>, the part of it that is used here,
/// with its names. T may be void.
template <class T>
class [[nodiscard]] Expected {
 public:
  using value_type = T;
  using error_type = Error;

  Expected()
    requires std::default_initializable<T>
  = default;
  template <class U = T>
    requires(std::constructible_from<T, U> && !std::same_as<std::remove_cvref_t<U>, Expected> &&
             !std::same_as<std::remove_cvref_t<U>, Unexpected>)
  explicit(!std::convertible_to<U, T>) Expected(U&& value)  // NOLINT: values are returned as they are
      : state_(std::in_place_index<0>, std::forward<U>(value)) {}
  Expected(Unexpected unexpected) : state_(std::in_place_index<1>, std::move(unexpected.error)) {}  // NOLINT: likewise

  bool has_value() const noexcept { return state_.index() == 0; }
  explicit operator bool() const noexcept { return has_value(); }

  /// The value, which must be there.
  T& operator*() & { return *present(); }
  const T& operator*() const& { return *present(); }
  T&& operator*() && { return std::move(*present()); }
  T* operator->() { return present(); }
  const T* operator->() const { return present(); }

  /// The value; throws BadExpectedAccess where there is an error.
  T& value() & { return check(), *present(); }
  const T& value() const& { return check(), *present(); }
  T&& value() && { return check(), std::move(*present()); }
  template <class U>
  T value_or(U&& other) const& {
    return has_value() ? *present() : static_cast<T>(std::forward<U>(other));
  }
  template <class U>
  T value_or(U&& other) && {
    return has_value() ? std::move(*present()) : static_cast<T>(std::forward<U>(other));
  }

  /// The error, which must be there.
  Error& error() & { return *absent(); }
  const Error& error() const& { return *absent(); }
  Error&& error() && { return std::move(*absent()); }

 private:
  void check() const {
    if (!has_value()) throw BadExpectedAccess(error());
  }
  T* present() { return const_cast<T*>(std::as_const(*this).present()); }
  const T* present() const {
    HOOKE_ASSERT(has_value());
    return std::get_if<0>(&state_);
  }
  Error* absent() { return const_cast<Error*>(std::as_const(*this).absent()); }
  const Error* absent() const {
    HOOKE_ASSERT(!has_value());
    return std::get_if<1>(&state_);
  }

  std::variant<T, Error> state_;
};

/// Success, or why there was none.
template <>
class [[nodiscard]] Expected<void> {
 public:
  using value_type = void;
  using error_type = Error;

  Expected() = default;
  Expected(Unexpected unexpected) : error_(std::move(unexpected.error)) {}  // NOLINT: errors are returned as they are

  bool has_value() const noexcept { return !error_.has_value(); }
  explicit operator bool() const noexcept { return has_value(); }
  void operator*() const { HOOKE_ASSERT(has_value()); }
  /// Throws BadExpectedAccess where there is an error.
  void value() const {
    if (error_) throw BadExpectedAccess(*error_);
  }

  /// The error, which must be there.
  Error& error() & { return const_cast<Error&>(std::as_const(*this).error()); }
  const Error& error() const& {
    HOOKE_ASSERT(!has_value());
    return *error_;
  }
  Error&& error() && { return std::move(error()); }

 private:
  std::optional<Error> error_;
};

}  // namespace hooke
