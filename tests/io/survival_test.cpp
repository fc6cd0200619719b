// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Which files survive when the program is killed, or the disk is full.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <functional>
#include <random>
#include <thread>

#include "hooke/io/run_folder.h"
#include "samples.h"

namespace hooke {
namespace {

using samples::TemporaryFolder;
namespace fs = std::filesystem;

/// A number that a child process shares with its parent.
class SharedNumber {
 public:
  SharedNumber()
      : memory_(::mmap(nullptr, sizeof(Number), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)),
        number_(new(memory_) Number(-1)) {}
  ~SharedNumber() { ::munmap(memory_, sizeof(Number)); }
  SharedNumber(const SharedNumber&) = delete;
  SharedNumber& operator=(const SharedNumber&) = delete;

  void set(std::int64_t value) { number_->store(value); }
  std::int64_t get() const { return number_->load(); }

 private:
  using Number = std::atomic<std::int64_t>;
  void* memory_;
  Number* number_;
};

/// Runs `work` in another process; 0 where it returned true.
pid_t start(const std::function<bool()>& work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work() ? 0 : 1);
  return child;
}

int wait_for(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

/// Starts `work`, kills it without warning some time after it has set `progress`, and waits for its end.
void kill_during(const SharedNumber& progress, std::chrono::microseconds delay, const std::function<bool()>& work) {
  const pid_t child = start(work);
  ASSERT_GT(child, 0);
  while (progress.get() < 0 && ::waitpid(child, nullptr, WNOHANG) == 0) std::this_thread::yield();
  std::this_thread::sleep_for(delay);
  ::kill(child, SIGKILL);
  wait_for(child);
}

std::size_t count_at(std::int64_t step) { return static_cast<std::size_t>(20000 - step % 3 * 100); }

/// Writes snapshots of ascending steps until it is killed; `flushed` is the last one that must survive.
bool write_for_ever(io::RunWriter& writer, std::int64_t from, SharedNumber& flushed) {
  for (std::int64_t step = from;; ++step) {
    if (!writer.write_snapshot(samples::snapshot(step, count_at(step)))) return false;
    if (!writer.write_series(samples::series_row(step))) return false;
    if (!writer.flush()) return false;
    flushed.set(step);
  }
}

// Repeated so many times, each time killed at another moment: a few after every change, many in the long tests.
class SurvivalOfKills : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(AFew, SurvivalOfKills, testing::Values(4));
INSTANTIATE_TEST_SUITE_P(Many, SurvivalOfKills, testing::Values(40));

TEST_P(SurvivalOfKills, EverySnapshotBeforeAKillReadsBack) {
  std::mt19937 random(5);
  for (int round = 0; round < GetParam(); ++round) {
    const TemporaryFolder folder;
    const fs::path run = folder / "run";
    SharedNumber flushed;
    const auto delay = [&] { return std::chrono::microseconds(random() % 60000); };
    kill_during(flushed, delay(), [&] {
      auto writer = io::RunWriter::create(run, samples::run_info(), "{}", {});
      return writer && write_for_ever(*writer, 0, flushed);
    });
    const auto check = [&]() -> std::int64_t {
      const auto reader = io::RunReader::open(run);
      EXPECT_TRUE(reader) << reader.error().text();
      if (!reader) return -1;
      const auto n = static_cast<std::int64_t>(reader->size());
      EXPECT_GE(n, flushed.get() + 1);
      for (std::int64_t step = 0; step < n; ++step) {
        const auto snapshot = reader->read(static_cast<std::size_t>(step));
        EXPECT_TRUE(snapshot) << snapshot.error().text();
        EXPECT_TRUE(snapshot && samples::same(*snapshot, samples::snapshot(step, count_at(step)))) << step;
      }
      return n;
    };
    const std::int64_t before = check();
    ASSERT_GE(before, 1);

    // And once more, killed while the run is continued.
    SharedNumber again;
    kill_during(again, delay(), [&] {
      auto writer = io::RunWriter::resume(run, samples::run_info(), "{}", before - 1, {0, 1});
      return writer && write_for_ever(*writer, before, again);
    });
    flushed.set(again.get());
    check();
    if (HasFailure()) return;
  }
}

TEST_P(SurvivalOfKills, AKillDuringACheckpointLeavesTheOldOrTheNewOne) {
  std::mt19937 random(6);
  const TemporaryFolder folder;
  const fs::path file = folder / "checkpoint.h5";
  for (int round = 0; round < GetParam(); ++round) {
    SharedNumber written;
    kill_during(written, std::chrono::microseconds(random() % 20000), [&] {
      for (std::int64_t step = 0;; ++step) {
        if (!io::write_checkpoint(file, samples::state(step, 3000), samples::run_info())) return false;
        written.set(step);
      }
    });
    const auto read = io::read_checkpoint(file);
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_GE(read->state.step, written.get());
    EXPECT_LE(read->state.step, written.get() + 1);
    EXPECT_TRUE(samples::same(read->state.particles, samples::state(read->state.step, 3000).particles));
  }
}

/// Makes writes beyond `bytes` fail in this process, as on a full disk.
void limit_file_size(rlim_t bytes) {
  const rlimit limit{bytes, bytes};
  ::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

TEST(Survival, AFullDiskIsReportedAndWhatWasThereStaysReadable) {
  for (const rlim_t limit : {300'000U, 1'000'000U, 1'300'000U, 1'700'001U}) {
    const TemporaryFolder folder;
    const fs::path run = folder / "run";
    SharedNumber flushed;
    const pid_t child = start([&] {
      limit_file_size(limit);
      auto writer = io::RunWriter::create(run, samples::run_info(), "{}", {});
      if (!writer || write_for_ever(*writer, 0, flushed)) return false;
      const auto after = writer->finish();
      // Later calls give the error too, with the reason, and nothing crashes at the end.
      return !after && after.error().kind == Error::Kind::io &&
             after.error().text().find("File too large") != std::string::npos &&
             !writer->write_snapshot(samples::snapshot(1000, 10));
    });
    EXPECT_EQ(wait_for(child), 0) << limit;
    const auto reader = io::RunReader::open(run);
    ASSERT_TRUE(reader) << reader.error().text();
    EXPECT_EQ(static_cast<std::int64_t>(reader->size()), flushed.get() + 1);
    for (std::size_t k = 0; k < reader->size(); ++k) {
      const auto step = static_cast<std::int64_t>(k);
      const auto snapshot = reader->read(k);
      ASSERT_TRUE(snapshot);
      EXPECT_TRUE(samples::same(*snapshot, samples::snapshot(step, count_at(step))));
    }
    // With room again, the run goes on.
    const std::int64_t resumed = std::max<std::int64_t>(flushed.get(), 0);
    auto writer = io::RunWriter::resume(run, samples::run_info(), "{}", resumed, {0, 1});
    ASSERT_TRUE(writer) << writer.error().text();
    ASSERT_TRUE(writer->write_snapshot(samples::snapshot(flushed.get() + 1, 20000)));
    ASSERT_TRUE(writer->finish());
    EXPECT_EQ(io::RunReader::open(run)->size(), static_cast<std::size_t>(flushed.get() + 2));
  }
}

TEST(Survival, AFullDiskKeepsTheOldCheckpoint) {
  const TemporaryFolder folder;
  const fs::path file = folder / "checkpoint.h5";
  ASSERT_TRUE(io::write_checkpoint(file, samples::state(1, 1000), samples::run_info()));
  const pid_t child = start([&] {
    limit_file_size(100'000);
    const auto written = io::write_checkpoint(file, samples::state(2, 5000), samples::run_info());
    return !written && written.error().kind == Error::Kind::io &&
           written.error().text() == file.string() + ": can't be written: File too large";
  });
  EXPECT_EQ(wait_for(child), 0);
  EXPECT_EQ(samples::files_in(folder.path()), std::vector<std::string>{"checkpoint.h5"});
  EXPECT_EQ(io::read_checkpoint(file)->state.step, 1);
}

TEST(Survival, AFullDiskLeavesNoNewRunHalfMade) {
  const TemporaryFolder folder;
  const pid_t child = start([&] {
    limit_file_size(500);
    const auto writer = io::RunWriter::create(folder / "a/b/run", samples::run_info(), "{}", {});
    return !writer && writer.error().kind == Error::Kind::io;
  });
  EXPECT_EQ(wait_for(child), 0);
  EXPECT_TRUE(samples::files_in(folder.path()).empty());
}

}  // namespace
}  // namespace hooke
