// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
//
// A broken precondition is reported where it is broken: one test for each kind of precondition that headers state.

#include <gtest/gtest.h>

#include "hooke/scene/block_source.h"
#include "hooke/scene/cluster_source.h"
#include "hooke/scene/file_scanner.h"
#include "hooke/scene/lattice.h"
#include "hooke/scene/random_packing.h"
#include "scratch_folder.h"
#include "support/assertions.h"

namespace hooke {
namespace {

const Box3d kBox{{0, 0, 0}, {1, 1, 1}};

TEST(ScenePreconditions, CentresAreApart) {
  EXPECT_ASSERTS(scene::Lattice(scene::LatticeKind::cubic, kBox, 0, {}), "spacing = 0");
  EXPECT_ASSERTS(scene::Lattice(scene::LatticeKind::cubic, kBox, 1, {3, true}), "up.axis = 3");
  EXPECT_ASSERTS((void)scene::random_packing(kBox, -1, 10, 1), "spacing = -1");
  EXPECT_ASSERTS((void)scene::random_packing_bound(kBox, 0), "spacing = 0");
  scene::BlockSource block;
  block.path = "particles[0].block";
  block.spacing = 0;
  EXPECT_ASSERTS((void)scene::expected_count(block), "block.path = \"particles[0].block\", block.spacing = 0");
}

TEST(ScenePreconditions, ClustersAreValid) {
  scene::ClusterSource cluster;
  EXPECT_ASSERTS((void)scene::make_cluster(cluster, 0, {}), "mass = 0");
  cluster.normal = {0, 0, 0};
  EXPECT_ASSERTS((void)scene::make_cluster(cluster, 1, {}), "cluster.normal = (0, 0, 0)");
}

TEST(ScenePreconditions, PiecesOfFilesAreBounded) {
  const ScratchFolder folder;
  scene::FileScanner scanner(folder.write("some.csv", "x,y,z\n"));
  EXPECT_ASSERTS((void)scanner.bytes(scene::FileScanner::kLongestLine + 1), "count = 1048577");
}

}  // namespace
}  // namespace hooke
