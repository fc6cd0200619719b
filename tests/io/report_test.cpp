// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "hooke/backends/reference/reference_backend.h"
#include "samples.h"

namespace hooke {
namespace {

/// Two particles of the first material that touch, falling in a box.
Simulation falling_pair() {
  Scene scene;
  scene.name = "pair";
  scene.time_step = 0.001;
  scene.domain.max = {10, 10, 10};
  Material material;
  material.name = "water";
  material.contact = {1000, 1, 2};
  scene.materials = {material};
  ParticleSet p;
  p.id = {1, 2};
  p.material = {0, 0};
  p.position = {{5, 5, 5}, {5.9, 5, 5}};
  p.velocity = {{0, 0, 0}, {0, 0, 0}};
  auto simulation = Simulation::create(scene, p, make_reference_backend());
  EXPECT_TRUE(simulation);
  return std::move(*simulation);
}

TEST(Report, HasEveryFieldThatIsPromised) {
  Simulation simulation = falling_pair();
  ASSERT_TRUE(simulation.step(50));
  io::RunReport report = io::make_report(simulation, *simulation.measure());
  report.steps = 50;
  report.seconds = 0.25;
  const auto json = nlohmann::json::parse(io::to_json(report));
  EXPECT_EQ(json["particles"], 2);
  EXPECT_EQ(json["steps"], 50);
  EXPECT_EQ(json["step"], 50);
  EXPECT_DOUBLE_EQ(json["time"], 0.05);
  EXPECT_EQ(json["seconds"], 0.25);
  EXPECT_EQ(json["steps_per_second"], 200);
  EXPECT_EQ(json["particle_steps_per_second"], 400);
  EXPECT_EQ(json["device"], "reference");
  EXPECT_EQ(json["precision"], "double");
  EXPECT_GE(json["threads"], 1);
  EXPECT_GT(json["peak_bytes"], 1'000'000);
  EXPECT_EQ(json["state_hash"].get<std::string>().size(), 16U);
  EXPECT_EQ(std::stoull(json["state_hash"].get<std::string>(), nullptr, 16), simulation.state_hash());
  for (const char* part : {"kinetic", "potential", "elastic", "dissipated", "work_by_walls"}) {
    EXPECT_TRUE(json["energy"][part].is_number()) << part;
  }
  EXPECT_EQ(json["momentum"].size(), 3U);
  EXPECT_EQ(json["removed"], 0);
  for (const char* field : {"isa", "contacts_per_particle", "max_overlap_ratio", "neighbour_rebuilds"}) {
    EXPECT_TRUE(json.contains(field)) << field;
  }
  // The work of gravity and of the contact's spring is accounted for, up to the integrator's first-order error.
  EXPECT_NEAR(json["energy"]["balance"], 0, 0.05);
  EXPECT_LT(json["momentum_drift"], 1e-12);
}

TEST(Report, StagesAddUpToTheSeconds) {
  io::RunReport report;
  report.seconds = 10;
  report.stages = {.sort = 1, .list = 2, .motion = 0.5, .force = 4, .drift = 0.25};
  auto stages = nlohmann::json::parse(io::to_json(report)).at("stages");
  EXPECT_TRUE(stages["walls"].is_null()) << "nobody has measured them";
  EXPECT_EQ(stages["force"], 4);
  EXPECT_EQ(stages["rest"], 2.25);
  report.walls = 1.5;
  stages = nlohmann::json::parse(io::to_json(report)).at("stages");
  EXPECT_EQ(stages["walls"], 1.5);
  EXPECT_EQ(stages["force"], 2.5);
  EXPECT_EQ(stages["rest"], 2.25);
}

TEST(Report, CountsEachContactForBothItsParticles) {
  io::RunReport report;
  EXPECT_EQ(report.contacts_per_particle(), 0);
  report.particles = 4;
  report.measurements.contacts = 6;
  EXPECT_EQ(report.contacts_per_particle(), 3);
}

TEST(Report, StaysJsonWhenNumbersAreNot) {
  io::RunReport report;
  report.measurements.kinetic_energy = NAN;
  report.scene = "bad \xff text";
  const auto json = nlohmann::json::parse(io::to_json(report));
  EXPECT_TRUE(json["energy"]["kinetic"].is_null());
}

TEST(Report, SeriesAndSnapshotsComeFromASimulation) {
  Simulation simulation = falling_pair();
  ASSERT_TRUE(simulation.step(3));
  const io::SeriesRow row = io::make_series_row(simulation, *simulation.measure());
  EXPECT_EQ(row.step, 3);
  EXPECT_EQ(row.measurements.particles, 2U);
  const Snapshot snapshot = *simulation.snapshot();
  EXPECT_EQ(snapshot.step, 3);
  EXPECT_EQ(snapshot.time, simulation.time());
  EXPECT_EQ(snapshot.particles.position, simulation.particles().position);
  const io::RunInfo info = io::describe_run(simulation);
  EXPECT_EQ(info.precision, Precision::double_precision);
  EXPECT_EQ(info.materials.at(0).name, "water");
}

TEST(Report, TextFilesAreReplacedWhole) {
  const samples::TemporaryFolder folder;
  ASSERT_TRUE(io::write_text_file(folder / "report.json", "old"));
  ASSERT_TRUE(io::write_text_file(folder / "report.json", "new"));
  EXPECT_EQ(samples::read_file(folder / "report.json"), "new");
  const auto failed = io::write_text_file(folder / "none/report.json", "x");
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().kind, Error::Kind::io);
}

TEST(Report, CountsMemoryBeyondTheProgramsOwn) {
  io::RunReport report;
  EXPECT_EQ(report.bytes_per_particle(), 0);
  report.particles = 1000;
  report.program_bytes = 40'000'000;
  report.peak_bytes = 40'160'000;
  EXPECT_EQ(report.bytes_per_particle(), 160);
}

}  // namespace
}  // namespace hooke
