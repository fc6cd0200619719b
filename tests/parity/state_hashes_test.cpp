// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The state hashes are a promise: the same scene has the same bits on every processor, with every compiler, and in the
// next version of Hooke. state_hashes.txt has them, of each scenario's end.

#include <gtest/gtest.h>

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

#include "scenarios.h"
#include "source_dir.h"
#include "support/engines.h"

namespace hooke::test {
namespace {

constexpr const char* kTable = HOOKE_SOURCE_DIR "/tests/parity/state_hashes.txt";

using Hashes = std::map<std::string, std::string>;  // of "SCENARIO INTEGRATOR PRECISION"

const Hashes& promised() {
  static const Hashes hashes = [] {
    Hashes read;
    std::ifstream file(kTable);
    for (std::string line; std::getline(file, line);) {
      const std::size_t end = line.rfind(' ');
      if (end != std::string::npos && line[0] != '#') read[line.substr(0, end)] = line.substr(end + 1);
    }
    return read;
  }();
  return hashes;
}

// HOOKE_UPDATE_HASHES=1 parity_test --gtest_filter='*PromisedBits*' writes the table anew: for a change that alters
// bits, and says why.
class Update : public testing::Environment {
 public:
  void TearDown() override {
    if (std::getenv("HOOKE_UPDATE_HASHES") == nullptr || hashes.empty()) return;
    std::ofstream file(kTable);
    file << "# What tests/parity/state_hashes_test.cpp compares: scenario, integrator, precision, state hash at its "
            "end.\n";
    for (const auto& [name, hash] : hashes) file << name << ' ' << hash << '\n';
  }
  Hashes hashes;
};
Update& update = *static_cast<Update*>(testing::AddGlobalTestEnvironment(new Update));

class States : public testing::TestWithParam<Scenario> {};

TEST_P(States, HaveThePromisedBits) {
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
      Scene scene = GetParam().scene;
      scene.integrator = integrator;
      Simulation cpu = simulate(scene, GetParam().particles, {"cpu", precision, 2, ""});
      (void)cpu.step(GetParam().steps);  // may fail
      char hash[17];
      std::snprintf(hash, sizeof hash, "%016" PRIx64, cpu.state_hash());
      const std::string name = GetParam().name + ' ' + to_string(integrator) + ' ' + to_string(precision);
      update.hashes[name] = hash;
      if (std::getenv("HOOKE_UPDATE_HASHES") != nullptr) continue;
      const auto known = promised().find(name);
      ASSERT_NE(known, promised().end()) << name << " is not in " << kTable;
      EXPECT_EQ(hash, known->second) << name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, States, testing::ValuesIn(scenarios()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace hooke::test
