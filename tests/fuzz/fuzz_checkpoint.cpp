// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// A checkpoint whose seal is right, as somebody would make it.
#include <cstring>

#include "fuzz/input.h"
#include "hooke/base/hash.h"
#include "hooke/io/checkpoint.h"
#include "hooke/io/describe_file.h"

namespace {

std::string sealed(std::string bytes) {
  std::uint64_t sum = bytes.size();
  for (std::size_t at = 0; at < bytes.size(); at += sizeof sum) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min(sizeof word, bytes.size() - at));
    sum = hooke::combine64(sum, word);
  }
  bytes.append("HOKECHK1").append(reinterpret_cast<const char*>(&sum), sizeof sum);
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hooke;
  static const fuzz::InputFile file(".h5");
  const std::filesystem::path& path = file.write(sealed(std::string(fuzz::text_of(data, size))));
  if (const auto checkpoint = io::read_checkpoint(path); !checkpoint) {
    fuzz::require_readable(checkpoint.error());
  } else {
    fuzz::require(checkpoint->state.particles.columns_fit(), "columns have one length");
  }
  if (const auto described = io::describe_file(path); !described) fuzz::require_readable(described.error());
  return 0;
}
