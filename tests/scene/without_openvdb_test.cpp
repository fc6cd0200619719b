// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// A build without OpenVDB: every mesh that a scene uses as a shape is a finding.
#include <gtest/gtest.h>

#include "hooke/scene/load_scene.h"
#include "hooke/volumes/openvdb_support.h"
#include "scratch_folder.h"

namespace hooke {
namespace {

TEST(WithoutOpenVdb, AMeshIsAFindingAtItsPlace) {
  if (volumes::has_openvdb()) GTEST_SKIP() << "OpenVDB is in this build";
  const ScratchFolder folder;
  folder.write("tetrahedron.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto loaded = scene::parse_scene(R"({ "hooke": 1, "time": { "step": 0.01, "end": 1 },
"domain": { "min": [-5, -5, -5], "max": [5, 5, 5] },
"materials": { "water": { "radius": 0.1, "mass": 2, "stiffness": 100 } }, "particles": [],
"colliders": [ { "shape": { "mesh": { "file": "tetrahedron.obj" } } } ],
"bodies": [ { "material": "water", "spacing": 0.2, "stiffness": 9, "shape": { "mesh": { "file": "tetrahedron.obj" } } } ] })",
                                         "scene.json", folder.path());
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().kind, Error::Kind::bad_input);
  EXPECT_EQ(loaded.error().text(),
            "colliders[0].shape.mesh: needs OpenVDB, which is not in this build (HOOKE_WITH_OPENVDB) (line 4)\n"
            "bodies[0].shape.mesh: needs OpenVDB, which is not in this build (HOOKE_WITH_OPENVDB) (line 5)");
}

}  // namespace
}  // namespace hooke
