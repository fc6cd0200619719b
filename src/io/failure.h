// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <filesystem>
#include <string>
#include <utility>

#include "hooke/base/assert.h"
#include "hooke/base/expected.h"

namespace hooke::io {

/// The exception by which the inner functions of this library report errors: hundreds of HDF5 calls can each fail. It
/// leaves no public function; guarded() turns it into an Error.
class Failure : public std::exception {
 public:
  Failure(Error::Kind kind, const std::filesystem::path& file, std::string message)
      : error_{kind, {{file.string(), std::move(message)}}} {}
  explicit Failure(Error error) : error_(std::move(error)) { HOOKE_ASSERT(!error_.findings.empty()); }

  const Error& error() const { return error_; }
  const char* what() const noexcept override { return error_.findings.front().message.c_str(); }

 private:
  Error error_;
};

/// Calls `work`, which returns a T or throws, and returns an Expected<T>.
template <class Work>
auto guarded(const std::filesystem::path& file, Work&& work) noexcept -> Expected<decltype(work())> {
  try {
    if constexpr (std::is_void_v<decltype(work())>) {
      work();
      return {};
    } else {
      return work();
    }
  } catch (const Failure& failure) {
    return fail(failure.error());
  } catch (const std::bad_alloc&) {
    return fail(Error::Kind::io, file.string(), "there is not enough memory for it");
  } catch (const std::exception& other) {
    return fail(Error::Kind::io, file.string(), other.what());
  }
}

/// Returns the value of `expected` or throws its error.
template <class T>
T take(Expected<T> expected) {
  if (!expected) throw Failure(std::move(expected.error()));
  if constexpr (!std::is_void_v<T>) return std::move(*expected);
}

/// The same for an error that names no file: if thrown, it names `file`.
template <class T>
T take(Expected<T> expected, const std::filesystem::path& file) {
  if (!expected) expected.error().findings.front().where = file.string();
  return take(std::move(expected));
}

}  // namespace hooke::io
