// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// How a scene's springs, cloths and bodies become a structure.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "hooke/scene/load_scene.h"
#include "minimal_scene.h"
#include "scratch_folder.h"
#include "support/openvdb.h"

namespace hooke {
namespace {

scene::LoadedScene load(std::vector<std::string> overrides, const std::filesystem::path& folder = ".") {
  scene::LoadOptions options;
  options.overrides = std::move(overrides);
  auto loaded = scene::parse_scene(kMinimalScene, "scene.json", folder, options);
  if (loaded) return std::move(*loaded);
  ADD_FAILURE() << loaded.error().text();
  return {};
}

// The number of springs of each stiffness.
std::map<double, int> counts(const Structure& structure) {
  std::map<double, int> all;
  for (const double k : structure.springs.stiffness) ++all[k];
  return all;
}

TEST(SceneStructure, IsNullWhereThereIsNone) { EXPECT_EQ(load({}).scene.structure, nullptr); }

TEST(SceneStructure, HoldsSpringsOfPairs) {
  const scene::LoadedScene loaded =
      load({R"(particles=[{"material":"water","block":{"min":[1,1,1],"max":[3,1,1],"spacing":1}}])",
            R"(springs=[{"pairs":[[1,2],[3,2]],"stiffness":10},
                   {"pairs":[[1,3]],"stiffness":5,"damping":2,"rest_length":0.5,"mode":"extension","break_strain":0.25,
                    "contact":false}])"});
  const SpringSet& s = loaded.scene.structure->springs;
  ASSERT_EQ(s.size(), 3U);
  EXPECT_EQ(s.a, (std::vector<std::uint64_t>{1, 3, 1}));
  EXPECT_EQ(s.b, (std::vector<std::uint64_t>{2, 2, 3}));
  EXPECT_EQ(s.rest_length, (std::vector<double>{1, 1, 0.5}));
  EXPECT_EQ(s.stiffness, (std::vector<double>{10, 10, 5}));
  EXPECT_EQ(s.damping, (std::vector<double>{0, 0, 2}));
  EXPECT_EQ(s.mode, (std::vector<SpringMode>{SpringMode::both, SpringMode::both, SpringMode::extension}));
  EXPECT_EQ(s.break_strain[0], std::numeric_limits<double>::infinity());
  EXPECT_EQ(s.break_strain[2], 0.25);
  EXPECT_EQ(s.contact, (std::vector<std::uint8_t>{1, 1, 0}));
}

TEST(SceneStructure, MeasuresRestLengthsAcrossPeriodicFaces) {
  const scene::LoadedScene loaded =
      load({R"(particles=[{"material":"water","block":{"min":[1,1,1],"max":[9,1,1],"spacing":8}}])",
            R"(domain.walls=["periodic","spring","spring"])", R"(springs=[{"pairs":[[1,2]],"stiffness":10}])"});
  EXPECT_EQ(loaded.scene.structure->springs.rest_length, (std::vector<double>{2}));
}

TEST(SceneStructure, ReadsSpringsOfFiles) {
  const ScratchFolder folder;
  folder.write("s.csv",
               "\xef\xbb\xbf"
               "stiffness,b,note,a\r\n7,2,x,1\r\n\r\n8,1,\"y, z\",3\r\n");
  const scene::LoadedScene loaded =
      load({R"(particles=[{"material":"water","block":{"min":[1,1,1],"max":[3,1,1],"spacing":1}}])",
            R"(springs=[{"file":"s.csv","stiffness":10,"damping":3}])"},
           folder.path());
  const SpringSet& s = loaded.scene.structure->springs;
  EXPECT_EQ(s.a, (std::vector<std::uint64_t>{1, 3}));
  EXPECT_EQ(s.b, (std::vector<std::uint64_t>{2, 1}));
  EXPECT_EQ(s.rest_length, (std::vector<double>{1, 2}));
  EXPECT_EQ(s.stiffness, (std::vector<double>{7, 8}));
  EXPECT_EQ(s.damping, (std::vector<double>{3, 3}));
}

TEST(SceneStructure, MakesAGridOfACloth) {
  const scene::LoadedScene loaded = load(
      {R"(cloths=[{"material":"water","corner":[1,5,1],"edges":[[4,0,0],[0,0,3]],"cells":[4,3],"stretch":100,"shear":30,
                   "bend":5,"damping":0.5,"velocity":[0,-1,0],"pins":["corner:1,0","edge:2",6]}])"});
  const ParticleSet& p = loaded.particles;
  ASSERT_EQ(p.size(), 2U + 5 * 4);
  EXPECT_EQ(p.id.back(), 22U);
  EXPECT_EQ(p.position[2], (Vec3d{1, 5, 1}));
  EXPECT_EQ(p.position[3], (Vec3d{2, 5, 1})) << "row by row along the first edge";
  EXPECT_EQ(p.position.back(), (Vec3d{5, 5, 4}));
  const Structure& s = *loaded.scene.structure;
  // Sides: 4 x 4 along and 5 x 3 across; two diagonals a cell; 3 x 4 and 5 x 2 to the next particle but one.
  EXPECT_EQ(counts(s), (std::map<double, int>{{100, 31}, {30, 24}, {5, 22}}));
  for (std::size_t i = 0; i < s.springs.size(); ++i) {
    const double k = s.springs.stiffness[i];
    EXPECT_DOUBLE_EQ(s.springs.rest_length[i], k == 100 ? 1 : k == 30 ? std::sqrt(2.0) : 2);
    EXPECT_EQ(s.springs.contact[i], 0);
    EXPECT_EQ(s.springs.damping[i], 0.5);
  }
  // Particle 0 has id 3: the corner at the end of the first side is index 4, the opposite side 15 to 19.
  EXPECT_EQ(s.pinned, (std::vector<std::uint64_t>{7, 9, 18, 19, 20, 21, 22}));
  EXPECT_EQ(p.velocity[2], (Vec3d{0, -1, 0}));
  EXPECT_EQ(p.velocity[p.find(7)], (Vec3d{0, 0, 0}));
  ASSERT_EQ(s.surfaces.size(), 1U);
  EXPECT_EQ(s.surfaces[0].particles.front(), 3U);
  EXPECT_EQ(s.surfaces[0].triangles.size(), 3U * 2 * 12);
}

TEST(SceneStructure, MakesAClothOfAMesh) {
  const ScratchFolder folder;
  // Two squares side by side: the first is two triangles, the second is a polygon of four corners.
  folder.write("m.obj",
               "o sheet\nv 1 1 1\nv 2 1 1\nv 3 1 1\nv 1 1 2\nv 2 1 2\nv 3 1 2\nvt 0 0\nvn 0 1 0\n"
               "f 1/1/1 2/1/1 5/1/1\nf 1//1 5//1 4//1\nf 2 3 6 -2\n");
  const scene::LoadedScene loaded =
      load({R"(cloths=[{"material":"water","mesh":"m.obj","stretch":100,"bend":5,"pins":[0]}])"}, folder.path());
  ASSERT_EQ(loaded.particles.size(), 2U + 6);
  EXPECT_EQ(loaded.particles.position[4], (Vec3d{3, 1, 1}));
  const Structure& s = *loaded.scene.structure;
  // Four triangles have nine edges. Three edges are shared, opposite corners: 1-5 by 2 and 4, 2-5 by 1 and 6, 2-6 by 3
  // and 5.
  EXPECT_EQ(counts(s), (std::map<double, int>{{100, 9}, {5, 3}}));
  EXPECT_EQ(s.pinned, (std::vector<std::uint64_t>{3}));
  EXPECT_EQ(s.surfaces[0].triangles, (std::vector<std::uint32_t>{0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4}));
}

TEST(SceneStructure, WeldsSeamsOfACloth) {
  const ScratchFolder folder;
  // The edge from 2 to 5 is there twice, as 7 and 8; no face uses 9.
  folder.write("m.obj",
               "v 1 1 1\nv 2 1 1\nv 3 1 1\nv 1 1 2\nv 2 1 2\nv 3 1 2\nv 2 1 1\nv 2 1 2\nv 5 5 5\n"
               "f 1 2 5 4\nf 7 3 6 8\n");
  const scene::LoadedScene loaded =
      load({R"(cloths=[{"material":"water","mesh":"m.obj","stretch":100,"bend":5,"pins":[0,7]}])"}, folder.path());
  EXPECT_EQ(loaded.particles.size(), 2U + 6);
  EXPECT_EQ(counts(*loaded.scene.structure), (std::map<double, int>{{100, 9}, {5, 3}}));
  EXPECT_EQ(loaded.scene.structure->pinned, (std::vector<std::uint64_t>{3, 7})) << "corner 7 is particle 4";
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_EQ(loaded.warnings[0].where, "cloths[0].mesh");
  EXPECT_EQ(loaded.warnings[0].message,
            "is \"m.obj\", which has open edges with 2 vertices within 2.2e-05 of others, in the file's unit; they are "
            "welded");
}

TEST(SceneStructure, PinsNoCornerThatNoFaceUses) {
  const ScratchFolder folder;
  folder.write("m.obj", "v 1 1 1\nv 2 1 1\nv 3 1 2\nv 4 4 4\nf 1 2 3\n");
  scene::LoadOptions options;
  options.overrides = {R"(cloths=[{"material":"water","mesh":"m.obj","stretch":100,"pins":[3,4]}])"};
  const auto loaded = scene::parse_scene(kMinimalScene, "scene.json", folder.path(), options);
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().text(),
            "cloths[0].pins[0]: is 3, a corner that no face uses: it is no particle\n"
            "cloths[0].pins[1]: is 4; the cloth has corners 0 to 3");
}

