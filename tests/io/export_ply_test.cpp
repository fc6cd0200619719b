// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Reads PLY points back by the format's description, and with VTK, which reads positions and colours.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <sstream>

#include "samples.h"
#include "source_dir.h"

namespace hooke {
namespace {

/// A little-endian file with one element, "vertex"; every value as a double, which holds every type of PLY.
struct Ply {
  std::vector<std::string> comments;
  std::vector<std::string> properties;  ///< "float x"
  std::map<std::string, std::vector<double>> values;
};

template <class T>
double take_bytes(const char*& bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  bytes += sizeof value;
  return static_cast<double>(value);
}

Ply read_ply(const std::filesystem::path& file) {
  using Taker = double (*)(const char*&);
  const std::map<std::string, std::pair<Taker, std::size_t>> types{{"float", {take_bytes<float>, 4}},
                                                                   {"double", {take_bytes<double>, 8}},
                                                                   {"uint", {take_bytes<std::uint32_t>, 4}},
                                                                   {"ushort", {take_bytes<std::uint16_t>, 2}},
                                                                   {"uchar", {take_bytes<std::uint8_t>, 1}}};
  const std::string text = samples::read_file(file);
  std::istringstream in(text);
  std::string line;
  const auto next = [&] { return std::getline(in, line) ? line : "the end"; };
  EXPECT_EQ(next(), "ply");
  EXPECT_EQ(next(), "format binary_little_endian 1.0");
  Ply ply;
  std::vector<std::pair<std::string, Taker>> columns;
  std::size_t count = 0, row_bytes = 0;
  while (next() != "end_header" && in) {
    const auto words = samples::words(line);
    if (words.at(0) == "comment") {
      ply.comments.push_back(line.substr(8));
    } else if (words.at(0) == "element") {
      EXPECT_EQ(words.at(1), "vertex");
      count = std::stoul(words.at(2));
    } else {
      EXPECT_EQ(words.at(0), "property");
      ply.properties.push_back(line.substr(9));
      const auto& [taker, bytes] = types.at(words.at(1));
      columns.emplace_back(words.at(2), taker);
      row_bytes += bytes;
    }
  }
  const auto begin = static_cast<std::size_t>(in.tellg());
  EXPECT_EQ(text.size(), begin + count * row_bytes);
  const char* at = text.data() + begin;
  for (std::size_t i = 0; i < count && text.size() == begin + count * row_bytes; ++i) {
    for (const auto& [name, taker] : columns) ply.values[name].push_back(taker(at));
  }
  return ply;
}

class ExportPlyFile : public testing::Test {
 protected:
  std::vector<std::filesystem::path> exported(const io::RunInfo& info, const std::vector<Snapshot>& snapshots,
                                              const Scene* scene) {
    return samples::export_all(samples::write_run(folder_ / "run", info, snapshots), folder_ / "p.ply", scene);
  }

