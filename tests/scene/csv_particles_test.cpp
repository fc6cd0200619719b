// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <chrono>

#include "hooke/scene/particle_file.h"
#include "scratch_folder.h"

namespace hooke {
namespace {

class CsvParticlesTest : public testing::Test {
 protected:
  scene::FileParticles read(std::string_view text) {
    return scene::read_particle_file(folder_.write("p.csv", text), "p.csv", rules_, findings_, warnings_);
  }
  std::string complaints() { return Error{Error::Kind::bad_input, findings_.take()}.text(); }

  ScratchFolder folder_;
  std::vector<Material> materials_{{"water", 0.5, 1, {}, 0, ""}, {"oil", 0.5, 1, {}, 0, ""}};
  scene::ParticleFileRules rules_{materials_, std::uint16_t{0}, {1, 2, 3}, {}, {}};
  scene::Findings findings_{"scene.json"};
  std::vector<Finding> warnings_;
};

TEST_F(CsvParticlesTest, ReadsAllColumnsInAnyOrder) {
  const auto p = read("radius,vz,vy,vx,z,y,x,material,id\n9,6,5,4,3,2,1,oil,17\n9,-6e-1,+5,4,3,2, 1.5 ,water,2\n");
  EXPECT_EQ(complaints(), "");
  EXPECT_EQ(p.id, (std::vector<std::uint64_t>{17, 2}));
  EXPECT_EQ(p.material, (std::vector<std::uint16_t>{1, 0}));
  EXPECT_EQ(p.position, (std::vector<Vec3d>{{1, 2, 3}, {1.5, 2, 3}}));
  EXPECT_EQ(p.velocity, (std::vector<Vec3d>{{4, 5, 6}, {4, 5, -0.6}}));
  EXPECT_EQ(p.place, (std::vector<std::uint64_t>{2, 3}));
  EXPECT_EQ(warnings_, (std::vector<Finding>{{"p.csv", "columns that Hooke does not read are ignored: \"radius\""}}));
}

TEST_F(CsvParticlesTest, FillsInWhatTheEntrySays) {
  const auto p = read("x,y,z,vy\n1,2,3,8\n");
  EXPECT_EQ(complaints(), "");
  EXPECT_TRUE(p.id.empty());
  EXPECT_EQ(p.material, std::vector<std::uint16_t>{0});
  EXPECT_EQ(p.velocity, (std::vector<Vec3d>{{1, 8, 3}}));
}

TEST_F(CsvParticlesTest, TakesEveryCommonFormOfFile) {
  const auto p = read("\xef\xbb\xbf\"x\",y,z,material\r\n1,2,3,\"oil\"\r\n\r\n4,5,\"6\",\r\n7,8,9,water");
  EXPECT_EQ(complaints(), "");
  EXPECT_EQ(p.position, (std::vector<Vec3d>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
  EXPECT_EQ(p.material, (std::vector<std::uint16_t>{1, 0, 0}));
  EXPECT_EQ(p.place, (std::vector<std::uint64_t>{2, 4, 5}));
  EXPECT_EQ(read("x,y,z,vx\r1,2,3,1\r4,5,6,-1\r").position, (std::vector<Vec3d>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(complaints(), "");
}

TEST_F(CsvParticlesTest, AFileWithoutParticlesIsAFinding) {
  EXPECT_EQ(read("x,y,z\n").position.size(), 0U);
  EXPECT_EQ(complaints(), "p.csv: holds no particles");
}

TEST_F(CsvParticlesTest, SaysOnceWhichColumnsAreMissing) {
  read("\"Points:0\",\"Points:1\",\"Points:2\",\"radius\"\n1.5,2.5,3,0.25\n");
  EXPECT_EQ(complaints(),
            "p.csv:1: has no columns \"x\", \"y\", \"z\"; the header must name x, y and z, and names \"Points:0\", "
            "\"Points:1\", \"Points:2\", \"radius\"");
  read("x,y,x,x,z\n");
  EXPECT_EQ(complaints(), "p.csv:1: has two columns \"x\"");
}

TEST_F(CsvParticlesTest, KeepsBlanksBetweenQuotes) {
  materials_[1].name = " oil \"";
  const auto p = read("x,y,z,material\n1,2,3,\" oil \"\"\" \n4,5,6, \"water\"\n");
  EXPECT_EQ(complaints(), "");
  EXPECT_EQ(p.material, (std::vector<std::uint16_t>{1, 0}));
}

TEST_F(CsvParticlesTest, NumbersThatAreTooSmallAreZero) {
  const auto p = read("x,y,z\n1e-999,-1e-999,1e-310\n");
  EXPECT_EQ(complaints(), "");
  EXPECT_EQ(p.position.front(), (Vec3d{0, 0, 1e-310}));
}

TEST_F(CsvParticlesTest, HoldsBackWhatRepeatsItself) {
  std::string text = "x,y,z\n";
  for (int i = 0; i < 100; ++i) text += "1,2\n";
  read(text);
  const auto all = findings_.take();
  ASSERT_EQ(all.size(), 21U);
  EXPECT_EQ(all[19].where, "p.csv:21");
  EXPECT_EQ(all[20].message, "80 more findings like those above");
}

TEST_F(CsvParticlesTest, NamesAFileThatCannotBeRead) {
  scene::read_particle_file(folder_.path() / "none.csv", "none.csv", rules_, findings_, warnings_);
  EXPECT_EQ(complaints(), "none.csv: can't be opened: No such file or directory");
}

TEST_F(CsvParticlesTest, ReadsHalfAMillionRowsQuickly) {
  std::string text = "id,x,y,z,vx,vy,vz\n";
  for (int i = 1; i <= 512000; ++i)
    text += std::to_string(i) + ",12.345678901,2.3456789012,33.456789012,0.125,-9.8,1e-05\n";
  const auto file = folder_.write("p.csv", text);
  const auto start = std::chrono::steady_clock::now();
  const auto p = scene::read_particle_file(file, "p.csv", rules_, findings_, warnings_);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(p.position.size(), 512000U);
  RecordProperty("seconds", std::to_string(seconds.count()));
  EXPECT_LT(seconds.count(), 10) << "well under a second in a release build on an idle machine";
}

}  // namespace
}  // namespace hooke