TEST(SceneStructure, FillsBodiesWithTwelveNeighboursEach) {
  for (const char* shape :
       {R"({"sphere":{"center":[5,5,5],"radius":2}})", R"({"box":{"min":[3,3,3],"max":[7,6,5]}})"}) {
    const scene::LoadedScene loaded = load({std::string(R"(bodies=[{"material":"water","spacing":0.4,"stiffness":9,)") +
                                            R"("break_strain":0.5,"velocity":[1,2,3],"shape":)" + shape + "}]"});
    const ParticleSet& p = loaded.particles;
    const SpringSet& s = loaded.scene.structure->springs;
    // A site of a face-centred cubic lattice takes d^3/sqrt(2), so the ball of 33.5 m^3 holds some 740 sites. The box
    // has sites on both of its faces: every other one of 15 x 11 x 8 points.
    const bool ball = shape[2] == 's';
    EXPECT_NEAR(static_cast<double>(p.size() - 2), ball ? 740 : 660, ball ? 37 : 0);
    std::map<std::uint64_t, int> ties;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const Vec3d d = p.position[p.find(s.a[i])] - p.position[p.find(s.b[i])];
      ASSERT_NEAR(std::sqrt(dot(d, d)), 0.4, 1e-12);
      ++ties[s.a[i]];
      ++ties[s.b[i]];
    }
    EXPECT_EQ(ties.size(), p.size() - 2) << "nobody is alone";
    int inside = 0;
    for (const auto& [id, n] : ties) {
      ASSERT_LE(n, 12);
      inside += n == 12 ? 1 : 0;
    }
    EXPECT_GT(inside, static_cast<int>(ties.size()) / 3);
    EXPECT_EQ(s.break_strain.front(), 0.5);
    EXPECT_EQ(p.velocity.back(), (Vec3d{1, 2, 3}));
    if (ball) {
      EXPECT_EQ(std::count(p.position.begin() + 2, p.position.end(), Vec3d{5, 5, 5}), 1) << "one in the middle";
    }
  }
}

