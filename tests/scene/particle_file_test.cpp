// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Files as sources of a scene's particles, in every format.

#include "hooke/scene/particle_file.h"

#include <gtest/gtest.h>

#include <chrono>

#include "file_reading.h"
#include "hooke/scene/load_scene.h"
#include "minimal_scene.h"

namespace hooke {
namespace {

class ParticleFileTest : public FileReading {
 protected:
  Expected<scene::LoadedScene> load(const std::string& source) {
    scene::LoadOptions options;
    options.overrides = {"materials.oil={\"radius\":0.5,\"mass\":2,\"stiffness\":1}", "particles=[" + source + "]"};
    return scene::parse_scene(kMinimalScene, "scene.json", folder_.path(), options);
  }
};

TEST_F(ParticleFileTest, TypesAndFrameOfTheSceneHold) {
  folder_.write("p.xyz", "1\n\n1 1 1 1\n2\n\n1 2 2 2\nAr 3 3 3\n");
  const auto loaded = load(R"({"file":"p.xyz","types":{"1":"oil","Ar":"water"},"frame":"last","velocity":[1,2,3]})");
  ASSERT_TRUE(loaded) << loaded.error().text();
  EXPECT_EQ(loaded->particles.id, (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(loaded->particles.material, (std::vector<std::uint16_t>{1, 0}));
  EXPECT_EQ(loaded->particles.position, (std::vector<Vec3d>{{2, 2, 2}, {3, 3, 3}}));
  EXPECT_EQ(loaded->particles.velocity, (std::vector<Vec3d>{{1, 2, 3}, {1, 2, 3}}));
  EXPECT_EQ(load(R"({"file":"p.xyz","frame":0})")->particles.size(), 1U);
}

TEST_F(ParticleFileTest, WrongTypesAndFramesAreFindings) {
  folder_.write("p.csv", "x,y,z\n1,1,1\n");
  folder_.write("p.vtk", "");
  const auto refusal = [this](const std::string& source) {
    const auto loaded = load(source);
    return loaded ? "" : loaded.error().text();
  };
  EXPECT_EQ(refusal(R"({"file":"p.csv","material":"oil","frame":1,"types":{"a":"wter","b":7}})"),
            "particles[0].types.b: is 7; must be a text\n"
            "particles[0].frame: is 1; a .csv file holds one snapshot, 0");
  EXPECT_EQ(refusal(R"({"file":"p.csv","material":"oil","frame":1,"types":{"a":"wter"}})"),
            "particles[0].types.a: is \"wter\", which is no material; did you mean \"water\"? the scene has \"water\", "
            "\"oil\"\n"
            "particles[0].frame: is 1; a .csv file holds one snapshot, 0");
  EXPECT_EQ(refusal(R"({"file":"p.csv","material":"oil","frame":"first"})"),
            "particles[0].frame: is \"first\"; must be \"last\"");
  EXPECT_EQ(refusal(R"({"file":"p.csv","material":"oil","frame":-1})"),
            "particles[0].frame: is -1; must be a whole number >= 0 and <= 9007199254740992");
  EXPECT_EQ(refusal(R"({"block":{"min":[1,1,1],"count":1,"spacing":1},"material":"oil","frame":0,"types":{}})"),
            "particles[0].types: is of no use without \"file\"\nparticles[0].frame: is of no use without \"file\"");
  EXPECT_EQ(
      refusal(R"({"file":"p.vtk","material":"oil"})"),
      "particles[0].file: is \"p.vtk\": its extension names no format of particles; known are \".csv\", \".txt\", "
      "\".ply\", \".xyz\", \".extxyz\", \".data\", \".lmp\", \".dump\", \".lammpstrj\"");
  EXPECT_EQ(refusal(R"({"file":"p.csv","material":"oil","frame":0})"), "");
}

TEST_F(ParticleFileTest, NamesTheByteOfABinaryFile) {
  std::string text =
      "ply\nformat binary_big_endian 1.0\nelement vertex 2\nproperty char x\nproperty char y\nproperty char z\n"
      "property char id\nend_header\n";
  const std::size_t start = text.size();
  text += std::string("\1\1\1\7", 4) + std::string("\1\x7f\1\7", 4);
  folder_.write("p.PLY", text);
  const auto loaded = load(R"({"file":"p.PLY","material":"oil"})");
  ASSERT_FALSE(loaded);
  const std::string second = "p.PLY, byte " + std::to_string(start + 4);
  EXPECT_EQ(loaded.error().text(), second + ": centre [1, 127, 1] is outside the domain [0, 0, 0] to [10, 10, 10]\n" +
                                       second + ": id 7 is taken, by p.PLY, byte " + std::to_string(start));
}

TEST_F(ParticleFileTest, HoldsBackWhatRepeatsItselfButNotWhatEndedTheReading) {
  std::string text = "100\n\n";
  for (int i = 0; i < 50; ++i) text += "water 1 2 nan\n";
  read("p.xyz", text);
  const auto all = findings_.take();
  EXPECT_EQ(all.size(), 1U);  // checked before any row is read
  text[0] = '0';
  text.replace(0, 3, "50");
  read("p.xyz", text);
  const auto rows = findings_.take();
  ASSERT_EQ(rows.size(), 21U);
  EXPECT_EQ(rows[20].message, "30 more findings like those above");
}

// Half a million particles of each format; well under a second each in a release build on an idle machine.
TEST_F(ParticleFileTest, ReadsHalfAMillionQuickly) {
  constexpr int kCount = 512000;
  const std::string n = std::to_string(kCount);
  const auto rows = [](const char* before, const char* after, char separator) {
    std::string text;
    for (int i = 1; i <= kCount; ++i) {
      text += before + std::to_string(i) + after;
      for (const char* value : {"12.345678", "2.3456789", "33.456789", "0.125", "-9.8012345", "1.2345e-05"}) {
        text += value;
        text += separator;
      }
      text.back() = '\n';
    }
    return text;
  };
  std::string binary = "ply\nformat binary_big_endian 1.0\nelement vertex " + n + "\n";
  for (const char* name : {"x", "y", "z", "vx", "vy", "vz", "radius"}) {
    binary += std::string("property float ") + name + '\n';
  }
  binary += "property uint id\nproperty ushort material\nend_header\n";
  for (int i = 0; i < kCount; ++i) {
    for (int k = 0; k < 7; ++k) binary.append("\x3f\x00\x00\x00", 4);  // 0.5
    for (const int shift : {24, 16, 8, 0}) binary += static_cast<char>(i >> shift);
    binary.append("\0\0", 2);
  }
  rules_.material = std::uint16_t{0};
  const std::pair<const char*, std::string> files[] = {
      {"p.csv", "id,x,y,z,vx,vy,vz\n" + rows("", ",", ',')},
      {"p.ply", std::move(binary)},
      {"p.xyz", n + "\nProperties=species:S:1:id:I:1:pos:R:3:velo:R:3\n" + rows("water ", " ", ' ')},
      {"p.data", "title\n" + n + " atoms\n\nAtoms # sphere\n\n" + rows("", " 1 1 3.8197186342054885 ", ' ')},
      {"p.dump", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + n + "\nITEM: ATOMS id type x y z vx vy vz\n" +
                     rows("", " 1 ", ' ')}};
  for (const auto& [name, text] : files) {
    const auto file = folder_.write(name, text);
    EXPECT_EQ(scene::count_particles(file, rules_), static_cast<std::uint64_t>(kCount)) << name;
    const auto start = std::chrono::steady_clock::now();
    const auto p = scene::read_particle_file(file, name, rules_, findings_, warnings_);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(complaints(), "") << name;
    EXPECT_EQ(p.position.size(), static_cast<std::size_t>(kCount)) << name;
    RecordProperty(std::string("seconds_") + (name + 2), std::to_string(seconds.count()));
    EXPECT_LT(seconds.count(), 10) << name;
  }
}

}  // namespace
}  // namespace hooke
