// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "support/particles.h"

namespace hooke::test {
namespace {

struct Due {
  double seconds;
  double dt;
  std::vector<std::int64_t> steps;  // the first few due steps
};

// The first step at or after each multiple.
const Due kDue[] = {
    {0.04, 0.005, {0, 8, 16, 24, 32}}, {0.04, 0.015, {0, 3, 6, 8, 11, 14, 16}}, {0.1, 0.1, {0, 1, 2, 3, 4}},
    {0.3, 0.1, {0, 3, 6, 9, 12}},  // 0.3 is not 3 x 0.1 in binary
    {0.01, 0.03, {0, 1, 2, 3}},    // several multiples a step: once
    {1.0, 0.3, {0, 4, 7, 10, 14}},     {1e-3, 1e-4, {0, 10, 20, 30}},           {1.0 / 3, 1.0 / 30, {0, 10, 20, 30}},
};

TEST(OutputCadence, IsDueAtTheFirstStepAtOrAfterEachMultiple) {
  for (const Due& row : kDue) {
    const OutputCadence cadence{row.seconds, 0};
    std::vector<std::int64_t> due;
    for (std::int64_t step = 0; due.size() < row.steps.size(); ++step) {
      if (cadence.is_due(step, row.dt)) due.push_back(step);
    }
    EXPECT_EQ(due, row.steps) << row.seconds << " s at dt " << row.dt;
  }
}

TEST(OutputCadence, KeepsItsNumberOfOutputsOverLongRuns) {
  const OutputCadence cadence{0.04, 0};
  int due = 0;
  for (std::int64_t step = 1; step <= 800'000; ++step) due += cadence.is_due(step, 0.005) ? 1 : 0;
  EXPECT_EQ(due, 100'000);
}

TEST(OutputCadence, CountsSteps) {
  const OutputCadence cadence{0, 8};
  for (std::int64_t step = 0; step < 50; ++step) EXPECT_EQ(cadence.is_due(step, 0.1), step % 8 == 0);
}

TEST(OutputCadence, OfNeitherIsTheStartOnly) {
  const OutputCadence cadence;
  EXPECT_TRUE(cadence.is_due(0, 0.1));
  for (std::int64_t step = 1; step < 50; ++step) EXPECT_FALSE(cadence.is_due(step, 0.1));
}

struct Fault {
  const char* where;
  std::function<void(Scene&)> make;
};

const Fault kFaults[] = {
    {"time.step", [](Scene& s) { s.time_step = 0; }},
    {"time.step", [](Scene& s) { s.time_step = -1; }},
    {"time.step", [](Scene& s) { s.time_step = NAN; }},
    {"time.step", [](Scene& s) { s.time_step = 1e-60, s.precision = Precision::single_precision; }},
    {"time.steps", [](Scene& s) { s.steps = -1; }},
    {"gravity[1]", [](Scene& s) { s.gravity.y = INFINITY; }},
    {"gravity[2]", [](Scene& s) { s.gravity.z = 1e39, s.precision = Precision::single_precision; }},
    {"domain.max[0]", [](Scene& s) { s.domain.max.x = s.domain.min.x; }},
    {"domain.max[1]", [](Scene& s) { s.domain.max.y = -1e9; }},
    {"domain.min[2]", [](Scene& s) { s.domain.min.z = NAN; }},
    {"domain.max[0]",
     [](Scene& s) { s.domain.min.x = 1e8, s.domain.max.x = 1e8 + 1, s.precision = Precision::single_precision; }},
    {"domain.max[1]",
     [](Scene& s) { s.domain.min.y = 0, s.domain.max.y = 0.4, s.domain.boundary[1] = Boundary::periodic; }},
    {"materials.a.radius", [](Scene& s) { s.materials[0].radius = 0; }},
    {"materials.a.mass", [](Scene& s) { s.materials[0].mass = -2; }},
    {"materials.a.mass", [](Scene& s) { s.materials[0].mass = 1e-50, s.precision = Precision::single_precision; }},
    {"materials.a.stiffness", [](Scene& s) { s.materials[0].contact.stiffness = -1; }},
    {"materials.a.shear", [](Scene& s) { s.materials[0].contact.shear = NAN; }},
    {"materials.a.damping", [](Scene& s) { s.materials[0].contact.damping = -1e-9; }},
    {"materials.a.drag", [](Scene& s) { s.materials[0].drag = -1; }},
    {"materials.wall", [](Scene& s) { s.materials[0].name = "wall"; }},
    {"materials.a", [](Scene& s) { s.materials.push_back(s.materials[0]); }},
    {"contacts[0].between", [](Scene& s) { s.contacts = {{0, 1, {}}}; }},
    {"contacts[0].between", [](Scene& s) { s.contacts = {{ContactEntry::kWall, ContactEntry::kWall, {}}}; }},
    {"contacts[1].between", [](Scene& s) { s.contacts = {{0, 0, {}}, {0, 0, {}}}; }},
    {"contacts[0].stiffness", [](Scene& s) { s.contacts = {{0, ContactEntry::kWall, {-1, 0, 0}}}; }},
    {"output.every", [](Scene& s) { s.output.seconds = -0.1; }},
    {"output.every_steps", [](Scene& s) { s.output.steps = -1; }},
};

TEST(Validate, FindsEachFaultAndNamesItsPlace) {
  for (const Fault& fault : kFaults) {
    Scene scene = open_scene();
    ASSERT_TRUE(validate(scene).empty());
    fault.make(scene);
    const std::vector<Finding> findings = validate(scene);
    ASSERT_EQ(findings.size(), 1U) << fault.where;
    EXPECT_EQ(findings[0].where, fault.where);
    EXPECT_FALSE(findings[0].message.empty());
  }
}

TEST(Validate, ReportsEverythingAtOnce) {
  Scene scene = open_scene();
  scene.time_step = 0;
  scene.gravity.x = NAN;
  scene.materials[0].radius = -1;
  scene.contacts = {{0, 7, {-1, 0, 0}}};
  EXPECT_EQ(validate(scene).size(), 5U);
}

TEST(Validate, AllowsZerosAndOddSizes) {
  Scene scene = open_scene();
  scene.materials[0].contact = {0, 0, 0};
  scene.gravity = {0, 0, 0};
  scene.domain.min = {-1e30, 5, 5};
  scene.domain.max = {1e30, 5.0001, 6};
  EXPECT_TRUE(validate(scene).empty());
  scene.materials.clear();
  EXPECT_TRUE(validate(scene).empty());
}

}  // namespace
}  // namespace hooke::test