TEST(SceneStructure, FillsMeshesWithBodies) {
  HOOKE_NEEDS_OPENVDB();
  const ScratchFolder folder;
  folder.write("cube.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
               "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
  const auto fill = [&](const std::string& placed) {
    return load({R"(bodies=[{"material":"water","spacing":0.25,"stiffness":9,"shape":{"mesh":{"file":"cube.obj",)" +
                 placed + "}}}]"},
                folder.path());
  };
  // 23 planes of sites fit between the faces along each axis; every other crossing of planes is a site.
  const scene::LoadedScene upright = fill(R"("scale":4,"translate":[3,3,3])");
  EXPECT_EQ(upright.particles.size(), 2U + (23 * 23 * 23 - 1) / 2);
  // The body's middle is four times as deep as the field of distances reaches.
  EXPECT_EQ(std::count(upright.particles.position.begin() + 2, upright.particles.position.end(), Vec3d{5, 5, 5}), 1);
  const scene::LoadedScene turned = fill(R"("scale":4,"rotate":[0,1,0,30],"translate":[3,3,5])");
  std::size_t outside = 0;
  const double sine = 0.5, cosine = std::sqrt(0.75);
  for (std::size_t i = 2; i < turned.particles.size(); ++i) {
    const Vec3d x = turned.particles.position[i] - Vec3d{3, 3, 5};
    const Vec3d own{cosine * x.x - sine * x.z, x.y, sine * x.x + cosine * x.z};
    for (int axis = 0; axis < 3; ++axis) {
      if (component(own, axis) < -0.01 || component(own, axis) > 4.01) ++outside;
    }
  }
  EXPECT_EQ(outside, 0U);
  // Each site takes 0.25^3/sqrt(2); half of the layer under the faces, half a plane's distance thick, may be missing.
  EXPECT_NEAR(static_cast<double>(turned.particles.size() - 2), 64 * std::sqrt(2.0) / std::pow(0.25, 3), 300);
}

TEST(SceneStructure, NamesSpringsByTheEntriesThatMadeThem) {
  const scene::LoadedScene loaded =
      load({R"(cloths=[{"material":"water","corner":[1,1,1],"edges":[[1,0,0],[0,0,1]],"cells":[1,1],"stretch":7}])",
            R"(bodies=[{"material":"water","shape":{"box":{"min":[4,4,4],"max":[6,6,6]}},"spacing":1,"stiffness":9}])",
            R"(springs=[{"pairs":[[1,5]],"stiffness":3},{"pairs":[[2,5],[2,6]],"stiffness":5}])"});
  const Structure& structure = *loaded.scene.structure;
  ASSERT_EQ(structure.groups.size(), 4U);
  const char* const names[] = {"cloths[0]", "bodies[0]", "springs[0]", "springs[1]"};
  std::size_t s = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const SpringGroup& group = structure.groups[k];
    EXPECT_EQ(group.name, names[k]);
    EXPECT_GT(group.end, s);
    for (; s < group.end; ++s) {
      const double stiffness = structure.springs.stiffness[s];
      if (k > 0) {
        EXPECT_EQ(stiffness, k == 1 ? 9 : k == 2 ? 3 : 5);
      }
    }
  }
  EXPECT_EQ(s, structure.springs.size());
}

// A checkpoint brings the structure along with the particles.
TEST(SceneStructure, IsNotMadeWithoutParticles) {
  scene::LoadOptions options;
  options.with_particles = false;
  options.overrides = {R"(springs=[{"pairs":[[1,2]],"stiffness":10}])",
                       R"(cloths=[{"material":"water","mesh":"not-there.obj","stretch":100}])"};
  const auto loaded = scene::parse_scene(kMinimalScene, "scene.json", ".", options);
  ASSERT_TRUE(loaded) << loaded.error().text();
  EXPECT_EQ(loaded->scene.structure, nullptr);
}

}  // namespace
}  // namespace hooke
