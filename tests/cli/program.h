// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hooke::test {

/// The program under test.
std::string program_file();

/// What a call of the program left behind.
struct Outcome {
  int status = -1;  ///< exit status, or 128 + the signal that ended it
  std::string out;
  std::string err;
};

/// A call of the program that is under way; in `folder`, with its output going to files there.
class Program {
 public:
  Program(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
          std::uint64_t file_size_limit = 0);
  Outcome wait();
  /// To its process group, as a terminal does.
  void send(int signal) const;

 private:
  std::filesystem::path out_, err_;
  pid_t pid_ = -1;
};

/// A folder of the test's own that is removed with it, and the program called in it.
class ProgramTest : public testing::Test {
 protected:
  ProgramTest();
  ~ProgramTest() override;

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;

  Program start(const std::vector<std::string>& arguments, std::uint64_t file_size_limit = 0) const;
  Outcome hooke(const std::vector<std::string>& arguments, std::uint64_t file_size_limit = 0) const;
  /// Expects status 0; the output.
  std::string hooke_ok(const std::vector<std::string>& arguments) const;
  /// All snapshots of a run as CSV.
  std::string export_all(const std::string& run) const;
  /// A text value of the run's report.json, e.g. state_hash.
  std::string state_hash(const std::string& run) const;
  /// Waits, for a minute at most, until `holds`.
  static bool wait_until(const std::function<bool()>& holds);

 private:
  std::filesystem::path folder_;
};

/// A cube of side^3 particles that falls into a pool; output every 7 steps, so that most ends of runs are off the beat.
std::string pool_scene(int side, const std::string& integrator, const std::string& precision);
/// The same with 216 particles, as most tests want it.
inline std::string small_scene() { return pool_scene(6, "symplectic-euler", "single"); }

}  // namespace hooke::test
