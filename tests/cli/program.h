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

/// The result of a call of the program.
struct Outcome {
  int status = -1;  ///< exit status, or 128 + the signal that ended it
  std::string out;
  std::string err;
};

/// A library that lets calls of the operating system fail: faults.cpp.
std::string faults_library();

/// A running call of the program, or of another one, in `folder`; its output goes to files there. `environment`:
/// NAME=VALUE, besides what the tests have.
class Program {
 public:
  Program(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
          std::uint64_t file_size_limit = 0, const std::vector<std::string>& environment = {},
          const std::string& program = program_file());
  Outcome wait();
  /// Sends a signal to the program's process group, as a terminal does.
  void send(int signal) const;
  /// Sends it to the program alone.
  void send_to_itself(int signal) const;
  /// The programs that it has started, in that order.
  std::vector<pid_t> children() const;

 private:
  std::filesystem::path out_, err_;
  pid_t pid_ = -1;
};

/// A test with a folder of its own, which is removed at its end, and the program called in that folder.
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
  Outcome hooke(const std::vector<std::string>& arguments, const std::vector<std::string>& environment) const;
  /// Another program, in the same folder.
  Program start_other(const std::string& program, const std::vector<std::string>& arguments) const;
  /// Expects status 0; returns the output.
  std::string hooke_ok(const std::vector<std::string>& arguments) const;
  /// All snapshots of a run as CSV.
  std::string export_all(const std::string& run) const;
  /// A text value of the run's report.json, e.g. state_hash.
  std::string state_hash(const std::string& run) const;
  /// Waits until `holds`, for a minute at most.
  static bool wait_until(const std::function<bool()>& holds);

 private:
  std::filesystem::path folder_;
};

/// A cube of side^3 particles that falls into a pool; output every 7 steps, so that most runs end between two outputs.
std::string pool_scene(int side, const std::string& integrator, const std::string& precision);
/// The same with 216 particles, as most tests use it.
inline std::string small_scene() { return pool_scene(6, "symplectic-euler", "single"); }

}  // namespace hooke::test
