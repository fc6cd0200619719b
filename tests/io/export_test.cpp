// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/export.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

#include "hooke/io/describe_file.h"
#include "samples.h"

namespace hooke {
namespace {

using samples::TemporaryFolder;

template <class Real>
Real parse(const std::string& text) {
  Real value{};
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  EXPECT_EQ(end.ptr, text.data() + text.size());
  return value;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

/// Random bits, but finite: every exponent occurs.
template <class Real, class Bits>
Snapshot random_snapshot() {
  std::mt19937_64 random(7);
  const auto number = [&] {
    for (;;) {
      const Real value = std::bit_cast<Real>(static_cast<Bits>(random()));
      if (std::isfinite(value)) return static_cast<double>(value);
    }
  };
  Snapshot s{80, 80 * 0.005, {}};
  for (std::uint64_t id = 1; id <= 3000; ++id) {
    s.particles.id.push_back(id);
    s.particles.material.push_back(0);
    s.particles.position.push_back({number(), number(), number()});
    s.particles.velocity.push_back({number(), number(), number()});
  }
  return s;
}

template <class Real, class Bits>
void expect_csv_round_trip(Precision precision) {
  const TemporaryFolder folder;
  const Snapshot snapshot = random_snapshot<Real, Bits>();
  const io::RunReader run = samples::write_run(folder / "run", samples::run_info(precision), {snapshot});
  ASSERT_TRUE(io::export_run(run, std::vector<std::size_t>{0}, folder / "t.csv"));
  std::istringstream lines(samples::read_file(folder / "t.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "step,t,id,material,x,y,z,vx,vy,vz");
  for (std::size_t i = 0; i < snapshot.particles.size(); ++i) {
    ASSERT_TRUE(std::getline(lines, line));
    const auto fields = split(line);
    ASSERT_EQ(fields.size(), 10U);
    EXPECT_EQ(fields[0], "80");
    EXPECT_EQ(fields[1], "0.4");
    EXPECT_EQ(fields[2], std::to_string(i + 1));
    EXPECT_EQ(fields[3], "water");
    const Vec3d& x = snapshot.particles.position[i];
    const Vec3d& v = snapshot.particles.velocity[i];
    const double expected[] = {x.x, x.y, x.z, v.x, v.y, v.z};
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_EQ(std::bit_cast<Bits>(parse<Real>(fields[4 + k])), std::bit_cast<Bits>(static_cast<Real>(expected[k])));
      EXPECT_LE(fields[4 + k].size(), sizeof(Real) == 4 ? 15U : 24U);
    }
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST(ExportCsv, FloatsReadBackToTheSameFloat) {
  expect_csv_round_trip<float, std::uint32_t>(Precision::single_precision);
}
TEST(ExportCsv, DoublesReadBackToTheSameDouble) {
  expect_csv_round_trip<double, std::uint64_t>(Precision::double_precision);
}

TEST(ExportCsv, HoldsAllChosenSnapshotsInOneFile) {
  const TemporaryFolder folder;
  const io::RunReader run =
      samples::write_run(folder / "run", samples::run_info(),
                         {samples::snapshot(0, 3), samples::snapshot(8, 2), samples::snapshot(16, 3)});
  const auto written = io::export_run(run, std::vector<std::size_t>{0, 2}, folder / "T.CSV");
  ASSERT_TRUE(written) << written.error().text();
  EXPECT_EQ(*written, std::vector<std::filesystem::path>{folder / "T.CSV"});
  std::istringstream lines(samples::read_file(folder / "T.CSV"));
  std::vector<std::string> steps;
  for (std::string line; std::getline(lines, line);) steps.push_back(line.substr(0, line.find(',')));
  EXPECT_EQ(steps, (std::vector<std::string>{"step", "0", "0", "0", "16", "16", "16"}));
}

TEST(ExportCsv, QuotesNamesThatNeedIt) {
  const TemporaryFolder folder;
  io::RunInfo info = samples::run_info();
  info.materials[0].name = "salt, \"sea\"";
  Snapshot one = samples::snapshot(0, 1);
  one.particles.material[0] = 0;
  const io::RunReader run = samples::write_run(folder / "run", info, {one});
  ASSERT_TRUE(io::export_run(run, std::vector<std::size_t>{0}, folder / "t.csv"));
  EXPECT_NE(samples::read_file(folder / "t.csv").find(",\"salt, \"\"sea\"\"\","), std::string::npos);
}

TEST(ExportVtp, WritesOneFileOrACollection) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "out");
  const io::RunReader run =
      samples::write_run(folder / "run", samples::run_info(), {samples::snapshot(0, 5), samples::snapshot(8, 5)});
  ASSERT_TRUE(io::export_run(run, std::vector<std::size_t>{1}, folder / "out/one.vtp"));
  const std::string one = samples::read_file(folder / "out/one.vtp");
  EXPECT_NE(one.find("NumberOfPoints=\"5\" NumberOfVerts=\"5\""), std::string::npos);
  EXPECT_NE(one.find(R"(type="Float32" Name="velocity")"), std::string::npos);
  EXPECT_NE(one.find(">0.04</DataArray>"), std::string::npos);

  const auto written = io::export_run(run, std::vector<std::size_t>{0, 1}, folder / "out/all.vtp");
  ASSERT_TRUE(written);
  EXPECT_EQ(written->front(), folder / "out/all.pvd");
  EXPECT_EQ(samples::files_in(folder / "out"),
            (std::vector<std::string>{"all.pvd", "all_0000.vtp", "all_0001.vtp", "one.vtp"}));
  const std::string collection = samples::read_file(folder / "out/all.pvd");
  EXPECT_NE(collection.find(R"(timestep="0.04" part="0" file="all_0001.vtp")"), std::string::npos);
  // The same snapshot under two names: the files are equal.
  EXPECT_EQ(samples::read_file(folder / "out/all_0001.vtp"), one);
}

TEST(Export, SaysWhatItKnowsAndLeavesNothingHalfMade) {
  const TemporaryFolder folder;
  const io::RunReader run =
      samples::write_run(folder / "run", samples::run_info(), {samples::snapshot(0, 5), samples::snapshot(8, 5)});
  const auto unknown = io::export_run(run, std::vector<std::size_t>{0}, folder / "t.xyzzy");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().kind, Error::Kind::bad_input);
  EXPECT_NE(unknown.error().text().find("known are .csv, .vtp, .pvd, .ply"), std::string::npos);

  EXPECT_FALSE(io::export_run(run, std::vector<std::size_t>{}, folder / "t.csv"));
  // The run has lost its second snapshot since it was opened.
  ASSERT_TRUE(io::RunWriter::resume(folder / "run", samples::run_info(), "{}", 8, {0, 16}));
  EXPECT_FALSE(io::export_run(run, std::vector<std::size_t>{0, 1}, folder / "t.csv"));
  const auto unwritable = io::export_run(run, std::vector<std::size_t>{0}, folder / "none/t.csv");
  ASSERT_FALSE(unwritable);
  EXPECT_EQ(unwritable.error().kind, Error::Kind::io);
  EXPECT_EQ(samples::files_in(folder.path()), std::vector<std::string>{"run"});

  const io::RunReader empty = samples::write_run(folder / "empty", samples::run_info(), {});
  const auto nothing = io::export_run(empty, std::vector<std::size_t>{0}, folder / "t.csv");
  ASSERT_FALSE(nothing);
  EXPECT_NE(nothing.error().text().find("holds no complete snapshot"), std::string::npos);
}

TEST(DescribeFile, TellsRunsSnapshotsAndCheckpointsApart) {
  const TemporaryFolder folder;
  samples::write_run(folder / "run", samples::run_info(), {samples::snapshot(0, 5), samples::snapshot(8, 4)});
  auto run = io::describe_file(folder / "run");
  ASSERT_TRUE(run) << run.error().text();
  EXPECT_EQ(run->kind, io::FileDescription::Kind::run_folder);
  EXPECT_EQ(run->info, samples::run_info());
  EXPECT_EQ(run->steps, (std::vector<std::int64_t>{0, 8}));
  EXPECT_EQ(run->times, (std::vector<double>{0, 0.04}));
  EXPECT_EQ(run->particle_counts, (std::vector<std::uint64_t>{5, 4}));
  EXPECT_FALSE(run->checkpoint_step);

  ASSERT_TRUE(io::write_checkpoint(folder / "run/checkpoint.h5", samples::state(9, 4), samples::run_info()));
  EXPECT_EQ(io::describe_file(folder / "run")->checkpoint_step, 9);
  EXPECT_EQ(io::describe_file(folder / "run/particles.vtkhdf")->kind, io::FileDescription::Kind::particles_file);
  const auto checkpoint = io::describe_file(folder / "run/checkpoint.h5");
  ASSERT_TRUE(checkpoint);
  EXPECT_EQ(checkpoint->kind, io::FileDescription::Kind::checkpoint);
  EXPECT_EQ(checkpoint->steps, std::vector<std::int64_t>{9});
  EXPECT_EQ(checkpoint->particle_counts, std::vector<std::uint64_t>{4});

  for (const char* name : {"run/scene.json", "none", "run/series.csv"}) {
    const auto foreign = io::describe_file(folder / name);
    ASSERT_FALSE(foreign) << name;
    EXPECT_EQ(foreign.error().kind, Error::Kind::bad_input);
  }
}

}  // namespace
}  // namespace hooke
