// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <string>
#include <utility>

#include "hooke/base/real.h"

namespace hooke::gpu {

// Where kernels run. A kernel is an object whose operator()(i) does item i of many; items run in no order and at the
// same time, and talk to each other by the atomic functions below alone. A Device has
//
//   each(count, kernel)           runs items 0 to count - 1; launches come to their turn in order
//   scan(values, count)           values[i] = sum of the values before it
//   allocate(bytes), free(p)      its memory, aligned to 256 bytes; throws OutOfMemory
//   fill(p, byte, bytes)          sets memory
//   upload(to, from, bytes)       from the host's memory, which may change when it returns
//   download(to, from, bytes)     waits for all work so far
//   copy(to, from, bytes)         within its memory
//   name()                        "NVIDIA H200"
//
// and throws DeviceFailure (core/backend.h) where it fails.
//
// HostDevice (host_device.h) runs items in a loop, CudaDevice (cuda_device.h) on a GPU; both compile the same kernels.

/// The device's memory does not suffice.
class OutOfMemory : public std::bad_alloc {
 public:
  explicit OutOfMemory(std::string what) : what_(std::move(what)) {}
  const char* what() const noexcept override { return what_.c_str(); }

 private:
  std::string what_;
};

/// Adds to a counter that many items change, and returns what it was before.
HOOKE_HD std::uint32_t add_to(std::uint32_t* counter, std::uint32_t a) {
#if defined(__CUDA_ARCH__)
  return atomicAdd(counter, a);
#else
  return __atomic_fetch_add(counter, a, __ATOMIC_RELAXED);
#endif
}
HOOKE_HD void add_to(unsigned long long* sum, unsigned long long a) {
#if defined(__CUDA_ARCH__)
  atomicAdd(sum, a);
#else
  __atomic_fetch_add(sum, a, __ATOMIC_RELAXED);
#endif
}

/// Raises a number that many items change to at least `a`.
HOOKE_HD void raise_to(std::uint32_t* number, std::uint32_t a) {
#if defined(__CUDA_ARCH__)
  atomicMax(number, a);
#else
  std::uint32_t now = __atomic_load_n(number, __ATOMIC_RELAXED);
  while (now < a && !__atomic_compare_exchange_n(number, &now, a, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {}
#endif
}

/// Reads a number that other items may change at the same time.
HOOKE_HD std::uint32_t now_at(const std::uint32_t* number) {
#if defined(__CUDA_ARCH__)
  return *static_cast<const volatile std::uint32_t*>(number);
#else
  return __atomic_load_n(number, __ATOMIC_RELAXED);
#endif
}

/// An array in a device's memory. Its owner keeps the device.
template <class Device, class T>
class Buffer {
 public:
  explicit Buffer(Device& device) : device_(&device) {}
  Buffer(Buffer&& other) noexcept
      : device_(other.device_),
        data_(std::exchange(other.data_, nullptr)),
        room_(std::exchange(other.room_, 0)) {}
  Buffer& operator=(Buffer&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(data_, other.data_);
    std::swap(room_, other.room_);
    return *this;
  }
  ~Buffer() {
    if (data_ != nullptr) device_->free(data_);
  }

  T* data() { return data_; }
  const T* data() const { return data_; }
  std::size_t room() const { return room_; }

  /// Makes room for `count` elements; what is there is lost where there was less room.
  void reserve(std::size_t count) {
    if (count <= room_) return;
    if (data_ != nullptr) device_->free(std::exchange(data_, nullptr));
    room_ = 0;
    data_ = static_cast<T*>(device_->allocate(count * sizeof(T)));
    room_ = count;
  }
  /// The same; the first `kept` elements stay.
  void grow(std::size_t count, std::size_t kept) {
    if (count <= room_) return;
    Buffer larger(*device_);
    larger.reserve(count);
    if (kept > 0) device_->copy(larger.data_, data_, kept * sizeof(T));
    *this = std::move(larger);
  }

  /// Makes it hold these elements, whatever it held before.
  void hold(const T* from, std::size_t count) {
    reserve(count);
    upload(from, count);
  }
  template <class Container>
  void hold(const Container& from) {
    hold(from.data(), from.size());
  }
  void upload(const T* from, std::size_t count, std::size_t at = 0) {
    if (count > 0) device_->upload(data_ + at, from, count * sizeof(T));
  }
  void download(T* to, std::size_t count, std::size_t at = 0) const {
    if (count > 0) device_->download(to, data_ + at, count * sizeof(T));
  }
  void fill(int byte, std::size_t count) {
    if (count > 0) device_->fill(data_, byte, count * sizeof(T));
  }

 private:
  Device* device_;
  T* data_ = nullptr;
  std::size_t room_ = 0;
};

}  // namespace hooke::gpu
