// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>
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

template <class T>
using Expected = tl::expected<T, Error>;

/// `return fail(Error::Kind::io, path, "can't be opened");`
inline tl::unexpected<Error> fail(Error::Kind kind, std::string where, std::string message) {
  return tl::unexpected<Error>(Error{kind, {{std::move(where), std::move(message)}}});
}
inline tl::unexpected<Error> fail(Error error) {
  HOOKE_ASSERT(!error.findings.empty());
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace hooke
