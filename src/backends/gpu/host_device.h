// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <numeric>
#include <thread>
#include <utility>
#include <vector>

#include "hooke/backends/gpu/device.h"
#include "hooke/core/backend.h"

namespace hooke::gpu {

/// In which order items run: what depends on it is wrong on a GPU.
enum class ItemOrder {
  up,
  down,
  shuffled,  ///< from the middle up, then from the middle down
  threads,   ///< item i on thread i mod 3: the thread sanitizer sees what items of a GPU do to each other's data
};

/// A loop in place of a GPU, to test kernels where there is none: debuggers and sanitizers see what each item does.
/// New memory is full of NaN, or of numbers that lead outside of every array.
class HostDevice {
 public:
  /// What has been asked of a device and its copies.
  struct Use {
    std::size_t bytes = 0;        ///< allocated now
    std::size_t most_bytes = ~std::size_t{0};  ///< that it has
    std::size_t allocations = 0;  ///< so far
    std::size_t downloads = 0;    ///< so far: each waits for the work before it
    std::size_t launches_left = ~std::size_t{0};  ///< until it fails
  };

  explicit HostDevice(ItemOrder order = ItemOrder::shuffled, std::shared_ptr<Use> use = std::make_shared<Use>())
      : order_(order),
        use_(std::move(use)) {}

  template <class Kernel>
  void each(std::uint32_t count, const Kernel& kernel) const {
    if (use_->launches_left-- == 0) throw DeviceFailure("the host's stand-in for a GPU has failed");
    switch (order_) {
      case ItemOrder::up:
        for (std::uint32_t i = 0; i < count; ++i) kernel(i);
        return;
      case ItemOrder::down:
        for (std::uint32_t i = count; i-- > 0;) kernel(i);
        return;
      case ItemOrder::shuffled:
        for (std::uint32_t i = count / 2; i < count; ++i) kernel(i);
        for (std::uint32_t i = count / 2; i-- > 0;) kernel(i);
        return;
      case ItemOrder::threads: {
        constexpr std::uint32_t kThreads = 3;
        std::vector<std::thread> threads;
        for (std::uint32_t t = 0; t < kThreads; ++t) {
          threads.emplace_back([&, t] {
            for (std::uint32_t i = t; i < count; i += kThreads) kernel(i);
          });
        }
        for (std::thread& thread : threads) thread.join();
        return;
      }
    }
  }

  void scan(std::uint32_t* values, std::size_t count) const {
    std::exclusive_scan(values, values + count, values, std::uint32_t{0});
  }

  void* allocate(std::size_t bytes) {
    const std::size_t whole = (bytes + kAlignment - 1) / kAlignment * kAlignment;
    if (use_->bytes + whole > use_->most_bytes) throw OutOfMemory("the host's stand-in for a GPU has no more memory");
    // Its size lies before it.
    auto* const memory = static_cast<std::byte*>(std::aligned_alloc(kAlignment, whole + kAlignment));
    if (memory == nullptr) throw OutOfMemory("the host has no more memory");
    std::memcpy(memory, &whole, sizeof whole);
    std::memset(memory + kAlignment, 0xff, whole);
    use_->bytes += whole;
    ++use_->allocations;
    return memory + kAlignment;
  }
  void free(void* memory) const {
    auto* const start = static_cast<std::byte*>(memory) - kAlignment;
    std::size_t whole = 0;
    std::memcpy(&whole, start, sizeof whole);
    use_->bytes -= whole;
    std::free(start);
  }

  void fill(void* to, int byte, std::size_t bytes) const { std::memset(to, byte, bytes); }
  void upload(void* to, const void* from, std::size_t bytes) const { std::memcpy(to, from, bytes); }
  void download(void* to, const void* from, std::size_t bytes) const {
    ++use_->downloads;
    std::memcpy(to, from, bytes);
  }
  void copy(void* to, const void* from, std::size_t bytes) const { std::memcpy(to, from, bytes); }

  const char* name() const { return "host"; }

 private:
  static constexpr std::size_t kAlignment = 256;

  ItemOrder order_;
  std::shared_ptr<Use> use_;
};

}  // namespace hooke::gpu
