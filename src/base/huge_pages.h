// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace hooke {

/// Memory for large arrays that are not read in order: on pages of 2 MiB where the system grants them, so that a step
/// of half a million particles does not spend its time looking up addresses. Smaller arrays use ordinary memory.
template <class T>
struct HugePageAllocator {
  using value_type = T;

  HugePageAllocator() = default;
  template <class U>
  HugePageAllocator(const HugePageAllocator<U>&) {}  // NOLINT: allocators of different types stand for each other

  T* allocate(std::size_t count) {
    if (count > static_cast<std::size_t>(-1) / sizeof(T) / 2) throw std::bad_array_new_length();
    const std::size_t bytes = count * sizeof(T);
    if (bytes < kPage) return static_cast<T*>(::operator new(bytes, std::align_val_t{alignment()}));
    const std::size_t whole_pages = (bytes + kPage - 1) / kPage * kPage;
    void* memory = std::aligned_alloc(kPage, whole_pages);
    if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
    // A hint: if it fails, ordinary pages are used, as they are for the remainder that would not fill a huge page.
    madvise(memory, bytes / kPage * kPage, MADV_HUGEPAGE);
#endif
    return static_cast<T*>(memory);
  }

  void deallocate(T* memory, std::size_t count) {
    if (count * sizeof(T) < kPage) {
      ::operator delete(memory, std::align_val_t{alignment()});
    } else {
      std::free(memory);
    }
  }

  friend bool operator==(const HugePageAllocator&, const HugePageAllocator&) { return true; }

 private:
  static constexpr std::size_t kPage = std::size_t{2} << 20U;
  static constexpr std::size_t alignment() { return alignof(T) > 64 ? alignof(T) : 64; }
};

/// A vector for millions of elements.
template <class T>
using LargeVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace hooke
