// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include "hooke/io/checkpoint.h"
#include "hooke/io/export.h"
#include "hooke/io/run_folder.h"
#include "samples.h"

namespace hooke {
namespace {

class ExportSprings : public testing::Test {
 protected:
  Expected<std::vector<std::filesystem::path>> exported(const SimulationState& state) {
    const io::RunReader run = samples::write_run(folder_ / "run", info_, {samples::snapshot(40, 5)});
    EXPECT_TRUE(io::write_checkpoint(folder_ / "run" / io::kCheckpointFile, state, info_));
    io::ExportOptions options;
    options.content = io::ExportContent::springs;
    return io::export_run(run, std::vector<std::size_t>{0}, folder_ / "s.csv", options);
  }

  const samples::TemporaryFolder folder_;
  const io::RunInfo info_ = samples::run_info();
};

TEST_F(ExportSprings, TellsWhichAreBroken) {
  SimulationState state = samples::state(40, 5);
  auto structure = std::make_shared<Structure>();
  structure->springs.push_back({1, 4, 0.1, 1000, 0.5});
  structure->springs.push_back({4, 7, 1.0 / 3, 2e6, 0});
  structure->springs.push_back({7, 1, 2, 5, 0});
  state.structure = structure;
  state.broken_springs = {1};
  ASSERT_TRUE(exported(state));
  EXPECT_EQ(samples::read_file(folder_ / "s.csv"),
            "step,spring,a,b,rest_length,stiffness,damping,broken\n"
            "40,0,1,4,0.1,1000,0.5,0\n"
            "40,1,4,7,0.3333333333333333,2e+06,0,1\n"
            "40,2,7,1,2,5,0,0\n");
}

TEST_F(ExportSprings, OfNoneIsAnError) {
  SimulationState state = samples::state(40, 5);
  state.structure = nullptr;
  state.broken_springs = {};
  const auto files = exported(state);
  ASSERT_FALSE(files);
  EXPECT_EQ(files.error().findings.front().message, "is of a run without springs");
}

}  // namespace
}  // namespace hooke
