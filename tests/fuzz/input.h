// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "hooke/base/expected.h"

namespace hooke::fuzz {

/// Ends the program, which libFuzzer reports with the input, where a reader does what none may do.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

/// A finding tells something, in one line that a terminal can show whatever the input was.
inline void require_readable(const Finding& finding) {
  const std::string text = finding.where + finding.message;
  require(!finding.message.empty(), "a finding says what is wrong");
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    require(byte >= 0x20 && byte != 0x7f, "a finding has no control characters");
  }
}

inline void require_readable(const Error& error) {
  require(!error.findings.empty(), "an error has findings");
  for (const Finding& finding : error.findings) require_readable(finding);
}

/// A file of this process that holds the input of the moment, in the folder for temporary files.
class InputFile {
 public:
  explicit InputFile(const std::string& extension)
      : folder_(std::filesystem::temp_directory_path() / ("hooke_fuzz_" + std::to_string(getpid()))),
        path_(folder_ / ("input" + extension)) {
    std::filesystem::create_directories(folder_);
  }
  ~InputFile() { std::filesystem::remove_all(folder_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::filesystem::path& write(std::string_view bytes) const {
    std::FILE* file = std::fopen(path_.c_str(), "wb");
    require(file != nullptr, "the input can be written");
    require(std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size(), "the input can be written");
    std::fclose(file);
    return path_;
  }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_, path_;
};

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace hooke::fuzz
