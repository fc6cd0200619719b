// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/checkpoint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "hooke/io/checkpoint_slices.h"
#include "samples.h"
#include "support/small_slices.h"

namespace hooke {
namespace {

using samples::TemporaryFolder;

class Checkpoints : public testing::Test {
 protected:
  std::string error_of_reading(const std::filesystem::path& path) {
    const auto read = io::read_checkpoint(path);
    EXPECT_FALSE(read);
    if (read) return {};
    EXPECT_EQ(read.error().kind, Error::Kind::bad_input);
    EXPECT_EQ(read.error().findings.size(), 1U);
    EXPECT_EQ(read.error().findings.front().where, path.string());
    const auto sliced = io::read_checkpoint_in_slices(path);
    EXPECT_FALSE(sliced);
    if (!sliced) {
      EXPECT_EQ(sliced.error().text(), read.error().text());
    }
    return read.error().findings.front().message;
  }

  TemporaryFolder folder;
  std::filesystem::path file = folder / "checkpoint.h5";
};

TEST_F(Checkpoints, ReadBackBitForBit) {
  for (const std::size_t n : {0U, 1U, 17U, 5000U}) {
    const SimulationState state = samples::state(1234567890123, n);
    const io::RunInfo info = samples::run_info();
    ASSERT_TRUE(io::write_checkpoint(file, state, info));
    const auto read = io::read_checkpoint(file);
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->info, info);
    EXPECT_EQ(read->state.step, state.step);
    EXPECT_EQ(read->state.next_id, state.next_id);
    EXPECT_EQ(read->state.ledger, state.ledger);
    ASSERT_TRUE(read->state.structure);
    EXPECT_EQ(*read->state.structure, *state.structure);
    EXPECT_EQ(read->state.broken_springs, state.broken_springs);
    EXPECT_EQ(read->state.emission, state.emission);
    EXPECT_EQ(read->state.initial_energy, state.initial_energy);
    EXPECT_EQ(read->state.initial_momentum, state.initial_momentum);
    EXPECT_TRUE(samples::same(read->state.particles, state.particles));
  }
  EXPECT_EQ(samples::files_in(folder.path()), std::vector<std::string>{"checkpoint.h5"});
}

TEST_F(Checkpoints, ReadInSlicesTheSameBits) {
  for (const bool accelerated : {true, false}) {
    for (const std::size_t n : {0U, 1U, 17U, 5000U}) {
      SimulationState state = samples::state(1234567890123, n);
      if (!accelerated) state.particles.acceleration.clear();
      ASSERT_TRUE(io::write_checkpoint(file, state, samples::run_info()));
      const auto whole = io::read_checkpoint(file);
      const auto sliced = io::read_checkpoint_in_slices(n == 17 ? folder.path() : file);
      ASSERT_TRUE(whole && sliced);
      EXPECT_EQ(sliced->rest.info, whole->info);
      EXPECT_TRUE(sliced->rest.state.particles.empty());
      EXPECT_EQ(sliced->rest.state.step, state.step);
      EXPECT_EQ(sliced->rest.state.next_id, state.next_id);
      EXPECT_EQ(sliced->rest.state.ledger, state.ledger);
      EXPECT_EQ(*sliced->rest.state.structure, *state.structure);
      EXPECT_EQ(sliced->rest.state.broken_springs, state.broken_springs);
      EXPECT_EQ(sliced->rest.state.emission, state.emission);
      EXPECT_EQ(sliced->rest.state.initial_momentum, state.initial_momentum);
      EXPECT_EQ(sliced->particles->size(), n);
      EXPECT_EQ(sliced->particles->identity(), SlicesOfSet(state.particles).identity());
      EXPECT_EQ(sliced->particles->has_accelerations(), accelerated && n > 0);
      // The open file is that of its name when it was opened.
      ASSERT_TRUE(io::write_checkpoint(file, samples::state(3, 40), samples::run_info()));
      for (const std::size_t rows : {1U, 7U, 64U, 5000U, 6000U}) {
        ParticleSet together;
        std::size_t slices = 0;
        ASSERT_TRUE(sliced->particles->visit(rows, [&](const ParticleSlice& slice) {
          ++slices;
          together.id.insert(together.id.end(), slice.id.begin(), slice.id.end());
          together.material.insert(together.material.end(), slice.material.begin(), slice.material.end());
          together.position.insert(together.position.end(), slice.position.begin(), slice.position.end());
          together.velocity.insert(together.velocity.end(), slice.velocity.begin(), slice.velocity.end());
          together.acceleration.insert(together.acceleration.end(), slice.acceleration.begin(),
                                       slice.acceleration.end());
        }));
        EXPECT_EQ(slices, (n + rows - 1) / rows);
        EXPECT_TRUE(samples::same(together, state.particles));
      }
    }
  }
}

// A file that loses its bytes while it is open.
TEST_F(Checkpoints, SayWhereSlicesCantBeRead) {
  ASSERT_TRUE(io::write_checkpoint(file, samples::state(3, 50'000), samples::run_info()));
  const auto sliced = io::read_checkpoint_in_slices(file);
  ASSERT_TRUE(sliced);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 4);
  const auto visited = sliced->particles->visit(1000, [](const ParticleSlice&) {});
  ASSERT_FALSE(visited);
  EXPECT_EQ(visited.error().text(), file.string() + ": has changed while it was read");
}

TEST_F(Checkpoints, KeepAccelerationsEmptyWhereThereAreNone) {
  SimulationState state = samples::state(3, 10);
  state.particles.acceleration.clear();
  ASSERT_TRUE(io::write_checkpoint(file, state, samples::run_info()));
  const auto read = io::read_checkpoint(folder.path());  // the folder of the checkpoint works too
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->state.particles.acceleration.empty());
  EXPECT_TRUE(samples::same(read->state.particles, state.particles));
}

TEST_F(Checkpoints, SayWhatIsWrongWithAFile) {
  EXPECT_NE(error_of_reading(folder / "none.h5").find("No such file"), std::string::npos);
  samples::write_file(file, "");
  EXPECT_EQ(error_of_reading(file), "is empty");
  samples::write_file(file, "step,t,id\n0,0,1\n");
  EXPECT_EQ(error_of_reading(file), "is no checkpoint of Hooke's, or is cut short");

  ASSERT_TRUE(io::write_checkpoint(file, samples::state(3, 100), samples::run_info()));
  const std::string whole = samples::read_file(file);
  samples::write_file(file, whole.substr(0, whole.size() / 2));
  EXPECT_EQ(error_of_reading(file), "is no checkpoint of Hooke's, or is cut short");
}

TEST_F(Checkpoints, NoticeEveryChangedBit) {
  ASSERT_TRUE(io::write_checkpoint(file, samples::state(3, 100), samples::run_info()));
  const std::string whole = samples::read_file(file);
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    std::string damaged = whole;
    const std::size_t at = random() % damaged.size();
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
    samples::write_file(file, damaged);
    const std::string message = error_of_reading(file);
    EXPECT_TRUE(message.find("damaged") != std::string::npos || message.find("no checkpoint") != std::string::npos);
  }
}

// The seal is a sum over blocks of a mebibyte: each is taken along with its place and its length.
TEST_F(Checkpoints, NoticeBlocksThatHaveChangedPlaces) {
  constexpr std::size_t kBlock = std::size_t{1} << 20U;
  ASSERT_TRUE(io::write_checkpoint(file, samples::state(3, 60'000), samples::run_info()));
  const std::string whole = samples::read_file(file);
  ASSERT_GT(whole.size(), 4 * kBlock);
  std::string swapped = whole;
  std::swap_ranges(swapped.begin() + kBlock, swapped.begin() + 2 * kBlock, swapped.begin() + 2 * kBlock);
  ASSERT_NE(swapped, whole);
  samples::write_file(file, swapped);
  EXPECT_EQ(error_of_reading(file), "is a damaged checkpoint: its checksum is wrong");
  samples::write_file(file, whole.substr(0, kBlock) + whole.substr(2 * kBlock));
  EXPECT_EQ(error_of_reading(file), "is a damaged checkpoint: its checksum is wrong");
  samples::write_file(file, whole);
  EXPECT_TRUE(io::read_checkpoint(file));
}

TEST_F(Checkpoints, OfEarlierVersionsAreRefusedByThatName) {
  ASSERT_TRUE(io::write_checkpoint(file, samples::state(3, 10), samples::run_info()));
  std::string before = samples::read_file(file);
  before.replace(before.size() - 16, 8, "HOKECHK1");
  samples::write_file(file, before);
  EXPECT_EQ(error_of_reading(file), "is a checkpoint of an earlier version, which this program can't read");
}

// Particles that come in slices give the bytes of those that come at once.
TEST_F(Checkpoints, AreTheSameFromSlices) {
  const SimulationState state = samples::state(3, 1000);
  ASSERT_TRUE(io::write_checkpoint(file, state, samples::run_info()));
  const std::string whole = samples::read_file(file);
  SimulationState others = state;
  others.particles = {};
  ASSERT_TRUE(io::write_checkpoint(file, others, test::SmallSlices(state.particles, 7), samples::run_info()));
  EXPECT_EQ(samples::read_file(file), whole);
}

TEST_F(Checkpoints, AnErrorOfTheSlicesLeavesTheOldFile) {
  const SimulationState state = samples::state(3, 1000);
  ASSERT_TRUE(io::write_checkpoint(file, state, samples::run_info()));
  const std::string whole = samples::read_file(file);
  const test::SmallSlices failing(state.particles, 10, 1);  // halfway
  const auto written = io::write_checkpoint(file, state, failing, samples::run_info());
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().findings.front().message, "can't be read");
  EXPECT_EQ(samples::read_file(file), whole);
  EXPECT_EQ(samples::files_in(folder.path()), std::vector<std::string>{"checkpoint.h5"});
}

TEST_F(Checkpoints, AnUnwritablePathIsAnError) {
  const auto written =
      io::write_checkpoint(folder / "none" / "checkpoint.h5", samples::state(1, 3), samples::run_info());
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, Error::Kind::io);
  EXPECT_NE(written.error().text().find("No such file"), std::string::npos);
}

TEST(Resumable, NamesEveryDifferenceThatMatters) {
  const io::RunInfo checkpoint = samples::run_info();
  io::RunInfo scene = checkpoint;
  scene.scene = "another name";
  scene.materials[0].radius = 0.3;
  EXPECT_TRUE(io::check_resumable(checkpoint, scene).empty());
  scene.time_step = 0.001;
  scene.integrator = Integrator::velocity_verlet;
  scene.precision = Precision::double_precision;
  scene.materials.pop_back();
  const auto findings = io::check_resumable(checkpoint, scene);
  ASSERT_EQ(findings.size(), 4U);
  EXPECT_EQ(findings[0].where, "time.step");
  EXPECT_NE(findings[0].message.find("0.001"), std::string::npos);
  EXPECT_EQ(findings[3].where, "materials");
}

}  // namespace
}  // namespace hooke
