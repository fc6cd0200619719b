// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "file_reading.h"

namespace hooke {
namespace {

class LammpsDumpTest : public FileReading {};

// Written by LAMMPS 20220106, dump custom.
const std::string kBox =
    "ITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS pp ff ff\n"
    "-1.0000000000000000e+00 4.0000000000000000e+00\n"
    "0.0000000000000000e+00 5.0000000000000000e+00\n"
    "5.0000000000000000e-01 6.0000000000000000e+00\n";
const std::string kTwoFrames = "ITEM: UNITS\nsi\nITEM: TIME\n0\nITEM: TIMESTEP\n0\n" + kBox +
                               "ITEM: ATOMS id type x y z vx vy vz radius mass\n"
                               "2 2 3.125 4 1 0 0 -9.8 0.5 2\n"
                               "1 1 0.25 1.5 2 1 -2 0.1 0.5 2\n"
                               "3 1 -0.5 2 3 1e-05 3 0 0.5 2\n"
                               "ITEM: TIME\n0.01\nITEM: TIMESTEP\n10\n" +
                               kBox +
                               "ITEM: ATOMS id type x y z vx vy vz radius mass\n"
                               "2 2 3.125 4 0.902 0 0 -9.8 0.5 2\n"
                               "1 1 0.26 1.48 2.001 1 -2 0.1 0.5 2\n"
                               "3 1 -0.5 2.03 3 1e-05 3 0 0.5 2\n";
const std::string kScaled = "ITEM: TIMESTEP\n0\n" + kBox +
                            "ITEM: ATOMS id type element xs ys zs vx vy vz diameter\n"
                            "1 1 water 0.25 0.3 0.272727 1 -2 0.1 1\n"
                            "2 2 Ar 0.825 0.8 0.0909091 0 0 -9.8 1\n"
                            "3 1 water 0.1 0.4 0.454545 1e-05 3 0 1\n";

TEST_F(LammpsDumpTest, ReadsTheLastFrameUnlessAskedForAnother) {
  const auto p = read("p.lammpstrj", kTwoFrames);
  EXPECT_EQ(complaints(), "");
  EXPECT_EQ(warnings(), "");
  EXPECT_EQ(p.id, (std::vector<std::uint64_t>{2, 1, 3}));
  EXPECT_EQ(p.material, (std::vector<std::uint16_t>{1, 0, 0}));
  EXPECT_EQ(p.position, (std::vector<Vec3d>{{3.125, 4, 0.902}, {0.26, 1.48, 2.001}, {-0.5, 2.03, 3}}));
  EXPECT_EQ(p.velocity, (std::vector<Vec3d>{{0, 0, -9.8}, {1, -2, 0.1}, {1e-5, 3, 0}}));
  EXPECT_EQ(p.place, (std::vector<std::uint64_t>{28, 29, 30}));
  rules_.frame = scene::kLastFrame;
  EXPECT_EQ(read("p.dump", kTwoFrames).position, p.position);
  rules_.frame = 0;
  EXPECT_EQ(read("p.dump", kTwoFrames).position, (std::vector<Vec3d>{{3.125, 4, 1}, {0.25, 1.5, 2}, {-0.5, 2, 3}}));
  rules_.frame = 2;
  EXPECT_EQ(refusal("p.dump", kTwoFrames), "p.dump: has no snapshot 2, counted from 0; it holds 2");
}

TEST_F(LammpsDumpTest, ReadsScaledPositionsAndElements) {
  rules_.types = {{"Ar", 1}};
  const auto p = read("p.dump", kScaled);
  EXPECT_EQ(complaints(), "");
  EXPECT_EQ(warnings(), "");
  EXPECT_EQ(p.material, (std::vector<std::uint16_t>{0, 1, 0}));
  const std::vector<Vec3d> expected{{0.25, 1.5, 2}, {3.125, 4, 1}, {-0.5, 2, 3}};
  ASSERT_EQ(p.position.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(component(p.position[i], axis), component(expected[i], axis), 1e-5);
    }
  }
}

TEST_F(LammpsDumpTest, TakesTheBestOfSeveralPositions) {
  const std::string head = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\n";
  EXPECT_EQ(read("p.dump", head + "ITEM: ATOMS xu x xs yu y ys zu z zs type f_1[2]\n9 1 0 9 2 0 9 3 0 1 4\n").position,
            (std::vector<Vec3d>{{1, 2, 3}}));
  EXPECT_EQ(complaints(), "");
  EXPECT_EQ(warnings(), "p.dump: columns that Hooke does not read are ignored: \"f_1[2]\"");
  EXPECT_EQ(read("p.dump", head + "ITEM: ATOMS xu yu zu type\n1 2 3 1\n").position, (std::vector<Vec3d>{{1, 2, 3}}));
  EXPECT_EQ(complaints(), "");
}

// Linear in the number of columns.
TEST_F(LammpsDumpTest, TakesVeryManyColumns) {
  std::string titles = "ITEM: ATOMS xu yu z", values = "1 2 3";
  for (int i = 0; i < 150000; ++i) {
    titles += i == 7 ? " x y" : " xs q";
    values += " 4 5";
  }
  titles += " type";
  values += " 1";
  const auto p = read("p.dump", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\n" + titles + "\n" + values + "\n");
  EXPECT_EQ(complaints(), "");
  EXPECT_EQ(p.position, (std::vector<Vec3d>{{4, 5, 3}}));
  EXPECT_EQ(refusal("p.dump", "ITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS y z type x x x x\n1 1 1 1 1 1 1\n"),
            "p.dump:3: has two columns \"x\"");
}

// The box is -1 to 4 and periodic only along x. A position on a face belongs to the lower end.
TEST_F(LammpsDumpTest, BringsParticlesBackIntoPeriodicBoxes) {
  const std::string head = "ITEM: TIMESTEP\n0\n" + kBox;
  const std::vector<Vec3d> wrapped{{3.75, -0.25, 2}, {-0.5, 5.5, 2}, {-1, 2, 6.25}};
  EXPECT_EQ(read("p.dump", head + "ITEM: ATOMS x y z type\n-1.25 -0.25 2 1\n4.5 5.5 2 1\n4 2 6.25 1\n").position,
            wrapped);
  // Unwrapped, two boxes away; scaled.
  EXPECT_EQ(read("p.dump", head + "ITEM: ATOMS xu y z type\n13.75 -0.25 2 1\n-10.5 5.5 2 1\n9 2 6.25 1\n").position,
            wrapped);
  EXPECT_EQ(read("p.dump", head + "ITEM: ATOMS xs y z type\n-0.25 1 2 1\n1.5 1 2 1\n1 1 2 1\n").position,
            (std::vector<Vec3d>{{2.75, 1, 2}, {1.5, 1, 2}, {-1, 1, 2}}));
  EXPECT_EQ(complaints(), "");
  // The bounds of a tilted box enclose it; they are not its faces.
  const std::string tilted =
      "ITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp pp pp\n0 1 0\n0 1 0\n0 1 0\n"
      "ITEM: ATOMS x y z type\n1.5 0 0 1\n";
  EXPECT_EQ(read("p.dump", tilted).position, (std::vector<Vec3d>{{1.5, 0, 0}}));
}

TEST_F(LammpsDumpTest, SaysWhatIsWrong) {
  const std::string head = "ITEM: TIMESTEP\n0\n";
  const std::string one = head + "ITEM: NUMBER OF ATOMS\n1\n";
  EXPECT_EQ(refusal("p.dump", "\n"), "p.dump: is empty");
  EXPECT_EQ(refusal("p.dump", "1\n2\n"), "p.dump:1: is \"1\"; a snapshot must start with \"ITEM: \"");
  EXPECT_EQ(refusal("p.dump", head), "p.dump:2: ends within the head of a snapshot");
  EXPECT_EQ(refusal("p.dump", head + "ITEM: ATOMS x y z\n"), "p.dump:3: comes before the item \"NUMBER OF ATOMS\"");
  EXPECT_EQ(refusal("p.dump", head + "ITEM: NUMBER OF ATOMS\nmany\n"),
            "p.dump:4: is \"many\"; must be the number of atoms");
  EXPECT_EQ(refusal("p.dump", one + "ITEM: BOX BOUNDS pp pp pp\n0\n"),
            "p.dump:6: is \"0\"; must be the bounds of the box");
  EXPECT_EQ(refusal("p.dump", one + "ITEM: ATOMS xs ys zs type\n0 0 0 1\n"),
            "p.dump:5: has scaled positions (\"xs\"), but no BOX BOUNDS before");
  EXPECT_EQ(
      refusal("p.dump", one + "ITEM: BOX BOUNDS xy xz yz pp pp pp\n0 1 0\n0 1 0\n0 1 0\nITEM: ATOMS xs ys zs type\n"
                              "0 0 0 1\n"),
      "p.dump:9: has scaled positions (\"xs\"), which are not read in a tilted box");
  EXPECT_EQ(refusal("p.dump", head + "ITEM: NUMBER OF ATOMS\n2\nITEM: ATOMS x y z type\n0 0 0 1\n"),
            "p.dump:6: ends here, after 1 of 2 particles");
  EXPECT_EQ(refusal("p.dump", one + "ITEM: ATOMS x y z type\n1 2 x 1\n"),
            "p.dump:6: z is \"x\"; must be a finite number");
  EXPECT_EQ(refusal("p.dump", one + "ITEM: BOX BOUNDS pp pp pp\n0 1e300\n0 1\n0 1\nITEM: ATOMS xs ys zs type\n"
                                    "1e300 0 0 1\n"),
            "p.dump:10: x is inf; must be a finite number");
}

TEST_F(LammpsDumpTest, StandsDamage) {
  rules_.types = {{"Ar", 1}};
  damage("p.dump", kTwoFrames, 3);
  damage("p.dump", kScaled, 3);
}

}  // namespace
}  // namespace hooke
