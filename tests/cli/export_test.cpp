// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gmock/gmock.h>

#include <sstream>

#include "hooke/io/export.h"
#include "program.h"
#include "support/openvdb.h"

namespace hooke::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class ExportCommand : public ProgramTest {
 protected:
  ExportCommand() {
    write("s.json", small_scene());
    hooke_ok({"run", "s.json", "--steps", "7", "--quiet", "--set", "gravity=[0,0,-9.8]", "--set",
              "domain.walls=[\"spring\",\"periodic\",\"open\"]"});
  }
};

TEST_F(ExportCommand, GivesFormatsTheScene) {
  hooke_ok({"export", "s", "-o", "p.xyz"});
  EXPECT_THAT(read("p.xyz"), HasSubstr(" pbc=\"F T F\" "));
  EXPECT_THAT(read("p.xyz"), HasSubstr("Lattice="));
  hooke_ok({"export", "s", "-o", "p.dump"});
  EXPECT_THAT(read("p.dump"), HasSubstr("BOX BOUNDS ff pp ff\n"));
  hooke_ok({"export", "s", "--all", "-o", "p.usda"});
  EXPECT_THAT(read("p.usda"), HasSubstr("upAxis = \"Z\""));
}

// A run without a checkpoint (not yet written, or lost): cloths come from the scene.
TEST_F(ExportCommand, FindsClothsWithoutACheckpoint) {
  write("flag.json", R"({ "hooke": 1, "time": { "step": 0.001, "end": 0.02 },
      "domain": { "min": [-5, -5, -5], "max": [5, 5, 5] },
      "materials": { "linen": { "radius": 0.05, "mass": 0.01, "stiffness": 100 } }, "particles": [],
      "cloths": [ { "material": "linen", "corner": [0, 0, 0], "edges": [[1, 0, 0], [0, 0, 1]], "cells": [4, 4],
                    "stretch": 100, "shear": 10 } ], "output": { "every": 0.01 } })");
  hooke_ok({"run", "flag.json", "-o", "flag", "--quiet"});
  hooke_ok({"export", "flag", "--as", "cloths", "-o", "with.obj"});
  std::filesystem::remove(path("flag/checkpoint.h5"));
  hooke_ok({"export", "flag", "--as", "cloths", "-o", "without.obj"});
  EXPECT_THAT(read("with.obj"), HasSubstr("\nf 1//1 "));
  EXPECT_EQ(read("with.obj"), read("without.obj"));
}

TEST_F(ExportCommand, DoesWithoutTheSceneOfAFile) {
  hooke_ok({"export", "s/particles.vtkhdf", "-o", "p.xyz"});
  EXPECT_THAT(read("p.xyz"), Not(HasSubstr("Lattice=")));
  std::filesystem::remove(path("s/scene.json"));
  hooke_ok({"export", "s", "-o", "q.xyz"});
  EXPECT_EQ(read("p.xyz"), read("q.xyz"));
}

TEST_F(ExportCommand, AFullDiskIsStatus3AndLeavesNoFile) {
  std::filesystem::create_directory(path("out"));
  std::vector<std::vector<std::string>> exports{{"p.csv"}, {"p.ply"}, {"p.vtp"}};
  if (volumes::has_openvdb()) {
    exports.push_back({"p.vdb"});
    exports.push_back({"p.vdb", "--as", "volume"});
  }
  for (const std::vector<std::string>& each : exports) {
    std::vector<std::string> arguments{"export", "s", "--all", "-o", "out/" + each.front()};
    arguments.insert(arguments.end(), each.begin() + 1, each.end());
    const Outcome full = hooke(arguments, 4000);
    EXPECT_EQ(full.status, 3) << each.front() << full.err;
    EXPECT_THAT(full.err, HasSubstr("can't be written: File too large")) << each.front();
    EXPECT_TRUE(std::filesystem::is_empty(path("out"))) << each.front();
  }
}

TEST_F(ExportCommand, RefusesABrokenScene) {
  write("s/scene.json", "{\"hooke\": 1}");
  const Outcome outcome = hooke({"export", "s", "-o", "p.xyz"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("materials"));
  EXPECT_FALSE(exists("p.xyz"));
}

TEST_F(ExportCommand, HelpListsEveryFormatUnderItsContent) {
  std::istringstream help(hooke_ok({"export", "--help"}));
  std::string content;
  std::size_t listed = 0;
  for (std::string line; std::getline(help, line);) {
    if (line.starts_with("  --as ")) content = line.substr(7);
    for (const io::ExportFormatInfo& format : io::export_formats()) {
      if (content != to_string(format.content) || !line.starts_with(std::string("    ") + format.extension + ' '))
        continue;
      EXPECT_THAT(line, testing::EndsWith(format.description));
      ++listed;
    }
  }
  EXPECT_EQ(listed, io::export_formats().size());
}

TEST_F(ExportCommand, AsAndTheSurfaceAreChecked) {
  hooke_ok({"export", "s", "--as", "particles", "-o", "p.csv"});
  EXPECT_TRUE(exists("p.csv"));
  const Outcome unknown = hooke({"export", "s", "--as", "surface", "-o", "p.csv"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("no extension that names a format for surface"));
  EXPECT_EQ(hooke({"export", "s", "--as", "foam", "-o", "q.csv"}).status, 2);
  HOOKE_NEEDS_OPENVDB();
  for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
           {"radius", "0"}, {"smoothing", "-1"}, {"resolution", "0"}, {"radius", "big"}}) {
    const Outcome outcome = hooke({"export", "s", "--as", "surface", "-o", "q.obj", "--surface-" + wrong[0], wrong[1]});
    EXPECT_EQ(outcome.status, 2) << testing::PrintToString(wrong);
    EXPECT_THAT(outcome.err, HasSubstr(wrong[0]));
  }
  EXPECT_FALSE(exists("q.csv"));
  EXPECT_FALSE(exists("q.obj"));
}

}  // namespace
}  // namespace hooke::test
