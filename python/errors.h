// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <type_traits>
#include <utility>

#include "hooke/base/expected.h"

namespace hooke::python {

namespace py = pybind11;

/// A class of hooke/_errors.py.
enum class ErrorClass { scene, input, run_failed, file, busy, closed };

/// Raises the Python exception that carries all findings.
[[noreturn]] void raise(ErrorClass type, const std::vector<Finding>& findings);
[[noreturn]] inline void raise_input(std::string where, std::string message) {
  raise(ErrorClass::input, {{std::move(where), std::move(message)}});
}

/// Raises what an Error is in Python. `bad_input`: the class of Error::Kind::bad_input.
[[noreturn]] void raise(const Error& error, ErrorClass bad_input = ErrorClass::input);

/// The value, or the exception. To be called with the GIL.
template <class T>
T unwrap(Expected<T>&& expected, ErrorClass bad_input = ErrorClass::input) {
  if (!expected) raise(expected.error(), bad_input);
  if constexpr (!std::is_void_v<T>) return std::move(*expected);
}

/// Findings as a Python list of hooke.Finding.
py::list to_list(const std::vector<Finding>& findings);

}  // namespace hooke::python
