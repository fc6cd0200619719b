// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "hooke/io/output_file.h"

namespace hooke::io {

/// The right to write a run folder, which one process has at a time. Readers need none.
///
/// It is a lock of the operating system on a file in the folder, which names the process: the lock ends with its
/// process, however that ends, and the file of a killed one is taken over. On file systems without locks every process
/// gets the right.
class RunLock {
 public:
  /// Throws Failure: bad_input, with the process that writes the folder, where there is one; io where no file can be
  /// made in the folder.
  explicit RunLock(const std::filesystem::path& folder);
  ~RunLock();
  RunLock(RunLock&&) noexcept = default;
  RunLock& operator=(RunLock&&) = delete;

 private:
  std::filesystem::path file_;
  Descriptor fd_;
};

/// Throws the same Failure where a process writes the folder; takes no lock.
void refuse_if_written(const std::filesystem::path& folder);

}  // namespace hooke::io
