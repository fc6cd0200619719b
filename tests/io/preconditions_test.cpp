// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
//
// A broken precondition is reported where it is broken: one test for each kind of precondition that headers state.

#include <gtest/gtest.h>

#include "hooke/io/export.h"
#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/journaled_file.h"
#include "hooke/io/output_file.h"
#include "hooke/io/polydata_file.h"
#include "hooke/io/run_folder.h"
#include "hooke/io/series_file.h"
#include "hooke/io/shuffle_deflate.h"
#include "samples.h"
#include "support/assertions.h"

namespace hooke {
namespace {

using samples::TemporaryFolder;

TEST(IoPreconditions, SnapshotsAreTheRuns) {
  const TemporaryFolder folder;
  const io::RunReader run = samples::write_run(folder / "run", samples::run_info(), {samples::snapshot(0, 4)});
  EXPECT_ASSERTS((void)run.read(1), "index = 1, size() = 1");
  const std::vector<std::size_t> beyond{1}, twice{0, 0};
  EXPECT_ASSERTS((void)io::export_run(run, beyond, folder / "a.csv"), "indices.back() = 1, run.size() = 1");
  EXPECT_ASSERTS((void)io::export_run(run, twice, folder / "a.csv"), "is_ascending(indices)");
  EXPECT_ASSERTS((void)io::numbered_file("a.ply", 3, 3), "k = 3, count = 3");
}

TEST(IoPreconditions, NothingIsWrittenAfterTheEnd) {
  const TemporaryFolder folder;
  auto writer = io::RunWriter::create(folder / "run", samples::run_info(), "{}", {});
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->finish());
  EXPECT_ASSERTS((void)writer->write_series(samples::series_row(3)), "row.step = 3");
  io::OutputFile file(folder / "a.txt");
  file.finish();
  EXPECT_ASSERTS(file.write("more"), "file_.string()");
}

TEST(IoPreconditions, WhatIsReadIsNotWritten) {
  const TemporaryFolder folder;
  samples::write_file(folder / "a.h5", "text");
  io::JournaledFile file(folder / "a.h5", io::JournaledFile::Mode::read);
  EXPECT_ASSERTS(file.write(0, "x", 1), "writable()");
  EXPECT_ASSERTS(file.commit(), "writable()");
}

TEST(IoPreconditions, RowsAscend) {
  const TemporaryFolder folder;
  io::SeriesFile series = io::SeriesFile::create(folder / "series.csv", io::series_header());
  series.append(samples::series_row(8));
  EXPECT_ASSERTS(series.append(samples::series_row(4)), "row.step = 4, *last_step_ = 8");
}

TEST(IoPreconditions, ColumnsFit) {
  io::PolyDataFile file(io::PolyDataFile::Cells::lines, 4, 0);
  const std::vector<float> three(3);
  EXPECT_ASSERTS(file.add_point_data("v", three), "name = \"v\", values.size() = 3, point_count_ = 4");
  EXPECT_ASSERTS(file.add_cell_data("v", three), "cell_count = 2");
  EXPECT_ASSERTS(file.set_points(three), "values.size() == 3 * point_count_");
  EXPECT_ASSERTS(io::PolyDataFile(io::PolyDataFile::Cells::lines, 3, 0), "point_count = 3");
  EXPECT_ASSERTS((void)io::shuffle_deflate(three.data(), 3, 0), "count = 3, element_size = 0");
}

TEST(IoPreconditions, FailuresHaveAFinding) { EXPECT_ASSERTS(io::Failure(Error{}), "error_.findings"); }

}  // namespace
}  // namespace hooke
