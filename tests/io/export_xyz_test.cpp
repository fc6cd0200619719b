// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Reads extended XYZ back by its specification: a count, a line of key=value, a row a particle.
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "hooke/io/export.h"
#include "samples.h"

namespace hooke {
namespace {

struct Frame {
  std::map<std::string, std::string> keys;
  std::vector<std::vector<std::string>> rows;
};

/// key=value or key="value with spaces".
std::map<std::string, std::string> parse_keys(const std::string& line) {
  std::map<std::string, std::string> keys;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t equals = line.find('=', at);
    const bool quoted = line[equals + 1] == '"';
    const std::size_t begin = equals + (quoted ? 2 : 1);
    const std::size_t end = std::min(line.find(quoted ? '"' : ' ', begin), line.size());
    keys[line.substr(at, equals - at)] = line.substr(begin, end - begin);
    at = end + (quoted ? 2 : 1);
  }
  return keys;
}

std::vector<Frame> read_frames(const std::filesystem::path& file) {
  std::vector<Frame> frames;
  std::istringstream in(samples::read_file(file));
  for (std::string line; std::getline(in, line);) {
    Frame& frame = frames.emplace_back();
    const std::size_t count = std::stoul(line);
    std::getline(in, line);
    frame.keys = parse_keys(line);
    for (std::size_t i = 0; i < count && std::getline(in, line); ++i) frame.rows.push_back(samples::words(line));
    EXPECT_EQ(frame.rows.size(), count);
  }
  return frames;
}

class ExportXyzFile : public testing::Test {
 protected:
  std::vector<Frame> exported(const io::RunInfo& info, const std::vector<Snapshot>& snapshots, const Scene* scene) {
    const io::RunReader run = samples::write_run(folder / "run", info, snapshots);
    const auto written = samples::export_all(run, folder / "run.xyz", scene);
    EXPECT_EQ(written, std::vector<std::filesystem::path>{folder / "run.xyz"});
    return read_frames(folder / "run.xyz");
  }

  const samples::TemporaryFolder folder;
};

class ExportXyz : public ExportXyzFile, public testing::WithParamInterface<Precision> {};

TEST_P(ExportXyz, HoldsEverySnapshotToTheBit) {
  io::RunInfo info = samples::run_info(GetParam());
  info.materials[0].name = "salt \"sea\"\n#1 \u00e4%";
  const Scene scene = samples::scene(info);
  // More rows than the writer makes at once.
  const std::vector<Snapshot> snapshots{samples::snapshot(0, 150000, GetParam()), samples::snapshot(8, 0, GetParam()),
                                        samples::snapshot(16, 7, GetParam())};
  const auto frames = exported(info, snapshots, &scene);
  ASSERT_EQ(frames.size(), snapshots.size());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const auto& keys = frames[k].keys;
    EXPECT_EQ(keys.at("Properties"), "species:S:1:pos:R:3:velo:R:3:id:I:1:radius:R:1:mass:R:1");
    EXPECT_EQ(samples::number(keys.at("Time")), snapshots[k].time);
    EXPECT_EQ(keys.at("Step"), std::to_string(snapshots[k].step));
    EXPECT_EQ(keys.at("Lattice"), "225 0 0 0 200 0 0 0 225.5");
    EXPECT_EQ(keys.at("Origin"), "-110 -100 -120");
    EXPECT_EQ(keys.at("pbc"), "F T F");
    const ParticleSet& p = snapshots[k].particles;
    ASSERT_EQ(frames[k].rows.size(), p.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      const auto& row = frames[k].rows[i];
      ASSERT_EQ(row.size(), 10U);
      const auto vector = [&](std::size_t column) {
        return Vec3d{samples::number(row[column], GetParam()), samples::number(row[column + 1], GetParam()),
                     samples::number(row[column + 2], GetParam())};
      };
      const io::MaterialInfo& material = info.materials[p.material[i]];
      ASSERT_EQ(row[0], p.material[i] == 0 ? "salt%20%22sea%22%0A%231%20%C3%A4%25" : "oil");
      ASSERT_EQ(vector(1), p.position[i]);
      ASSERT_EQ(vector(4), p.velocity[i]);
      ASSERT_EQ(row[7], std::to_string(p.id[i]));
      ASSERT_EQ(samples::number(row[8]), material.radius);
      ASSERT_EQ(samples::number(row[9]), material.mass);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Both, ExportXyz, testing::Values(Precision::single_precision, Precision::double_precision),
                         [](const auto& p) { return to_string(p.param); });

TEST_F(ExportXyzFile, HasNoCellWithoutAScene) {
  const auto frames = exported(samples::run_info(), {samples::snapshot(0, 3)}, nullptr);
  EXPECT_FALSE(frames.at(0).keys.contains("Lattice"));
  EXPECT_EQ(frames.at(0).keys.at("pbc"), "F F F");
}

TEST_F(ExportXyzFile, HasASecondExtension) {
  const io::RunReader run = samples::write_run(folder / "run", samples::run_info(), {samples::snapshot(0, 3)});
  samples::export_all(run, folder / "a.xyz");
  samples::export_all(run, folder / "a.extxyz");
  EXPECT_EQ(samples::read_file(folder / "a.extxyz"), samples::read_file(folder / "a.xyz"));
}

TEST_F(ExportXyzFile, RefusesASceneOfAnotherRun) {
  const io::RunReader run = samples::write_run(folder / "run", samples::run_info(), {samples::snapshot(0, 3)});
  Scene scene = samples::scene(samples::run_info());
  scene.materials.pop_back();
  io::ExportOptions options;
  options.scene = &scene;
  const auto refused = io::export_run(run, std::vector<std::size_t>{0}, folder / "a.xyz", options);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text().find("other materials"), std::string::npos);
}

}  // namespace
}  // namespace hooke
