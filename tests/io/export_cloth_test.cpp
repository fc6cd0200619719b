// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <sstream>
#include <tuple>

#include "hooke/io/checkpoint.h"
#include "hooke/io/export.h"
#include "samples.h"

namespace hooke {
namespace {

/// A square of two triangles across z; its fourth corner may be missing.
class ExportCloth : public testing::Test {
 protected:
  ExportCloth() {
    ParticleSet& p = snapshot_.particles;
    p.id = {5, 7, 8, 9};
    p.material = {0, 0, 0, 0};
    p.position = {{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};
    p.velocity = {{1, 2, 3}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    auto structure = std::make_shared<Structure>();
    structure->surfaces = {{"linen", {5, 7, 8, 9}, {0, 1, 2, 0, 2, 3}}};
    scene_.structure = structure;
  }

  Expected<std::vector<std::filesystem::path>> exported(const char* file) {
    const io::RunReader run = samples::write_run(folder_ / "run", info_, {snapshot_});
    io::ExportOptions options;
    options.content = io::ExportContent::cloths;
    options.scene = &scene_;
    return io::export_run(run, std::vector<std::size_t>{0}, folder_ / file, options);
  }

  const samples::TemporaryFolder folder_;
  const io::RunInfo info_ = samples::run_info();
  Scene scene_ = samples::scene(info_);
  Snapshot snapshot_{40, 0.2, {}};
};

TEST_F(ExportCloth, AsObj) {
  ASSERT_TRUE(exported("c.obj"));
  std::istringstream text(samples::read_file(folder_ / "c.obj"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    if (line[0] != '#') lines.push_back(line);
  }
  EXPECT_EQ(lines,
            (std::vector<std::string>{"v 0 0 1", "v 2 0 1", "v 2 2 1", "v 0 2 1", "vn 0 0 1", "vn 0 0 1", "vn 0 0 1",
                                      "vn 0 0 1", "o surface", "s 1", "f 1//1 2//2 3//3", "f 1//1 3//3 4//4"}));
}

TEST_F(ExportCloth, AsPly) {
  ASSERT_TRUE(exported("c.ply"));
  const std::string text = samples::read_file(folder_ / "c.ply");
  EXPECT_NE(text.find("element vertex 4\n"), std::string::npos);
  EXPECT_NE(text.find("element face 2\n"), std::string::npos);
  const std::size_t head = text.find("end_header\n") + 11;
  EXPECT_EQ(text.size() - head, 4 * 9 * sizeof(float) + 2 * (1 + 3 * sizeof(std::uint32_t)));
}

TEST_F(ExportCloth, WithoutTrianglesThatMissAParticle) {
  for (auto* column : {&snapshot_.particles.position, &snapshot_.particles.velocity}) column->pop_back();
  snapshot_.particles.id.pop_back();
  snapshot_.particles.material.pop_back();
  ASSERT_TRUE(exported("c.obj"));
  const std::string text = samples::read_file(folder_ / "c.obj");
  EXPECT_NE(text.find("f 1//1 2//2 3//3\n"), std::string::npos);
  EXPECT_EQ(text.find("f 1//1 3//3"), std::string::npos);
}

// A spring along an edge, 2 m long: stretched from 1.9 m by 5.3 %. It has torn only if it breaks at less than that.
TEST_F(ExportCloth, WithoutTrianglesThatAreTorn) {
  for (const auto& [break_strain, a, torn] : {std::tuple{0.06, 9, false}, {0.05, 9, true}, {0.05, 6, false}}) {
    auto structure = std::make_shared<Structure>(*scene_.structure);
    structure->springs.push_back({static_cast<std::uint64_t>(a), 8, 1.9, 100, 0, break_strain});
    scene_.structure = structure;
    std::filesystem::remove_all(folder_ / "run");
    ASSERT_TRUE(exported("c.obj"));
    const std::string text = samples::read_file(folder_ / "c.obj");
    EXPECT_NE(text.find("f 1//1 2//2 3//3\n"), std::string::npos);
    EXPECT_EQ(text.find("f 1//1 3//3 4//4\n") == std::string::npos, torn) << break_strain;
    structure->springs = {};
  }
}

TEST_F(ExportCloth, NeedsACloth) {
  scene_.structure = nullptr;
  const auto files = exported("c.obj");
  ASSERT_FALSE(files);
  EXPECT_NE(files.error().text().find("is of no run with cloths"), std::string::npos) << files.error().text();
}

TEST_F(ExportCloth, FindsTheClothsOfARunInItsCheckpoint) {
  EXPECT_EQ(io::read_structure_of_run(folder_.path()).value(), nullptr) << "no checkpoint yet";
  const SimulationState state = samples::state(7, 20);
  ASSERT_TRUE(io::write_checkpoint(folder_ / "checkpoint.h5", state, info_));
  const auto structure = io::read_structure_of_run(folder_.path());
  ASSERT_TRUE(structure) << structure.error().text();
  EXPECT_EQ(**structure, *state.structure);
}

}  // namespace
}  // namespace hooke
