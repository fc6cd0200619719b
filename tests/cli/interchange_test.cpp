// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Files of `hooke export` start a scene again: a run, a file exported from it, a scene with that file as particles.

#include <filesystem>

#include "hooke/io/run_folder.h"
#include "hooke/scene/load_scene.h"
#include "program.h"

namespace hooke::test {
namespace {

// Ids that need more than 32 bits, material names that are no words, numbers with many digits.
std::string scene(const std::string& precision, const std::string& particles) {
  return R"({
    "hooke": 1, "precision": ")" +
         precision + R"(", "time": { "step": 0.003, "steps": 21 }, "output": { "every_steps": 7 },
    "domain": { "min": [-1, 0, -2], "max": [7, 8, 9], "walls": ["periodic", "spring", "open"] },
    "materials": {
      "water": { "radius": 0.3, "mass": 1.7, "stiffness": 900, "damping": 3 },
      "sea \"salt\" 100% #1 \u00e4": { "radius": 0.21, "mass": 0.9, "stiffness": 700, "color": "#123456" } },
    "particles": [)" +
         particles + "] }";
}

class Interchange : public ProgramTest, public testing::WithParamInterface<std::string> {
 protected:
  Interchange() {
    std::string csv = "id,x,y,z,vx,vy,vz,material\n";
    for (int i = 0; i < 200; ++i) {
      const std::uint64_t id = static_cast<std::uint64_t>(i) * 37 + (i < 100 ? 5 : std::uint64_t{9} << 40U);
      csv += std::to_string(id) + ',' + std::to_string(0.7 * (i % 10) - 0.9) + ',' +
             std::to_string(0.31 + 0.7 * (i / 10 % 10)) + ',' + std::to_string(0.1 + 0.7 * (i / 100)) + ",-0.123," +
             std::to_string(1.0 / (i + 1)) + ",1e-7," + (i % 3 == 0 ? "\"sea \"\"salt\"\" 100% #1 \u00e4\"" : "water") +
             '\n';
    }
    write("start.csv", csv);
  }

  // Compares the particles of one of the run's snapshots with those that the file brings back.
  void expect_same(const std::string& precision, std::size_t index, const std::string& source) {
    const auto run = io::RunReader::open(path(precision + "/particles.vtkhdf"));
    ASSERT_TRUE(run) << run.error().text();
    const auto snapshot = run->read(index);
    ASSERT_TRUE(snapshot) << snapshot.error().text();
    const auto loaded = scene::parse_scene(scene(precision, source), "again.json", path("."));
    ASSERT_TRUE(loaded) << loaded.error().text();
    for (const Finding& warning : loaded->warnings) {
      if (GetParam() != ".csv") ADD_FAILURE() << warning.where << ": " << warning.message;
    }
    const ParticleSet& expected = snapshot->particles;
    const ParticleSet& found = loaded->particles;
    EXPECT_EQ(found.id, expected.id);
    EXPECT_EQ(found.material, expected.material);
    ASSERT_EQ(found.size(), expected.size());
    // Text formats of a single-precision run have as many digits as single precision needs.
    const auto rounded = [&precision](double value) {
      return precision == "single" ? static_cast<double>(static_cast<float>(value)) : value;
    };
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(rounded(component(found.position[i], axis)), component(expected.position[i], axis)) << i;
        ASSERT_EQ(rounded(component(found.velocity[i], axis)), component(expected.velocity[i], axis)) << i;
      }
    }
  }
};

TEST_P(Interchange, BringsParticlesBackToTheBit) {
  const std::string extension = GetParam();
  for (const std::string precision : {"single", "double"}) {
    SCOPED_TRACE(precision);
    write(precision + ".json", scene(precision, R"({ "file": "start.csv" })"));
    hooke_ok({"run", precision + ".json", "--quiet"});
    hooke_ok({"export", precision, "-o", "last" + extension});
    expect_same(precision, 3, R"({ "file": "last)" + extension + "\" }");
    hooke_ok({"export", precision, "--step", "7", "-o", "step" + extension});
    expect_same(precision, 1, R"({ "file": "step)" + extension + "\" }");
  }
}

TEST_P(Interchange, FindsSnapshotsInAFileOfSeveral) {
  const std::string extension = GetParam();
  if (extension != ".xyz" && extension != ".dump") return;
  write("single.json", scene("single", R"({ "file": "start.csv" })"));
  hooke_ok({"run", "single.json", "--quiet"});
  hooke_ok({"export", "single", "--all", "-o", "all" + extension});
  expect_same("single", extension == ".xyz" ? 0 : 3, R"({ "file": "all)" + extension + "\" }");
  for (const std::size_t frame : {0U, 2U, 3U}) {
    expect_same("single", frame, R"({ "file": "all)" + extension + "\", \"frame\": " + std::to_string(frame) + " }");
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, Interchange, testing::Values(".csv", ".xyz", ".dump", ".data", ".ply"),
                         [](const auto& test) { return test.param.substr(1); });

}  // namespace
}  // namespace hooke::test
