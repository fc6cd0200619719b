// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The boxes that files of particles state, against the domain that the particles enter.

#include <gtest/gtest.h>

#include "hooke/scene/load_scene.h"
#include "scratch_folder.h"

namespace hooke {
namespace {

class FileBoxes : public testing::Test {
 protected:
  /// What is said of a file in a domain of 4 m with these walls: errors, or else warnings.
  std::string said_of(const std::string& name, const std::string& text, const std::string& walls) const {
    folder_.write(name, text);
    const auto loaded = scene::parse_scene(
        R"({"hooke":1,"time":{"step":0.01,"steps":1},"domain":{"min":[0,0,0],"max":[4,4,4],"walls":)" + walls +
            R"(},"materials":{"grain":{"radius":0.25,"mass":1,"stiffness":1}},"particles":[{"file":")" + name +
            R"(","material":"grain"}]})",
        "scene.json", folder_.path());
    return (loaded ? Error{Error::Kind::bad_input, loaded->warnings} : loaded.error()).text();
  }

  static std::string data(const std::string& box) {
    return "made by hand\n\n1 atoms\n1 atom types\n\n" + box + "\nAtoms # atomic\n\n1 1 0.6 0.6 3.9\n";
  }
  static std::string dump(const std::string& box) {
    return "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS " + box +
           "\nITEM: ATOMS id type x y z\n1 1 0.6 0.6 3.9\n";
  }
  static std::string xyz(const std::string& comment) { return "1\n" + comment + "\ngrain 0.6 0.6 3.9\n"; }

  static constexpr const char* kPeriodic = "\"periodic\"";
  static constexpr const char* kOpen = "\"open\"";
  ScratchFolder folder_;
};

TEST_F(FileBoxes, ThatAreTiltedDoNotFitAPeriodicDomain) {
  const std::pair<const char*, std::string> files[] = {
      {"p.data:9", data("0 4 xlo xhi\n0 4 ylo yhi\n0 4 zlo zhi\n1.0 0.5 0.0 xy xz yz\n")},
      {"p.data:7", data("4 0 0 avec\n1 4 0 bvec\n0.5 0 4 cvec\n0 0 0 abc origin\n")},
      {"p.dump:5", dump("abc origin pp pp pp\n4 0 0 0\n1 4 0 0\n0.5 0 4 0")},
      {"p.dump:5", dump("xy xz yz pp pp pp\n0 5.5 1\n0 4 0.5\n0 4 0")},
      {"p.extxyz:2", xyz(R"(Lattice="4 0 0 1 4 0 0.5 0 4" pbc="T T T" Properties=species:S:1:pos:R:3)")}};
  for (const auto& [where, text] : files) {
    const std::string place = where, name = place.substr(0, place.find(':'));
    EXPECT_EQ(said_of(name, text, kPeriodic),
              place + ": says that the box is tilted; a periodic domain has right angles");
    EXPECT_EQ(said_of(name, text, kOpen),
              place + ": says that the box is tilted, which is passed over: positions are read as they are");
  }
}

TEST_F(FileBoxes, HaveTheSizeOfAPeriodicDomain) {
  const std::string differs =
      ": says that the box is 10 m along x, where the domain has 4 m, 10 m along y, where the domain has 4 m, 10 m "
      "along z, where the domain has 4 m; a periodic domain must be of the same size";
  const std::pair<const char*, std::string> files[] = {{"p.data:6", data("0 10 xlo xhi\n0 10 ylo yhi\n0 10 zlo zhi\n")},
                                                       {"p.dump:5", dump("pp pp pp\n0 10\n0 10\n0 10")},
                                                       {"p.dump:5", dump("xy xz yz pp pp pp\n0 10 0\n0 10 0\n0 10 0")},
                                                       {"p.xyz:2", xyz(R"(Lattice="10 0 0 0 10 0 0 0 10")")}};
  for (const auto& [where, text] : files) {
    const std::string place = where, name = place.substr(0, place.find(':'));
    EXPECT_EQ(said_of(name, text, kPeriodic), place + differs);
    EXPECT_EQ(said_of(name, text, kOpen), "");
  }
  EXPECT_EQ(said_of("p.data", data("0 4 xlo xhi\n0 10 ylo yhi\n0 10 zlo zhi\n"), R"(["periodic","open","open"])"), "");
}

TEST_F(FileBoxes, ThatFitAreTaken) {
  EXPECT_EQ(said_of("p.data", data("0 4.000001 xlo xhi\n0 4 ylo yhi\n0 4 zlo zhi\n0 0 0 xy xz yz\n"), kPeriodic), "");
  EXPECT_EQ(said_of("p.dump", dump("abc origin pp pp pp\n4 0 0 0\n0 4 0 0\n0 0 4 0"), kPeriodic), "");
  EXPECT_EQ(said_of("p.dump", dump("ss ff ff\n0 1\n0 10\n0 9"), kPeriodic), "") << "no period of the file's";
  EXPECT_EQ(said_of("p.xyz", xyz(R"(Lattice="10 0 0 0 10 0 0 0 10" pbc="F F F")"), kPeriodic), "");
  EXPECT_EQ(said_of("p.xyz", xyz("no box"), kPeriodic), "");
}

}  // namespace
}  // namespace hooke
