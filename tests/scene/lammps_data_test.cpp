// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "file_reading.h"

namespace hooke {
namespace {

class LammpsDataTest : public FileReading {};

// Written by LAMMPS 20220106, write_data.
constexpr const char* kSpheres =
    "LAMMPS data file via write_data, version 29 Sep 2021, timestep = 0\n\n"
    "3 atoms\n2 atom types\n\n"
    "-1 4 xlo xhi\n0 5 ylo yhi\n0.5 6 zlo zhi\n\n"
    "Atoms # sphere\n\n"
    "1 1 1 3.8197186342054885 0.25 1.5 2 0 0 0\n"
    "2 2 1 3.8197186342054885 3.125 4 1 0 0 0\n"
    "3 1 1 3.8197186342054885 -0.5 2 3 0 0 0\n\n"
    "Velocities\n\n"
    "1 1 -2 0.1 0 0 0\n"
    "2 0 0 -9.8 0 0 0\n"
    "3 1e-05 3 0 0 0 0\n";
constexpr const char* kCharges =
    "LAMMPS data file via write_data, version 29 Sep 2021, timestep = 0\n\n"
    "2 atoms\n2 atom types\n\n"
    "-1 4 xlo xhi\n0 5 ylo yhi\n0.5 6 zlo zhi\n\n"
    "Masses\n\n1 2\n2 2\n\n"
    "Atoms # charge\n\n"
    "1 1 0 0.25 1.5 2 0 0 0\n"
    "2 2 -1 3.125 4 1 0 0 0\n\n"
    "Velocities\n\n1 0 0 0\n2 0 0 1\n";

TEST_F(LammpsDataTest, ReadsSpheres) {
  const auto p = read("p.data", kSpheres);
  EXPECT_EQ(complaints(), "");
  EXPECT_EQ(warnings(), "");
  EXPECT_EQ(p.id, (std::vector<std::uint64_t>{1, 2, 3}));
  EXPECT_EQ(p.material, (std::vector<std::uint16_t>{0, 1, 0}));
  EXPECT_EQ(p.position, (std::vector<Vec3d>{{0.25, 1.5, 2}, {3.125, 4, 1}, {-0.5, 2, 3}}));
  EXPECT_EQ(p.velocity, (std::vector<Vec3d>{{1, -2, 0.1}, {0, 0, -9.8}, {1e-5, 3, 0}}));
  EXPECT_EQ(p.place, (std::vector<std::uint64_t>{12, 13, 14}));
}

TEST_F(LammpsDataTest, ReadsChargesAndPutsVelocitiesWhereTheyBelong) {
  std::string text = kCharges;
  const auto p = read("p.lmp", text);
  EXPECT_EQ(complaints(), "");
  EXPECT_EQ(p.position, (std::vector<Vec3d>{{0.25, 1.5, 2}, {3.125, 4, 1}}));
  EXPECT_EQ(p.velocity, (std::vector<Vec3d>{{0, 0, 0}, {0, 0, 1}}));
  text.replace(text.find("1 0 0 0\n2 0 0 1\n"), 16, "2 0 0 1\n1 5 0 0\n");
  EXPECT_EQ(read("p.lmp", text).velocity, (std::vector<Vec3d>{{5, 0, 0}, {0, 0, 1}}));
  text.replace(text.find("Velocities"), std::string::npos, "PairIJ Coeffs # granular\n\n1 2 3 4\n");
  EXPECT_EQ(read("p.lmp", text).velocity, (std::vector<Vec3d>{{7, 8, 9}, {7, 8, 9}}));
  EXPECT_EQ(complaints(), "");
}

TEST_F(LammpsDataTest, TakesNamesOfTypesWhereverTheyStand) {
  const auto materials = [this](const std::string& head, const std::string& first = "1",
                                const std::string& second = "2") {
    return read("p.data", "title\n2 atoms\n" + head + "\nAtoms\n\n1 " + first + " 1 1 1\n2 " + second + " 1 1 1 # c\n")
        .material;
  };
  EXPECT_EQ(materials(""), (std::vector<std::uint16_t>{0, 1}));
  EXPECT_EQ(materials("# type 1 salt%20water\n# type 2 water\n"), (std::vector<std::uint16_t>{1, 0}));
  EXPECT_EQ(materials("\nMasses\n\n1 2.0 # salt water\n2 2.0 # water\n"), (std::vector<std::uint16_t>{1, 0}));
  EXPECT_EQ(materials("\nAtom Type Labels\n\n1 salt water\n2 water\n"), (std::vector<std::uint16_t>{1, 0}));
  EXPECT_EQ(materials("\nAtom Type Labels\n\n1 salt%20water\n2 water\n", "salt%20water", "water"),
            (std::vector<std::uint16_t>{1, 0}));
  rules_.material = std::uint16_t{1};
  EXPECT_EQ(materials(""), (std::vector<std::uint16_t>{1, 1}));
  EXPECT_EQ(materials("# type 1 water\n"), (std::vector<std::uint16_t>{0, 1}));
  rules_.types = {{"2", 0}, {"Ar", 1}};
  EXPECT_EQ(materials("# type 1 Ar\n"), (std::vector<std::uint16_t>{1, 0}));
  EXPECT_EQ(complaints(), "");
  materials("# type 1 oil\n");
  EXPECT_EQ(complaints(),
            "p.data:7: type is \"oil\", which the scene does not have; it has \"water\", \"salt water\"; the entry's "
            "\"types\" can say what it stands for");
}

TEST_F(LammpsDataTest, SaysWhatIsWrong) {
  EXPECT_EQ(refusal("p.data", ""), "p.data: is empty");
  EXPECT_EQ(refusal("p.data", "title\n"), "p.data: has no line \"N atoms\": it is no LAMMPS data file");
  EXPECT_EQ(refusal("p.data", "title\nAtoms\n"), "p.data:2: comes before the line \"N atoms\"");
  EXPECT_EQ(refusal("p.data", "title\n-1 atoms\n"), "p.data:2: is \"-1\"; must be the number of atoms");
  EXPECT_EQ(
      refusal("p.data", "title\n1 atoms\n\nAtoms # body\n\n1 1 1 1 1 1 1\n"),
      "p.data:6: is of atom style \"body\"; the section must be headed \"Atoms # STYLE\", of \"sphere\", \"atomic\", "
      "\"charge\", \"molecular\", \"full\"");
  EXPECT_EQ(refusal("p.data", "title\n3 atoms\n\nAtoms # atomic\n\n1 1 1 1 1\n"),
            "p.data:6: ends here, after 1 of 3 particles");
  EXPECT_EQ(refusal("p.data", "title\n3 atoms\n\nAtoms # atomic\n\n1 1 1 1 1\n\nVelocities\n"),
            "p.data:8: comes after 1 of 3 atoms");
  EXPECT_EQ(refusal("p.data", "title\n1 atoms\n\nAtoms # atomic\n\n1 1 1 1 1\n2 1 1 1 1\n"),
            "p.data:7: is more than the 1 atoms of the head");
  EXPECT_EQ(refusal("p.data", "title\n1 atoms\n\nAtoms # atomic\n\n1 1 1 1 1\n\nAtoms # atomic\n\n1 1 1 1 1\n"),
            "p.data:8: is the second section Atoms");
  EXPECT_EQ(refusal("p.data", "title\n1 atoms\n\nAtoms # sphere\n\n1 1 1 1 1\n"),
            "p.data:6: has 5 fields, the header 7");
  EXPECT_EQ(refusal("p.data", "title\n1 atoms\n\nAtoms\n\n1 1 1 1 1\n\nVelocities\n\n2 0 0 0\n"),
            "p.data:10: has the velocity of id 2, which no particle has");
  EXPECT_EQ(refusal("p.data", "title\n1 atoms\n\nAtoms\n\n1 1 1 1 1\n\nVelocities\n\n1 0 nan\n1 0 nan 0\n"),
            "p.data:10: has 3 fields; a velocity is id vx vy vz\np.data:11: vy is \"nan\"; must be a finite number");
  EXPECT_EQ(refusal("p.data", "title\n1 atoms\n\nAtoms\n\n1 3 1 1 1\n"),
            "p.data:6: type is \"3\", which the scene does not have; it has \"water\", \"salt water\"; the entry's "
            "\"types\" can say what it stands for");
  EXPECT_EQ(refusal("p.data", "title\n1000000000000000000 atoms\n\nAtoms\n\n1 1 1 1 1\n"),
            "p.data:6: ends here, after 1 of 1000000000000000000 particles");
}

TEST_F(LammpsDataTest, AFileWithoutParticlesIsAFinding) {
  EXPECT_EQ(read("p.data", "title\n0 atoms\n").position.size(), 0U);
  EXPECT_EQ(complaints(), "p.data: holds no particles");
}

TEST_F(LammpsDataTest, SaysWhereRadiusAndMassAreOthers) {
  read("p.data", "title\n3 atoms\n\nAtoms # sphere\n\n1 1 1.000001 3.81972 1 1 1\n2 1 1.1 3 1 1 1\n3 1 1.2 3 1 1 1\n");
  EXPECT_EQ(complaints(), "");
  EXPECT_EQ(warnings(),
            "p.data:8: radius is 0.6, but 0.5 of its material \"water\", which is taken; 2 particles differ, this one "
            "most\n"
            "p.data:8: mass is 2.714336, but 2 of its material \"water\", which is taken; 2 particles differ, "
            "this one most");
}

TEST_F(LammpsDataTest, StandsDamage) {
  damage("p.data", kSpheres, 3);
  damage("p.data", kCharges, 2);
}

}  // namespace
}  // namespace hooke
