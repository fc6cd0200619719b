// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace hooke {

/// While it exists, this thread rounds to nearest and keeps denormal numbers, whatever the program around Hooke has
/// set: with flush-to-zero the same scene would give other bits (docs/determinism.md).
class FloatingPointGuard {
 public:
#if defined(__SSE2__)
  FloatingPointGuard() : saved_(_mm_getcsr()) {
    if (saved_ != kDefault) _mm_setcsr(kDefault);
  }
  ~FloatingPointGuard() {
    if (saved_ != kDefault) _mm_setcsr(saved_);
  }

 private:
  static constexpr unsigned kDefault = 0x1f80;  // all exceptions masked, to nearest, no FTZ, no DAZ
  unsigned saved_;
#elif defined(__aarch64__)
  FloatingPointGuard() {
    asm volatile("mrs %0, fpcr" : "=r"(saved_));
    if (saved_ != kDefault) asm volatile("msr fpcr, %0" : : "r"(kDefault));
  }
  ~FloatingPointGuard() {
    if (saved_ != kDefault) asm volatile("msr fpcr, %0" : : "r"(saved_));
  }

 private:
  static constexpr unsigned long kDefault = 0;  // the same on this processor
  unsigned long saved_ = kDefault;
#else
  FloatingPointGuard() = default;
  ~FloatingPointGuard() = default;
#endif

 public:
  FloatingPointGuard(const FloatingPointGuard&) = delete;
  FloatingPointGuard& operator=(const FloatingPointGuard&) = delete;
};

}  // namespace hooke
