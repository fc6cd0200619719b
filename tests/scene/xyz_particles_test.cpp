// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "file_reading.h"

namespace hooke {
namespace {

class XyzParticlesTest : public FileReading {};

constexpr const char* kExtended =
    "2\n"
    "Lattice=\"5 0 0 0 5 0 0 0 5\" title='a \"b\" Properties=pos:R:3' "
    "Properties=id:I:1:species:S:1:velo:R:3:pos:R:3:force:R:3:radius:R:1 Time=0.1 pbc=\"F F F\"\n"
    "7 salt%20water 4 5 6 1 2 3 0 0 0 0.5\n"
    "3 water -4 -5 -6 0.1 0.2 0.3 0 0 0 0.5\n"
    "1\n"
    "Properties=species:S:1:pos:R:3\n"
    "water 9 9 9\n";

TEST_F(XyzParticlesTest, ReadsTheColumnsThatPropertiesName) {
  const auto p = read("p.extxyz", kExtended);
  EXPECT_EQ(complaints(), "");
  EXPECT_EQ(p.id, (std::vector<std::uint64_t>{7, 3}));
  EXPECT_EQ(p.material, (std::vector<std::uint16_t>{1, 0}));
  EXPECT_EQ(p.position, (std::vector<Vec3d>{{1, 2, 3}, {0.1, 0.2, 0.3}}));
  EXPECT_EQ(p.velocity, (std::vector<Vec3d>{{4, 5, 6}, {-4, -5, -6}}));
  EXPECT_EQ(p.place, (std::vector<std::uint64_t>{3, 4}));
  EXPECT_EQ(warnings(), "p.extxyz: columns that Hooke does not read are ignored: \"force\"");
}

TEST_F(XyzParticlesTest, ReadsTheFrameThatIsAskedFor) {
  for (const std::uint64_t frame : {std::uint64_t{1}, scene::kLastFrame}) {
    rules_.frame = frame;
    const auto p = read("p.xyz", kExtended);
    EXPECT_EQ(complaints(), "");
    EXPECT_EQ(p.position, (std::vector<Vec3d>{{9, 9, 9}}));
    EXPECT_EQ(p.velocity, (std::vector<Vec3d>{{7, 8, 9}}));
    EXPECT_EQ(p.place, (std::vector<std::uint64_t>{7}));
    EXPECT_EQ(scene::count_particles(folder_.path() / "p.xyz", rules_), 1U);
  }
  rules_.frame = 2;
  EXPECT_EQ(refusal("p.xyz", kExtended), "p.xyz: has no snapshot 2, counted from 0; it holds 2");
}

// Rows of LAMMPS's dump style xyz: types instead of names.
TEST_F(XyzParticlesTest, ReadsPlainRows) {
  const std::string text = "3\nAtoms. Timestep: 0\n1 0.25 1.5 2\n2 3.125 4 1\n1 -0.5 2 3\n";
  const auto p = read("p.xyz", text);
  EXPECT_EQ(complaints(), "");
  EXPECT_EQ(p.material, (std::vector<std::uint16_t>{0, 1, 0}));
  EXPECT_EQ(p.position, (std::vector<Vec3d>{{0.25, 1.5, 2}, {3.125, 4, 1}, {-0.5, 2, 3}}));
  EXPECT_TRUE(p.id.empty());
  EXPECT_EQ(warnings(), "");
  rules_.types = {{"1", 1}, {"2", 0}};
  EXPECT_EQ(read("p.xyz", text).material, (std::vector<std::uint16_t>{1, 0, 1}));
  rules_.types = {};
  rules_.material = std::uint16_t{1};
  EXPECT_EQ(read("p.xyz", text).material, (std::vector<std::uint16_t>{1, 1, 1}));
}

TEST_F(XyzParticlesTest, PassesAByteOrderMark) {
  EXPECT_EQ(read("p.xyz",
                 "\xef\xbb\xbf"
                 "1\n\nwater 1 2 3\n")
                .position,
            (std::vector<Vec3d>{{1, 2, 3}}));
  EXPECT_EQ(complaints(), "");
}

TEST_F(XyzParticlesTest, MapsSpecies) {
  const std::string text = "2\n\nAr 1 2 3 extra 5\nwater 4 5 6 extra 5\n\n\n";
  EXPECT_EQ(refusal("p.xyz", text),
            "p.xyz:3: species is \"Ar\", which the scene does not have; it has \"water\", \"salt water\"; the entry's "
            "\"types\" can say what it stands for");
  rules_.types = {{"Ar", 1}};
  EXPECT_EQ(read("p.xyz", text).material, (std::vector<std::uint16_t>{1, 0}));
  EXPECT_EQ(complaints(), "");
  EXPECT_EQ(warnings(), "p.xyz: columns that Hooke does not read are ignored: \"5\", \"6\"");
}

TEST_F(XyzParticlesTest, SaysWhatIsWrong) {
  EXPECT_EQ(refusal("p.xyz", ""), "p.xyz: is empty");
  EXPECT_EQ(refusal("p.xyz", "two\n"), "p.xyz:1: is \"two\"; must be the number of particles of a snapshot");
  EXPECT_EQ(refusal("p.xyz", "2\n\nwater 1 2 3\n"), "p.xyz:3: ends here, after 1 of 2 particles");
  EXPECT_EQ(refusal("p.xyz", "1000000000000000000\n\nwater 1 2 3\n"),
            "p.xyz:3: ends here, after 1 of 1000000000000000000 particles");
  EXPECT_EQ(refusal("p.xyz", "18446744073709551615\n\nwater 1 2 3\n"),
            "p.xyz:3: ends here, after 1 of 18446744073709551615 particles");
  EXPECT_EQ(refusal("p.xyz", "2\n\nwater 1 2 3\nwater 1 2\n"), "p.xyz:4: has 3 fields, the header 4");
  EXPECT_EQ(refusal("p.xyz", "1\nProperties=pos:R:3:velo:R\n1 2 3 4 5 6\n"),
            "p.xyz:2: has Properties with \"velo:R:\"; must be name:type:columns, as pos:R:3");
  EXPECT_EQ(refusal("p.xyz", "1\nProperties=pos:R:99999999999\n1 2 3 4 5 6\n"),
            "p.xyz:2: has Properties with \"pos:R:99999999999\"; must be name:type:columns, as pos:R:3");
  EXPECT_EQ(refusal("p.xyz", "1\nProperties=species:S:1:pos:R:2\nwater 2 3\n"),
            "p.xyz:2: has no columns \"x\", \"y\", \"z\"; the header must name x, y and z, and names \"species\", "
            "\"pos\", \"pos\"");
  EXPECT_EQ(refusal("p.xyz", "0\n\n"), "p.xyz: holds no particles");
  EXPECT_EQ(refusal("p.xyz", "1\nProperties=pos:R:3\n1 2 3\n"),
            "p.xyz:2: has no column \"material\", and the scene's entry names no material either");
  EXPECT_EQ(refusal("p.xyz", "1\nnothing = \"open\n=x\nwater 1 inf nan\n"), "p.xyz:3: has 1 fields, the header 4");
}

TEST_F(XyzParticlesTest, StandsDamage) { damage("p.xyz", kExtended, 2); }

}  // namespace
}  // namespace hooke
