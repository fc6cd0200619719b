// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The thread that writes a run's large files, beside the thread that steps: these tests are for a build with the thread
// sanitizer. run_folder_test.cpp and survival_test.cpp test the contents of the files.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

#include "hooke/io/describe_file.h"
#include "hooke/io/hdf5.h"
#include "hooke/io/run_folder.h"
#include "samples.h"

namespace hooke {
namespace {

using samples::TemporaryFolder;
namespace fs = std::filesystem;

constexpr std::size_t kParticles = 500;

/// During its lifetime, writes beyond `bytes` fail in this process, as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : signal_before_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_before_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*signal_before_)(int);
};

/// Whether `holds` becomes true within a minute.
bool wait_until(const std::function<bool()>& holds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!holds() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return holds();
}

class WriterThread : public testing::Test {
 protected:
  static io::RunWriter create(const fs::path& at) {
    auto writer = io::RunWriter::create(at, samples::run_info(), "{}", {.overwrite = true});
    EXPECT_TRUE(writer) << writer.error().text();
    return std::move(writer.value());
  }

  // Steps `first` to `last`: a row and a snapshot for each step, and a large checkpoint for every fifth.
  static void write(io::RunWriter& writer, std::int64_t first, std::int64_t last) {
    const SimulationState state = samples::state(first, kParticles);
    for (std::int64_t step = first; step <= last; ++step) {
      ASSERT_TRUE(writer.write_series(samples::series_row(step)));
      ASSERT_TRUE(writer.write_snapshot(samples::snapshot(step, kParticles)));
      if (step % 5 != 0) continue;
      // The state shares its springs and surfaces with the simulation, which goes on meanwhile.
      SimulationState now = state;
      now.step = step;
      ASSERT_TRUE(writer.write_checkpoint(std::move(now)));
    }
  }

  static void expect_steps(const fs::path& at, std::int64_t first, std::int64_t last) {
    const auto reader = io::RunReader::open(at);
    ASSERT_TRUE(reader) << reader.error().text();
    ASSERT_EQ(static_cast<std::int64_t>(reader->size()), last - first + 1);
    for (std::int64_t step = first; step <= last; ++step) {
      const auto snapshot = reader->read(static_cast<std::size_t>(step - first));
      ASSERT_TRUE(snapshot) << snapshot.error().text();
      EXPECT_TRUE(samples::same(*snapshot, samples::snapshot(step, kParticles))) << step;
    }
    const auto checkpoint = io::read_checkpoint(at);
    ASSERT_TRUE(checkpoint) << checkpoint.error().text();
    EXPECT_EQ(checkpoint->state.step, last - last % 5);
  }

  // Expects that all calls after a failure give the same error.
  static void expect_failed(io::RunWriter& writer, const std::string& why) {
    for (int tries = 0; tries < 2; ++tries) {
      for (const Expected<void>& done : {writer.write_snapshot(samples::snapshot(1'000'000 + tries, kParticles)),
                                         writer.write_checkpoint(samples::state(1, kParticles)), writer.flush()}) {
        ASSERT_FALSE(done);
        EXPECT_EQ(done.error().kind, Error::Kind::io);
        EXPECT_EQ(done.error().text(), why);
      }
    }
    const auto finished = writer.finish();
    ASSERT_FALSE(finished);
    EXPECT_EQ(finished.error().text(), why);
  }

