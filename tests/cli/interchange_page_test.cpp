// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// docs/interchange.md does what it says; its figures are those of the run.

#include <regex>
#include <sstream>
#include <stdexcept>

#include "hooke/io/run_folder.h"
#include "hooke/scene/load_scene.h"
#include "page.h"
#include "source_dir.h"
#include "support/openvdb.h"

namespace hooke::test {
namespace {

// A value of the last row of a series.
double last_value(const std::string& series, const std::string& column) {
  std::istringstream head(series.substr(0, series.find('\n')));
  std::istringstream last(series.substr(series.rfind('\n', series.size() - 2) + 1));
  std::string name, value;
  while (std::getline(head, name, ',') && std::getline(last, value, ',')) {
    if (name == column) return std::stod(value);
  }
  throw std::runtime_error("no column " + column);
}

class InterchangePage : public PageTest {
 protected:
  // The page's Python finds the fastest particle at the end of the run, and LAMMPS finds the kinetic energy.
  void expect_figures(const std::string& output) const {
    const std::string series = read("out/mixed/series.csv");
    ASSERT_EQ(last_value(series, "step"), 20);
    std::smatch match;
    ASSERT_TRUE(std::regex_search(output, match, std::regex("0\\.08 s: .* fastest ([0-9.]+) m/s"))) << output;
    EXPECT_NEAR(std::stod(match[1]), last_value(series, "max_speed"), 0.01);
    ASSERT_TRUE(std::regex_search(output, match, std::regex("\n +20 +[0-9.e+]+ +0 +0 +([0-9.e+]+) "))) << output;
    EXPECT_NEAR(std::stod(match[1]), last_value(series, "kinetic"), 1e-6 * last_value(series, "kinetic"));
  }

  // From the last snapshot on, LAMMPS and Hooke reach the same state.
  void expect_lammps_went_on() const {
    hooke_ok({"run", "scenes/mixed.json", "--allow-outside", "--set", "precision=\"double\"", "--set",
              R"(particles=[{"file": "../out/last.data"}])", "--steps", "25", "-o", "out/double"});
    const auto run = io::RunReader::open(path("out/double"));
    ASSERT_TRUE(run) << run.error().text();
    const auto ours = run->read(run->size() - 1);
    ASSERT_TRUE(ours) << ours.error().text();
    scene::LoadOptions options;
    options.overrides = {R"(particles=[{"file": "../out/from_lammps.data"}])"};
    options.allow_outside = true;
    const auto theirs = scene::load_scene(path("scenes/mixed.json"), options);
    ASSERT_TRUE(theirs) << theirs.error().text();
    const ParticleSet& a = ours->particles;
    const ParticleSet& b = theirs->particles;
    ASSERT_EQ(a.id, b.id);
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_NEAR(component(a.position[i], axis), component(b.position[i], axis), 1e-12) << i;
        ASSERT_NEAR(component(a.velocity[i], axis), component(b.velocity[i], axis), 1e-10) << i;
      }
    }
  }
};

TEST_F(InterchangePage, Works) {
  HOOKE_NEEDS_OPENVDB();
  std::filesystem::create_directories(path("scenes"));
  // The page's scene, with fewer particles and steps.
  std::string scene = contents(HOOKE_SOURCE_DIR "/scenes/mixed.json");
  for (const auto& [from, to] :
       {std::pair{R"("spacing": 0\.4\b)", R"("spacing": 1.3)"}, std::pair{R"("spacing": 0\.52\b)", R"("spacing": 1.5)"},
        std::pair{R"("end": 8\b)", R"("end": 0.08)"}}) {
    const std::string smaller = std::regex_replace(scene, std::regex(from), to);
    ASSERT_NE(smaller, scene) << from;
    scene = smaller;
  }
  write("scenes/mixed.json", scene);

  const std::string output = follow(HOOKE_SOURCE_DIR "/docs/interchange.md");
  ASSERT_FALSE(HasFailure());
  expect_figures(output);
  expect_lammps_went_on();
}

}  // namespace
}  // namespace hooke::test