  const samples::TemporaryFolder folder_;
};

class ExportPly : public ExportPlyFile, public testing::WithParamInterface<Precision> {};

TEST_P(ExportPly, HoldsEverySnapshotToTheBit) {
  io::RunInfo info = samples::run_info(GetParam());
  info.materials[0].name = "salt \"sea\"\nend_header \u00e4%";
  const std::vector<Snapshot> snapshots{samples::snapshot(0, 3000, GetParam()), samples::snapshot(8, 0, GetParam()),
                                        samples::snapshot(16, 7, GetParam())};
  const auto files = exported(info, snapshots, nullptr);
  ASSERT_EQ(files, (std::vector<std::filesystem::path>{folder_ / "p_0000.ply", folder_ / "p_0001.ply",
                                                       folder_ / "p_0002.ply"}));
  const std::string real = GetParam() == Precision::single_precision ? "float " : "double ";
  for (std::size_t k = 0; k < files.size(); ++k) {
    Ply ply = read_ply(files[k]);
    EXPECT_EQ(ply.comments, (std::vector<std::string>{
                                fmt::format("step {}", snapshots[k].step), fmt::format("time {}", snapshots[k].time),
                                "material 0 salt%20%22sea%22%0Aend_header%20%C3%A4%25", "material 1 oil"}));
    EXPECT_EQ(ply.properties, (std::vector<std::string>{real + "x", real + "y", real + "z", real + "vx", real + "vy",
                                                        real + "vz", real + "radius", "uint id", "ushort material"}));
    const ParticleSet& p = snapshots[k].particles;
    for (const auto& [name, values] : ply.values) ASSERT_EQ(values.size(), p.size()) << name;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const auto vector = [&](const char* x, const char* y, const char* z) {
        return Vec3d{ply.values[x][i], ply.values[y][i], ply.values[z][i]};
      };
      ASSERT_EQ(vector("x", "y", "z"), p.position[i]);
      ASSERT_EQ(vector("vx", "vy", "vz"), p.velocity[i]);
      const double radius = info.materials[p.material[i]].radius;
      ASSERT_EQ(ply.values["radius"][i],
                GetParam() == Precision::single_precision ? static_cast<double>(static_cast<float>(radius)) : radius);
      ASSERT_EQ(ply.values["id"][i], static_cast<double>(p.id[i]));
      ASSERT_EQ(ply.values["material"][i], p.material[i]);
    }
  }
}

TEST_P(ExportPly, VtkReadsItWithColours) {
  const io::RunInfo info = samples::run_info(GetParam());
  const Scene scene = samples::scene(info);
  const std::vector<Snapshot> snapshots{samples::snapshot(0, 500, GetParam())};
  const auto files = exported(info, snapshots, &scene);
  std::istringstream in(samples::output_of(
      fmt::format("/usr/bin/python3 '{}/tests/io/read_ply.py' '{}'", HOOKE_SOURCE_DIR, files.at(0).string())));
  const ParticleSet& p = snapshots[0].particles;
  std::string line;
  for (std::size_t i = 0; i < p.size(); ++i) {
    ASSERT_TRUE(std::getline(in, line));
    const auto words = samples::words(line);
    ASSERT_EQ(words.size(), 6U) << line;
    for (int axis = 0; axis < 3; ++axis) {  // VTK keeps positions in single precision
      ASSERT_EQ(static_cast<float>(samples::number(words[static_cast<std::size_t>(axis)])),
                static_cast<float>(component(p.position[i], axis)));
    }
    ASSERT_EQ(words[3] + ' ' + words[4] + ' ' + words[5], p.material[i] == 0 ? "47 127 214" : "255 0 128");
  }
  EXPECT_FALSE(std::getline(in, line)) << line;
}

INSTANTIATE_TEST_SUITE_P(Both, ExportPly, testing::Values(Precision::single_precision, Precision::double_precision),
                         [](const auto& p) { return to_string(p.param); });

TEST_F(ExportPlyFile, KeepsIdsOf64Bits) {
  Snapshot snapshot = samples::snapshot(0, 3);
  snapshot.particles.id = {7, 0xffffffffU, 0x123456789abcdefU};
  Ply ply = read_ply(exported(samples::run_info(), {snapshot}, nullptr).at(0));
  EXPECT_EQ(ply.values["id"], (std::vector<double>{7, 0xffffffffU, 0x89abcdefU}));
  EXPECT_EQ(ply.values["id_high"], (std::vector<double>{0, 0, 0x1234567}));
}

TEST_F(ExportPlyFile, PaintsWhatHasNoColourGrey) {
  io::RunInfo info = samples::run_info();
  info.materials.push_back({"plain", 1, 1});
  const Scene scene = samples::scene(info);
  Snapshot snapshot = samples::snapshot(0, 1);
  snapshot.particles.material = {2};
  Ply ply = read_ply(exported(info, {snapshot}, &scene).at(0));
  EXPECT_EQ(ply.values["red"], std::vector<double>{200});
  EXPECT_EQ(ply.values["blue"], std::vector<double>{200});
}

}  // namespace
}  // namespace hooke
