// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "hooke/base/expected.h"

namespace hooke::scene {

/// All bytes of a file; an error names the file if it can't be opened or read, or holds more than `most` bytes.
Expected<std::string> read_text_file(const std::filesystem::path& file, std::uint64_t most);

}  // namespace hooke::scene
