// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/run_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <random>

#include "hooke/io/export.h"
#include "samples.h"
#include "support/small_slices.h"

namespace hooke {
namespace {

using samples::TemporaryFolder;
namespace fs = std::filesystem;

constexpr OutputCadence kEveryEight{0, 8};

class RunFolder : public testing::Test {
 protected:
  Expected<io::RunWriter> create(bool overwrite = false, Precision precision = Precision::single_precision) {
    return io::RunWriter::create(run, samples::run_info(precision), "{\"hooke\": 1}\n", {overwrite});
  }
  std::vector<Snapshot> read_all() {
    const auto reader = io::RunReader::open(run);
    EXPECT_TRUE(reader) << reader.error().text();
    std::vector<Snapshot> all;
    for (std::size_t k = 0; reader && k < reader->size(); ++k) {
      auto snapshot = reader->read(k);
      EXPECT_TRUE(snapshot) << snapshot.error().text();
      if (snapshot) all.push_back(std::move(*snapshot));
    }
    return all;
  }
  void expect_snapshots(const std::vector<Snapshot>& expected) {
    const auto read = read_all();
    ASSERT_EQ(read.size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_TRUE(samples::same(read[k], expected[k])) << k;
  }
  std::string export_all() {
    const auto reader = io::RunReader::open(run);
    std::vector<std::size_t> all(reader->size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    const auto written = io::export_run(*reader, all, folder / "all.csv");
    EXPECT_TRUE(written);
    return samples::read_file(folder / "all.csv");
  }

  TemporaryFolder folder;
  fs::path run = folder / "a/run";
};

TEST_F(RunFolder, SnapshotsReadBackInBothPrecisions) {
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    std::vector<Snapshot> written;
    auto writer = create(true, precision);
    ASSERT_TRUE(writer) << writer.error().text();
    // Counts that change, fall to 0 and exceed the size of a chunk.
    const std::size_t counts[] = {70000, 70000, 5, 0, 0, 1, 70001, 65536, 140000, 3};
    std::int64_t step = 0;
    for (const std::size_t n : counts) {
      written.push_back(samples::snapshot(step, n, precision));
      ASSERT_TRUE(writer->write_snapshot(written.back()));
      step += 8;
    }
    ASSERT_TRUE(writer->finish());
    expect_snapshots(written);
  }
  EXPECT_EQ(samples::files_in(run), (std::vector<std::string>{"particles.vtkhdf", "scene.json", "series.csv"}));
  EXPECT_EQ(samples::read_file(run / "scene.json"), "{\"hooke\": 1}\n");
}

// As several ranks hand them over: here a chunk of the file (140,000 rows are three) at a time.
TEST_F(RunFolder, SnapshotsInSlicesReadBack) {
  constexpr std::size_t kChunk = 46'667;
  std::vector<Snapshot> written;
  auto writer = create();
  ASSERT_TRUE(writer) << writer.error().text();
  for (const std::size_t n : {140'000U, 140'000U, 0U, 50'000U}) {
    written.push_back(samples::snapshot(static_cast<std::int64_t>(written.size()), n));
    const Snapshot& s = written.back();
    if (s.step == 1) written.back().particles.id = written.front().particles.id;
    ASSERT_TRUE(writer->write_snapshot(s.step, s.time, test::SmallSlices(s.particles, kChunk)));
  }
  ASSERT_TRUE(writer->finish());
  expect_snapshots(written);
  const auto late = writer->write_snapshot(9, 9, SlicesOfSet(written.front().particles));
  ASSERT_FALSE(late);
  EXPECT_NE(late.error().text().find("is finished"), std::string::npos);
}

TEST_F(RunFolder, AnErrorOfTheSlicesKeepsTheSnapshotsBefore) {
  auto writer = create();
  ASSERT_TRUE(writer) << writer.error().text();
  const Snapshot first = samples::snapshot(0, 1000), second = samples::snapshot(8, 140'000);
  ASSERT_TRUE(writer->write_snapshot(first));
  const test::SmallSlices failing(second.particles, 46'667, 1);  // halfway
  for (int tries = 0; tries < 2; ++tries) {
    const auto failed = writer->write_snapshot(8 + tries, second.time, failing);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().findings.front().message, "can't be read");
  }
  EXPECT_FALSE(writer->finish());
  expect_snapshots({first});
}

TEST_F(RunFolder, TellsStepsAndTimes) {
  auto writer = create();
  for (const std::int64_t step : {0, 8, 16}) ASSERT_TRUE(writer->write_snapshot(samples::snapshot(step, 4)));
  ASSERT_TRUE(writer->flush());
  const auto reader = io::RunReader::open(run / "particles.vtkhdf");  // while it is still being written
  ASSERT_TRUE(reader) << reader.error().text();
  EXPECT_EQ(reader->info(), samples::run_info());
  EXPECT_EQ(std::vector(reader->steps().begin(), reader->steps().end()), (std::vector<std::int64_t>{0, 8, 16}));
  EXPECT_EQ(std::vector(reader->times().begin(), reader->times().end()), (std::vector<double>{0, 0.04, 0.08}));
  EXPECT_EQ(reader->find_step(8), 1U);
  EXPECT_EQ(reader->find_step(9), std::nullopt);
  EXPECT_EQ(reader->find_time(0.06), 1U);
  EXPECT_EQ(reader->find_time(1e9), 2U);
  // A reader sees later snapshots only when it is opened again; until then it sees its own.
  ASSERT_TRUE(writer->write_snapshot(samples::snapshot(24, 4)));
  ASSERT_TRUE(writer->flush());
  EXPECT_TRUE(samples::same(*reader->read(2), samples::snapshot(16, 4)));
  EXPECT_EQ(io::RunReader::open(run)->size(), 4U);
}

TEST_F(RunFolder, KeepsIdsOfAllSixtyFourBits) {
  Snapshot snapshot = samples::snapshot(0, 4);
  snapshot.particles.id = {1, (1ULL << 63U) - 1, 1ULL << 63U, 0xffffffffffffffffU};
  auto writer = create();
  ASSERT_TRUE(writer->write_snapshot(snapshot));
  ASSERT_TRUE(writer->finish());
  expect_snapshots({snapshot});
  EXPECT_NE(export_all().find("\n0,0,9223372036854775808,"), std::string::npos);
}

TEST_F(RunFolder, WritesAStepOnceAndInOrder) {
  auto writer = create();
  ASSERT_TRUE(writer->write_snapshot(samples::snapshot(8, 4)));
  EXPECT_TRUE(writer->write_snapshot(samples::snapshot(8, 4)));
  EXPECT_FALSE(writer->write_snapshot(samples::snapshot(7, 4)));
  for (const std::int64_t step : {0, 8, 8}) ASSERT_TRUE(writer->write_series(samples::series_row(step)));
  ASSERT_TRUE(writer->finish());
  expect_snapshots({samples::snapshot(8, 4)});
  EXPECT_EQ(samples::read_file(run / "series.csv"), io::series_header() + '\n' + io::to_csv(samples::series_row(0)) +
                                                        '\n' + io::to_csv(samples::series_row(8)) + '\n');
}

TEST_F(RunFolder, RefusesARunThatIsThereUnlessToldTo) {
  ASSERT_TRUE(create()->finish());
  const auto again = create();
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().kind, Error::Kind::bad_input);
  EXPECT_NE(again.error().text().find("holds a run already"), std::string::npos);
  samples::write_file(run / "notes.txt", "mine");
  ASSERT_TRUE(io::write_checkpoint(run / "checkpoint.h5", samples::state(1, 2), samples::run_info()));
  ASSERT_TRUE(create(true)->finish());
  EXPECT_EQ(samples::files_in(run),
            (std::vector<std::string>{"notes.txt", "particles.vtkhdf", "scene.json", "series.csv"}));
}

TEST_F(RunFolder, NeverOverwritesAUsersOwnScene) {
  fs::create_directories(run);
  samples::write_file(run / "scene.json", "mine");
  for (const bool overwrite : {false, true}) {
    const auto writer = create(overwrite);
    ASSERT_FALSE(writer);
    EXPECT_NE(writer.error().text().find("would be overwritten"), std::string::npos);
  }
  EXPECT_EQ(samples::read_file(run / "scene.json"), "mine");
}

TEST_F(RunFolder, AnUnwritablePathLeavesNothingBehind) {
  samples::write_file(folder / "a", "a file where a folder is wanted");
  const auto writer = create();
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().kind, Error::Kind::io);
  EXPECT_EQ(samples::files_in(folder.path()), std::vector<std::string>{"a"});

  const auto at_file = io::RunWriter::create(folder / "a", samples::run_info(), "{}", {});
  ASSERT_FALSE(at_file);
  EXPECT_NE(at_file.error().text().find("is a file, not a folder"), std::string::npos);

  // A folder is in the way of series.csv: particles.vtkhdf must not stay behind.
  fs::create_directories(folder / "b");
  fs::create_directories(folder / "b/series.csv.unfinished");
  const auto blocked = io::RunWriter::create(folder / "b", samples::run_info(), "{}", {});
  ASSERT_FALSE(blocked);
  EXPECT_FALSE(fs::exists(folder / "b/particles.vtkhdf"));
}

TEST_F(RunFolder, SaysWhatIsNoRun) {
  const auto message = [](const fs::path& path) {
    const auto reader = io::RunReader::open(path);
    EXPECT_FALSE(reader);
    EXPECT_EQ(reader.error().kind, Error::Kind::bad_input);
    return reader.error().text();
  };
  EXPECT_EQ(message(run), run.string() + ": does not exist");
  EXPECT_NE(message(folder.path()).find("is no run folder"), std::string::npos);
  samples::write_file(folder / "empty.vtkhdf", "");
  EXPECT_NE(message(folder / "empty.vtkhdf").find("is empty"), std::string::npos);
  samples::write_file(folder / "text.vtkhdf", std::string(5000, 'x'));
  EXPECT_NE(message(folder / "text.vtkhdf").find("is damaged, cut short, or no HDF5 file"), std::string::npos);
  ASSERT_TRUE(io::write_checkpoint(folder / "c.h5", samples::state(1, 2), samples::run_info()));
  EXPECT_NE(message(folder / "c.h5").find("holds no run"), std::string::npos);

  auto writer = create();
  ASSERT_TRUE(writer->write_snapshot(samples::snapshot(0, 5000)));
  ASSERT_TRUE(writer->finish());
  const std::string whole = samples::read_file(run / "particles.vtkhdf");
  samples::write_file(folder / "short.vtkhdf", whole.substr(0, whole.size() / 2));
  EXPECT_NE(message(folder / "short.vtkhdf").find("cut short"), std::string::npos);
}

TEST_F(RunFolder, DamagedSnapshotsAreErrors) {
  auto writer = create();
  ASSERT_TRUE(writer->write_snapshot(samples::snapshot(0, 5000)));
  ASSERT_TRUE(writer->finish());
  std::string damaged = samples::read_file(run / "particles.vtkhdf");
  // In the middle of the largest chunk.
  for (std::size_t i = 0; i < 64; ++i) damaged[damaged.size() / 2 + i] = static_cast<char>(i * 37);
  samples::write_file(run / "particles.vtkhdf", damaged);
  const auto reader = io::RunReader::open(run);
  ASSERT_TRUE(reader) << reader.error().text();
  const auto snapshot = reader->read(0);
  ASSERT_FALSE(snapshot);
  EXPECT_NE(snapshot.error().text().find("damaged"), std::string::npos);
}

TEST_F(RunFolder, ResumedRunsExportWhatUninterruptedOnesDo) {
  const auto count_at = [](std::int64_t step) { return static_cast<std::size_t>(3000 - step); };  // some leave
  const auto write_to = [&](io::RunWriter&& writer, std::int64_t from, std::int64_t to) {
    for (std::int64_t step = from; step <= to; ++step) {
      if (kEveryEight.is_due(step, 0.005) || step == to) {
        ASSERT_TRUE(writer.write_snapshot(samples::snapshot(step, count_at(step))));
        ASSERT_TRUE(writer.write_series(samples::series_row(step)));
      }
      if (step % 10 == 0 || step == to) {
        ASSERT_TRUE(writer.write_checkpoint(samples::state(step, 100)));
      }
    }
    ASSERT_TRUE(writer.finish());
  };
  write_to(*create(), 0, 60);
  const std::string expected = export_all();
  const std::string expected_series = samples::read_file(run / "series.csv");

  for (const std::int64_t stopped : {0, 7, 30, 32, 59}) {
    write_to(*create(true), 0, stopped);
    const auto checkpoint = io::read_checkpoint(run);
    ASSERT_TRUE(checkpoint);
    auto writer =
        io::RunWriter::resume(run, samples::run_info(), "{\"resumed\": 1}", checkpoint->state.step, kEveryEight);
    ASSERT_TRUE(writer) << writer.error().text();
    write_to(std::move(*writer), checkpoint->state.step + 1, 60);
    EXPECT_EQ(export_all(), expected) << stopped;
    EXPECT_EQ(samples::read_file(run / "series.csv"), expected_series) << stopped;
    EXPECT_EQ(samples::read_file(run / "scene.json"), "{\"resumed\": 1}");
  }
}

TEST_F(RunFolder, ResumingFromAnOlderCheckpointCutsWhatCameAfter) {
  auto writer = create();
  for (std::int64_t step = 0; step <= 80; step += 8) {
    ASSERT_TRUE(writer->write_snapshot(samples::snapshot(step, 2000)));
    ASSERT_TRUE(writer->write_series(samples::series_row(step)));
  }
  ASSERT_TRUE(writer->finish());
  auto resumed = io::RunWriter::resume(run, samples::run_info(), "{}", 20, kEveryEight);
  ASSERT_TRUE(resumed);
  ASSERT_TRUE(resumed->finish());
  expect_snapshots({samples::snapshot(0, 2000), samples::snapshot(8, 2000), samples::snapshot(16, 2000)});
  EXPECT_EQ(samples::read_file(run / "series.csv"), io::series_header() + '\n' + io::to_csv(samples::series_row(0)) +
                                                        '\n' + io::to_csv(samples::series_row(8)) + '\n' +
                                                        io::to_csv(samples::series_row(16)) + '\n');
}

TEST_F(RunFolder, ResumingAnotherKindOfRunIsRefused) {
  ASSERT_TRUE(create()->finish());
  const auto other = io::RunWriter::resume(run, samples::run_info(Precision::double_precision), "{}", 0, kEveryEight);
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().text().find("is of another run"), std::string::npos);
  EXPECT_FALSE(io::RunWriter::resume(folder / "none", samples::run_info(), "{}", 0, kEveryEight));
}

}  // namespace
}  // namespace hooke
