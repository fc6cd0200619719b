// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
//
// A broken precondition is reported where it is broken: one test for each kind of precondition that headers state.

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "hooke/backends/cpu/attraction_tree.h"
#include "hooke/backends/cpu/particle_slots.h"
#include "hooke/backends/cpu/pinned_particles.h"
#include "hooke/base/threads.h"
#include "hooke/core/backend.h"
#include "hooke/passes/exclusions.h"
#include "hooke/passes/id_table.h"
#include "support/assertions.h"
#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

class BackendPreconditions : public testing::TestWithParam<Engine> {
 protected:
  BackendPreconditions() {
    auto structure = std::make_shared<Structure>();
    structure->springs.push_back({.a = 1, .b = 2});
    structure->springs.push_back({.a = 1, .b = 2});
    scene_.structure = structure;
    scene_.colliders.push_back({"door", BoxShape{}, false, {}, NoMotion{}});
    scene_.precision = GetParam().precision;
    backend_->configure(scene_);
  }

  Scene scene_ = open_scene();
  std::unique_ptr<Backend> backend_ = make_backend(GetParam());
};

TEST_P(BackendPreconditions, ParticlesAreTheScenes) {
  ParticleSet particles = pair_on_x(scene_, 0.1, {0, 0, 0}, {0, 0, 0});
  std::swap(particles.id[0], particles.id[1]);
  EXPECT_ASSERTS(backend_->assign(particles), "are_particles_of");
  particles.sort_by_id();
  particles.material[0] = 5;
  EXPECT_ASSERTS(backend_->assign(particles), "are_particles_of");
}

TEST_P(BackendPreconditions, EachColliderHasAPose) {
  backend_->assign(pair_on_x(scene_, 0.1, {0, 0, 0}, {0, 0, 0}));
  EXPECT_ASSERTS((void)backend_->measure({}), "poses.size() = 0, scene.colliders.size() = 1");
}

TEST_P(BackendPreconditions, BrokenSpringsAreTheScenesAndAscend) {
  EXPECT_ASSERTS(backend_->break_springs({1, 0}), "is_ascending(broken)");
  EXPECT_ASSERTS(backend_->break_springs({2}), "broken.back() = 2");
}

TEST_P(BackendPreconditions, NewIdsAreAboveAllBefore) {
  const ParticleSet particles = pair_on_x(scene_, 0.1, {0, 0, 0}, {0, 0, 0});
  backend_->assign(particles);
  EXPECT_ASSERTS((void)backend_->insert(particles), "id");
}

TEST_P(BackendPreconditions, WhatIsEditedIsThere) {
  backend_->assign(pair_on_x(scene_, 0.1, {0, 0, 0}, {0, 0, 0}));
  const ParticleAt none{.id = 77};
  EXPECT_ASSERTS(backend_->edit({&none, 1}), "to.id = 77");
}

INSTANTIATE_TEST_SUITE_P(Engines, BackendPreconditions,
                         testing::Values(kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle),
                         [](const auto& engine) { return engine.param.name(); });

TEST(CpuPreconditions, TablesOfIdsAscend) {
  EXPECT_ASSERTS((void)IdTable(std::vector<std::uint64_t>{3, 3}), "is_ascending(ids)");
  IdTable ids(std::vector<std::uint64_t>{3, 4});
  EXPECT_ASSERTS(ids.append(4), "id = 4, size() = 2");
  EXPECT_ASSERTS((void)ids[2], "id_index = 2, size() = 2");
}

TEST(CpuPreconditions, PairsAreOfRanksAndKeptApart) {
  EXPECT_ASSERTS(Exclusions(2, {{0, 2}}), "a = 0, b = 2, id_indices = 2");
  Exclusions pairs(3, {{0, 1}});
  EXPECT_ASSERTS(pairs.release(0, 2), "a = 0, b = 2");
}

TEST(CpuPreconditions, HeldParticlesAreThere) {
  PinnedParticles pinned;
  EXPECT_ASSERTS(pinned.hold(3), "i = 3");
}

TEST(CpuPreconditions, SlotsAreTakenWhereThereIsRoom) {
  ParticleSlots slots;
  slots.lay_out(1, 0, 0, 0, false);
  for (std::size_t k = slots.interacting_end(); k < slots.first_noninteracting(); ++k) (void)slots.take_interacting(0);
  EXPECT_ASSERTS((void)slots.take_interacting(0), "interacting_end_ = 17, first_noninteracting_ = 16");
  EXPECT_ASSERTS((void)slots.take_noninteracting(), "noninteracting_end_ = 16, room() = 16");
  EXPECT_ASSERTS(slots.leave(99), "slot = 99");
}

TEST(CpuPreconditions, CountsAreInRange) {
  EXPECT_ASSERTS(Threads(0), "count = 0");
  EXPECT_ASSERTS((void)AttractionTree<double>().largest_nodes(3), "most = 3");
}

}  // namespace
}  // namespace hooke::test
