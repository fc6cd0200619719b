// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// A build without OpenVDB says so wherever it is needed.
#include <gtest/gtest.h>

#include "hooke/volumes/mesh_field.h"
#include "hooke/volumes/openvdb_support.h"
#include "hooke/volumes/surface_mesh.h"
#include "hooke/volumes/vdb_file.h"

namespace hooke {
namespace {

template <class T>
void expect_refused(const Expected<T>& made) {
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, Error::Kind::bad_input);
  EXPECT_EQ(made.error().text(), "needs OpenVDB, which is not in this build (HOOKE_WITH_OPENVDB)");
}

TEST(WithoutOpenVdb, EveryFunctionSaysSo) {
  const ParticleSet particles;
  const std::vector<double> radius;
  EXPECT_FALSE(volumes::has_openvdb());
  expect_refused(volumes::make_distance_field({}, {}));
  expect_refused(volumes::make_surface_mesh(particles, radius, {}));
  expect_refused(volumes::vdb_points(particles, radius, "", {}));
  expect_refused(volumes::vdb_volume(particles, radius, {}, {}));
}

}  // namespace
}  // namespace hooke