  TemporaryFolder folder;
  fs::path run = folder / "run";
};

TEST_F(WriterThread, WritesWhatComesInQuickSuccession) {
  io::RunWriter writer = create(run);
  write(writer, 0, 30);
  ASSERT_TRUE(writer.finish());
  expect_steps(run, 0, 30);
  const auto late = writer.write_snapshot(samples::snapshot(31, kParticles));
  ASSERT_FALSE(late);
  EXPECT_NE(late.error().text().find("is finished"), std::string::npos);
}

TEST_F(WriterThread, RunsFollowEachOtherInOneProcess) {
  for (int round = 0; round < 4; ++round) {
    io::RunWriter writer = create(run);
    write(writer, 0, 5);
    EXPECT_TRUE(round % 2 == 0 || writer.flush());
    EXPECT_TRUE(round < 2 || writer.finish());
    // The next writer replaces a writer that may still be writing.
    writer = create(folder / "other");
    write(writer, 5, 8);
    writer = io::RunWriter(std::move(writer));
    ASSERT_TRUE(writer.finish());
    expect_steps(run, 0, 5);
    expect_steps(folder / "other", 5, 8);
  }
}

TEST_F(WriterThread, DestructionWritesWhatWaits) {
  for (const std::int64_t last : {0, 1, 5}) {
    {
      io::RunWriter writer = create(run);
      write(writer, 0, last);
    }
    expect_steps(run, 0, last);
  }
  { const io::RunWriter idle = create(run); }
  EXPECT_EQ(io::RunReader::open(run)->size(), 0U);
}

TEST_F(WriterThread, ReadersAndOtherWritersOfTheProcessGoOnMeanwhile) {
  io::RunWriter writer = create(run);
  write(writer, 0, 0);
  ASSERT_TRUE(writer.flush());
  std::atomic<bool> written{false};
  // These two threads, the writers' own threads and this thread all call HDF5.
  std::thread reader([&] {
    std::size_t before = 1;
    for (bool last = false; !last;) {
      last = written;
      const auto description = io::describe_file(run);
      ASSERT_TRUE(description) << description.error().text();
      const auto opened = io::RunReader::open(run);
      ASSERT_TRUE(opened) << opened.error().text();
      ASSERT_GE(opened->size(), before);
      before = opened->size();
      const auto snapshot = opened->read(before - 1);
      ASSERT_TRUE(snapshot) << snapshot.error().text();
      EXPECT_TRUE(samples::same(*snapshot, samples::snapshot(snapshot->step, kParticles)));
      ASSERT_TRUE(io::read_checkpoint(run));
    }
    EXPECT_EQ(before, 21U);
  });
  std::thread other([&] {
    io::RunWriter another = create(folder / "other");
    write(another, 0, 20);
    EXPECT_TRUE(another.finish());
  });
  write(writer, 1, 20);
  EXPECT_TRUE(writer.finish());
  written = true;
  reader.join();
  other.join();
  expect_steps(run, 0, 20);
  expect_steps(folder / "other", 0, 20);
}

// A reader gets one whole checkpoint, however often the file is replaced meanwhile.
TEST_F(WriterThread, ACheckpointIsReadAndDescribedWhileItIsReplaced) {
  io::RunWriter writer = create(run);
  write(writer, 0, 0);
  ASSERT_TRUE(writer.flush());
  for (const std::size_t n : {1U, 1000U}) {
    ASSERT_TRUE(io::write_checkpoint(folder / std::to_string(n), samples::state(static_cast<std::int64_t>(n), n),
                                     samples::run_info()));
  }
  std::atomic<bool> done{false};
  std::thread replacer([&] {
    while (!done) {
      for (const char* const name : {"1", "1000"}) {
        fs::create_hard_link(folder / name, run / "next");
        fs::rename(run / "next", run / io::kCheckpointFile);
      }
    }
  });
  for (int i = 0; i < 100; ++i) {
    const auto description = io::describe_file(run);
    EXPECT_TRUE(description) << description.error().text();
    const auto checkpoint = io::read_checkpoint(run);
    EXPECT_TRUE(checkpoint) << checkpoint.error().text();
  }
  done = true;
  replacer.join();
}

// One snapshot is being written, one waits: the caller of a third has to wait.
TEST_F(WriterThread, ASlowWriterMakesTheCallerWait) {
  io::RunWriter writer = create(run);
  std::atomic<std::int64_t> taken{0};
  std::thread caller;
  {
    const auto nobody_writes = io::hdf5::lock();
    caller = std::thread([&] {
      for (std::int64_t step = 0; step < 10; ++step) {
        ASSERT_TRUE(writer.write_snapshot(samples::snapshot(step, kParticles)));
        ++taken;
      }
    });
    EXPECT_TRUE(wait_until([&] { return taken == 2; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(taken, 2);
  }
  caller.join();
  EXPECT_EQ(taken, 10);
  ASSERT_TRUE(writer.finish());
  EXPECT_EQ(io::RunReader::open(run)->size(), 10U);
}

TEST_F(WriterThread, AFullDiskIsSaidByTheNextCall) {
  io::RunWriter writer = create(run);
  write(writer, 0, 3);
  ASSERT_TRUE(writer.flush());
  {
    const FullDisk disk(fs::file_size(run / io::kParticlesFile) + 20'000);
    Expected<void> written;
    for (std::int64_t step = 4; written && step < 1000; ++step) {
      written = writer.write_snapshot(samples::snapshot(step, kParticles));
    }
    ASSERT_FALSE(written);
  }
  // Free space does not help afterwards: there would be a gap.
  expect_failed(writer, (run / io::kParticlesFile).string() + ": can't be written: File too large");
  const auto reader = io::RunReader::open(run);
  ASSERT_TRUE(reader) << reader.error().text();
  ASSERT_GE(reader->size(), 4U);
  for (std::size_t k = 0; k < reader->size(); ++k) {
    EXPECT_TRUE(samples::same(*reader->read(k), samples::snapshot(static_cast<std::int64_t>(k), kParticles))) << k;
  }
}

TEST_F(WriterThread, AFolderThatGoesAwayIsSaidByTheNextCall) {
  io::RunWriter writer = create(run);
  fs::remove_all(run);
  Expected<void> written;
  for (std::int64_t step = 0; written && step < 1000; ++step) {
    written = writer.write_snapshot(samples::snapshot(step, kParticles));
  }
  ASSERT_FALSE(written);
  expect_failed(writer, (run / io::kParticlesFile).string() + ": can't be written: No such file or directory");
}

TEST_F(WriterThread, ACheckpointThatCanNotBeWrittenIsSaidByTheNextCall) {
  io::RunWriter writer = create(run);
  // A folder in the way of the file: root, too, can't write there.
  fs::create_directories(run / "checkpoint.h5.unfinished" / "full");
  ASSERT_TRUE(writer.write_snapshot(samples::snapshot(0, kParticles)));
  ASSERT_TRUE(writer.write_checkpoint(samples::state(0, kParticles)));
  const auto flushed = writer.flush();
  ASSERT_FALSE(flushed);
  expect_failed(writer, flushed.error().text());
  EXPECT_EQ(flushed.error().findings.front().where, (run / io::kCheckpointFile).string());
  EXPECT_EQ(io::RunReader::open(run)->size(), 1U);
}

// The caller never asks for the error; whatever still waits to be written is dropped.
TEST_F(WriterThread, DestructionAfterAFailureEnds) {
  for (int round = 0; round < 5; ++round) {
    io::RunWriter writer = create(folder / "gone");
    fs::remove_all(folder / "gone");
    for (std::int64_t step = 0; step < round; ++step) {
      (void)writer.write_snapshot(samples::snapshot(step, kParticles));  // may fail already
    }
  }
}

}  // namespace
}  // namespace hooke
