// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "hooke/core/snapshot.h"

namespace hooke {

/// Reuses the memory of snapshots that all readers have released: to allocate the columns of half a million particles
/// costs more than to fill them. Any thread may release.
class SnapshotPool {
 public:
  /// A snapshot to be filled; it still has old content.
  std::shared_ptr<Snapshot> take() {
    std::unique_ptr<Snapshot> snapshot = spares_->pop();
    if (!snapshot) snapshot = std::make_unique<Snapshot>();
    // The deleter shares the spares, so that a snapshot may outlive the pool.
    return {snapshot.release(), [spares = spares_](Snapshot* p) { spares->push(std::unique_ptr<Snapshot>(p)); }};
  }

 private:
  class Spares {
   public:
    Spares() { all_.reserve(kMost); }  // so that a release can't run out of memory
    std::unique_ptr<Snapshot> pop() {
      const std::lock_guard lock(mutex_);
      if (all_.empty()) return nullptr;
      std::unique_ptr<Snapshot> last = std::move(all_.back());
      all_.pop_back();
      return last;
    }
    void push(std::unique_ptr<Snapshot> snapshot) {
      const std::lock_guard lock(mutex_);
      if (all_.size() < kMost) all_.push_back(std::move(snapshot));
    }

   private:
    static constexpr std::size_t kMost = 2;
    std::mutex mutex_;
    std::vector<std::unique_ptr<Snapshot>> all_;
  };

  std::shared_ptr<Spares> spares_ = std::make_shared<Spares>();
};

}  // namespace hooke
