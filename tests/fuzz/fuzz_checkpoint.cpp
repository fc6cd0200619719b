// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// A checkpoint whose seal is right, as somebody would make it.
#include "fuzz/input.h"
#include "hooke/io/checkpoint.h"
#include "hooke/io/describe_file.h"
#include "hooke/io/seal.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hooke;
  static const fuzz::InputFile file(".h5");
  const std::filesystem::path& path = file.write(fuzz::text_of(data, size));
  io::append_seal(path);
  if (const auto checkpoint = io::read_checkpoint(path); !checkpoint) {
    fuzz::require_readable(checkpoint.error());
  } else {
    fuzz::require(checkpoint->state.particles.columns_fit(), "columns have one length");
  }
  if (const auto described = io::describe_file(path); !described) fuzz::require_readable(described.error());
  return 0;
}
