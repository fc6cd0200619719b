// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/fletcher32.h"

#include <algorithm>

namespace hooke::io {

namespace {

/// Modulo 65535, but a multiple of it that is not 0 stays 65535.
std::uint64_t folded(std::uint64_t sum) {
  while (sum > 0xffff) sum = (sum & 0xffffU) + (sum >> 16U);
  return sum;
}

}  // namespace

std::uint32_t fletcher32(std::string_view bytes) {
  constexpr std::size_t kBlockBytes = std::size_t{1} << 20U;  // so many that no sum overflows
  std::uint64_t words = 0, sums = 0;
  for (std::size_t start = 0; start < bytes.size(); start += kBlockBytes) {
    const std::size_t end = std::min(bytes.size(), start + kBlockBytes);
    for (std::size_t i = start; i < end; i += 2) {
      const std::uint32_t high = static_cast<unsigned char>(bytes[i]);
      const std::uint32_t low = i + 1 < end ? static_cast<unsigned char>(bytes[i + 1]) : 0;
      words += high << 8U | low;
      sums += words;
    }
    words = folded(words);
    sums = folded(sums);
  }
  return static_cast<std::uint32_t>(sums << 16U | words);
}

void append_fletcher32(std::string& bytes) {
  const std::uint32_t checksum = fletcher32(bytes);
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(checksum >> shift & 0xffU);
}

}  // namespace hooke::io
