// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/seal.h"

#include <fcntl.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hooke/base/hash.h"
#include "hooke/base/parallel.h"
#include "hooke/base/threads.h"
#include "hooke/io/failure.h"
#include "hooke/io/output_file.h"

namespace hooke::io {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kBlockBytes = std::size_t{1} << 20U;
constexpr int kMostThreads = 4;  // more don't read faster
constexpr std::uint64_t kMagic = 0x324b4843454b4f48;        // "HOKECHK2"
constexpr std::uint64_t kMagicBefore = 0x314b4843454b4f48;  // "HOKECHK1": formats up to 4

struct Seal {
  std::uint64_t magic = kMagic;
  std::uint64_t checksum = 0;  // of all bytes before the seal
};

// The hash of block `index`, which has `bytes` bytes. 0 or errno.
int hash_block(int fd, std::uint64_t index, std::size_t bytes, std::vector<std::uint64_t>& words, std::uint64_t& hash) {
  const std::size_t count = (bytes + sizeof words[0] - 1) / sizeof words[0];
  words.assign(count, 0);  // zeros pad the last word
  if (const int error = read_at(fd, words.data(), bytes, index * kBlockBytes)) return error;
  hash = combine64(index, bytes);
  for (const std::uint64_t word : words) hash = combine64(hash, word);
  return 0;
}

// The checksum of the first `size` bytes of a file.
std::uint64_t checksum_of(int fd, std::uint64_t size, const std::filesystem::path& path) {
  const auto blocks = static_cast<std::size_t>((size + kBlockBytes - 1) / kBlockBytes);
  std::atomic<std::uint64_t> sum = size;
  std::atomic<int> failed = 0;
  const auto hash_blocks = [&](std::size_t first, std::size_t last) {
    std::vector<std::uint64_t> words;
    for (std::size_t k = first; k < last && failed == 0; ++k) {
      std::uint64_t hash = 0;
      const auto bytes = static_cast<std::size_t>(std::min<std::uint64_t>(size - k * kBlockBytes, kBlockBytes));
      if (const int error = hash_block(fd, k, bytes, words, hash)) failed = error;
      sum += hash;
    }
  };
  if (blocks <= 1) {
    hash_blocks(0, blocks);
  } else {
    const auto cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    Threads threads(std::min(cores, kMostThreads));
    threads.run([&] { parallel_ranges(blocks, std::size_t{1}, hash_blocks); });
  }
  if (failed != 0) throw Failure(Error::Kind::io, path, "can't be read: " + system_message(failed));
  return sum;
}

// The last bytes of a file of this size; none where it is too short for a seal.
std::optional<Seal> read_seal(int fd, std::uint64_t size, const std::filesystem::path& path) {
  if (size <= sizeof(Seal)) return std::nullopt;
  Seal seal;
  if (const int error = read_at(fd, &seal, sizeof seal, size - sizeof seal)) {
    throw Failure(Error::Kind::io, path, "can't be read: " + system_message(error));
  }
  return seal;
}

}  // namespace

void append_seal(const std::filesystem::path& file) {
  const Descriptor opened(::open(file.c_str(), O_RDWR | O_CLOEXEC));
  const std::uint64_t size = size_of(opened.get(), file);
  Seal seal;
  seal.checksum = checksum_of(opened.get(), size, file);
  if (const int error = write_at(opened.get(), &seal, sizeof seal, size)) {
    throw Failure(Error::Kind::io, file, "can't be written: " + system_message(error));
  }
}

void check_seal(const std::filesystem::path& file) {
  const Descriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!opened) throw Failure(Error::Kind::bad_input, file, "can't be opened: " + system_message(errno));
  const std::uint64_t size = size_of(opened.get(), file);
  if (size == 0) throw Failure(Error::Kind::bad_input, file, "is empty");
  const std::optional<Seal> seal = read_seal(opened.get(), size, file);
  if (seal && seal->magic == kMagicBefore) {
    throw Failure(Error::Kind::bad_input, file, "is a checkpoint of an earlier version, which this program can't read");
  }
  if (!seal || seal->magic != kMagic) {
    throw Failure(Error::Kind::bad_input, file, "is no checkpoint of Hooke's, or is cut short");
  }
  if (seal->checksum != checksum_of(opened.get(), size - sizeof(Seal), file)) {
    throw Failure(Error::Kind::bad_input, file, "is a damaged checkpoint: its checksum is wrong");
  }
}

bool has_seal(const std::filesystem::path& file) {
  const Descriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!opened) throw Failure(Error::Kind::io, file, "can't be read: " + system_message(errno));
  const std::optional<Seal> seal = read_seal(opened.get(), size_of(opened.get(), file), file);
  return seal && (seal->magic == kMagic || seal->magic == kMagicBefore);
}

}  // namespace hooke::io
