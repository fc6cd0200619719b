// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "program.h"

namespace hooke::test {

/// A block of code of a page.
struct CodeBlock {
  enum class Kind {
    fenced,    ///< between lines of ```
    indented,  ///< by four blanks
    inside,    ///< between ` in a line of text
  };
  Kind kind = Kind::fenced;
  std::string language;  ///< of a fenced one: the word after ```, "sh"
  std::string name;      ///< the word after that: the file that it is, or "fails" of commands that end with status 2
  std::string text;
  std::size_t line = 0;  ///< where it begins, from 1
};

/// All blocks of code of a page, in its order.
std::vector<CodeBlock> blocks_of(const std::filesystem::path& page);

/// The text of a file.
std::string contents(const std::filesystem::path& file);

/// A test that does what a page says, in its own folder, with the program under test and Debian's Python.
class PageTest : public ProgramTest {
 protected:
  PageTest();

  /// Runs a script; expects that exit status; returns all that it prints.
  std::string shell(const std::string& script, int status = 0) const;

  /// Writes each fenced block that is a file, runs each of "sh", and expects that each scene among them is one. Returns
  /// what the commands print. Stops at the first failure.
  std::string follow(const std::filesystem::path& page) const;
};

}  // namespace hooke::test
