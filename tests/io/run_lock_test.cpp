// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// A run folder has one writer at a time.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "hooke/io/run_folder.h"
#include "samples.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

class RunLocks : public testing::Test {
 protected:
  Expected<io::RunWriter> create(bool overwrite = false) {
    return io::RunWriter::create(run, samples::run_info(), "{}", {overwrite});
  }
  Expected<io::RunWriter> resume() { return io::RunWriter::resume(run, samples::run_info(), "{}", 8, {0, 8}); }

  template <class T>
  void expect_refused(const Expected<T>& second, pid_t writer) {
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().kind, Error::Kind::bad_input);
    EXPECT_EQ(second.error().text(), run.string() + ": is being written by process " + std::to_string(writer) +
                                         ": wait for its end, or name another folder");
  }

  samples::TemporaryFolder folder;
  fs::path run = folder / "run";
};

TEST_F(RunLocks, RefuseASecondWriter) {
  auto first = create();
  ASSERT_TRUE(first);
  for (const std::int64_t step : {0, 8}) ASSERT_TRUE(first->write_snapshot(samples::snapshot(step, 10)));
  ASSERT_TRUE(first->flush());
  expect_refused(create(true), ::getpid());
  expect_refused(resume(), ::getpid());
  expect_refused(io::check_not_written(run), ::getpid());

  // Nothing has changed for the first one, and readers need no lock.
  EXPECT_EQ(io::RunReader::open(run)->size(), 2U);
  ASSERT_TRUE(first->write_snapshot(samples::snapshot(16, 10)));
  ASSERT_TRUE(first->finish());
  EXPECT_EQ(io::RunReader::open(run)->size(), 3U);
}

TEST_F(RunLocks, EndWithTheirWriter) {
  ASSERT_TRUE(create());  // ends without finish()
  EXPECT_TRUE(io::check_not_written(run));
  auto second = create(true);
  ASSERT_TRUE(second) << second.error().text();
  ASSERT_TRUE(second->finish());
  ASSERT_TRUE(second->finish());
  auto third = resume();  // while the second one still exists
  ASSERT_TRUE(third) << third.error().text();
  ASSERT_TRUE(third->finish());
  EXPECT_EQ(samples::files_in(run), (std::vector<std::string>{"particles.vtkhdf", "scene.json", "series.csv"}));
}

TEST_F(RunLocks, OfAKilledProcessAreTakenOver) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const auto writer = create();
    const char good = writer ? 'y' : 'n';
    if (::write(ready[1], &good, 1) == 1) ::pause();
    ::_exit(1);
  }
  char good = '?';
  ASSERT_EQ(::read(ready[0], &good, 1), 1);
  EXPECT_EQ(good, 'y');
  expect_refused(create(true), child);
  expect_refused(io::check_not_written(run), child);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(fs::exists(run / io::kLockFile));
  EXPECT_TRUE(io::check_not_written(run));
  auto writer = create(true);
  ASSERT_TRUE(writer) << writer.error().text();
  expect_refused(resume(), ::getpid());
}

TEST_F(RunLocks, AreNotLeftInAFolderThatIsRefused) {
  fs::create_directories(run / "series.csv.unfinished/mine");
  EXPECT_FALSE(create());
  EXPECT_EQ(samples::files_in(run), std::vector<std::string>{"series.csv.unfinished"});
}

}  // namespace
}  // namespace hooke
