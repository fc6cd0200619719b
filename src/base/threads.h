// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

namespace hooke {

/// Threads to run on, at least one: oneTBB's, or Hooke's own in a build without it (HOOKE_WITH_TBB). There may be more
/// threads than the machine has cores.
class Threads {
 public:
  explicit Threads(int count);
  ~Threads();
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  int count() const { return count_; }

  /// body() on the calling thread, with Hooke's floating-point modes; what it gives parallel_ranges() runs on these
  /// threads.
  template <class Body>
  void run(const Body& body) {
    run(&body, [](const void* of) { (*static_cast<const Body*>(of))(); });
  }

 private:
  struct Arena;

  void run(const void* body, void (*call)(const void* body));

  int count_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace hooke
