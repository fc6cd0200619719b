// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Meshes as colliders: their distances against the distances of the shapes that they approximate, and balls that bounce
// off meshes.

#include <gtest/gtest.h>

#include <cmath>

#include "hooke/core/shapes.h"
#include "hooke/scene/load_scene.h"
#include "mesh_shapes.h"
#include "scratch_folder.h"
#include "support/engines.h"
#include "support/openvdb.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

// Closed meshes near their surfaces, inside and out, to a small part of a cell: the rest comes from the curvature of
// the surface between samples and between the triangles' corners.
TEST(DistanceField, IsTheDistanceFromTheSurface) {
  HOOKE_NEEDS_OPENVDB();
  const double cell = 0.05, reach = 0.25;
  const std::pair<Shape, Shape> pairs[] = {
      {BoxShape{{-1, -1, -1}, {1, 0, 1}}, shape_of(box_mesh({-1, -1, -1}, {1, 0, 1}), cell, reach)},
      {SphereShape{{0, -1, 0}, 1}, shape_of(ball_mesh(-1, 1, 256), cell, reach)},
      {CapsuleShape{{0, -1, 0}, {0, -2, 0}, 1}, shape_of(capsule_mesh(-1, -2, 1, 256), cell, reach)},
      {CylinderShape{{0, -1, 0}, {0, 0, 0}, 1},
       shape_of(turned({{0, 0}, {1, 0}, {1, -1}, {0, -1}}, 256), cell, reach)}};
  for (const auto& [shape, mesh] : pairs) {
    double worst = 0;
    int near = 0;
    for (std::uint64_t i = 0; i < 6000; ++i) {
      const auto r = random4(11, i);
      const Vec3d x{3 * r[0] - 1.5, 4 * r[1] - 3.5, 3 * r[2] - 1.5};
      const double expected = distance(shape, x);
      if (std::abs(expected) > reach) {
        if (expected > reach) {
          EXPECT_GT(distance(mesh, x), reach) << "nothing near";
        }
        continue;
      }
      ++near;
      // Behind edges the distance has creases, which a cell rounds off by at most three tenths of a cell.
      worst = std::max(worst, std::abs(distance(mesh, x) - expected));
    }
    EXPECT_GT(near, 300);
    EXPECT_LT(worst, 0.3 * cell) << shape.index();
  }
}

// A ball dropped onto a mesh of each shape moves as it does over the shape itself. Over flat faces the field is exact;
// over curved faces a sample's distance is off by cell^2 / (8 radius), a fortieth of a cell here.
TEST(BouncingBall, GoesTheSameWayOverAMeshOfAShape) {
  HOOKE_NEEDS_OPENVDB();
  const double cell = 0.5 / 3;
  const std::pair<Shape, TriangleMesh> pairs[] = {
      {BoxShape{{-2, -1, -2}, {2, 0, 2}}, box_mesh({-2, -1, -2}, {2, 0, 2})},
      {SphereShape{{0, -3, 0}, 3}, ball_mesh(-3, 3, 512)},
      {CapsuleShape{{0, -2, 0}, {0, -3, 0}, 2}, capsule_mesh(-2, -3, 2, 512)},
      {CylinderShape{{0, -1, 0}, {0, 0, 0}, 2}, turned({{0, 0}, {2, 0}, {2, -1}, {0, -1}}, 64)}};
  ParticleSet ball;
  add(ball, {0.01, 1.5, 0.02}, {0, 0, 0});
  for (const auto& [shape, mesh] : pairs) {
    const MeshShape mesh_shape = shape_of(mesh, cell, 0.5);
    for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle}) {
      Scene scene = open_scene();
      scene.gravity = {0, -9.8, 0};
      scene.colliders.resize(1);
      scene.colliders[0].name = "thing";
      scene.colliders[0].shape = shape;
      Simulation expected = simulate(scene, ball, engine);
      scene.colliders[0].shape = mesh_shape;
      Simulation meshed = simulate(scene, ball, engine);
      for (int i = 0; i < 15; ++i) {
        ASSERT_TRUE(advance(expected, 100));
        ASSERT_TRUE(advance(meshed, 100));
        const Vec3d off = meshed.positions()[0] - expected.positions()[0];
        EXPECT_LT(std::sqrt(dot(off, off)), 0.1 * cell) << shape.index() << " on " << engine.name();
      }
    }
  }
}

// The same bits every time a field is made, and on every back end in double.
TEST(DistanceField, HasTheSameBitsEveryTime) {
  HOOKE_NEEDS_OPENVDB();
  const TriangleMesh mesh = ball_mesh(0, 1, 64);
  const DistanceField a = volumes::make_distance_field(mesh, {0.07, 0.2, true}).value();
  for (int i = 0; i < 3; ++i) {
    const DistanceField b = volumes::make_distance_field(mesh, {0.07, 0.2, true}).value();
    EXPECT_EQ(a.samples, b.samples);
    EXPECT_EQ(a.keys, b.keys);
  }
}

// A plate as thick as one radius stops a ball that falls on it, and so does a sheet without thickness, from both sides.
TEST(MeshCollider, KeepsFeaturesOfOneRadius) {
  HOOKE_NEEDS_OPENVDB();
  const double radius = 0.5;
  TriangleMesh sheet;
  sheet.vertices = {{-2, 0, -2}, {2, 0, -2}, {2, 0, 2}, {-2, 0, 2}};
  sheet.triangles = {{0, 2, 1}, {0, 3, 2}};
  for (const TriangleMesh& mesh : {box_mesh({-2, -0.5, -2}, {2, 0, 2}), sheet}) {
    for (const double side : {1.0, -1.0}) {
      const bool open = scene::count_open_edges(mesh) > 0;
      Scene scene = open_scene();
      scene.gravity = {0, -9.8 * side, 0};
      scene.colliders.resize(1);
      scene.colliders[0].name = "plate";
      scene.colliders[0].shape = shape_of(mesh, radius / 3, radius);
      ParticleSet ball;
      const double face = side > 0 || open ? 0 : -0.5;
      add(ball, {0.3, face + 2 * side, 0.4}, {0, 0, 0});
      scene.materials[0].contact.damping = 20;
      Simulation simulation = simulate(scene, ball, kCpuSingle);
      ASSERT_TRUE(advance(simulation, 5000));
      EXPECT_NEAR(simulation.positions()[0].y, face + side * (radius - 9.8 / 1000), 1e-3);
      EXPECT_NEAR(measured(simulation).colliders[0].force.y, -9.8 * side, 0.01);
    }
  }
}

TEST(MeshFile, IsReadInEveryFormatWithItsPlace) {
  HOOKE_NEEDS_OPENVDB();
  const ScratchFolder folder;
  const TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 2, 3});
  folder.write("box.obj", obj_text(mesh));
  std::string stl = "solid box\n", ply =
                                       "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
                                       "property float z\nelement face 12\nproperty list uchar int vertex_indices\n"
                                       "end_header\n";
  const auto place = [](const Vec3d& x) {
    return std::to_string(x.x) + ' ' + std::to_string(x.y) + ' ' + std::to_string(x.z) + '\n';
  };
  for (const Vec3d& x : mesh.vertices) ply += place(x);
  for (const auto& t : mesh.triangles) {
    ply += "3 " + std::to_string(t[0]) + ' ' + std::to_string(t[1]) + ' ' + std::to_string(t[2]) + '\n';
    stl += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t corner : t) stl += "vertex " + place(mesh.vertices[corner]);
    stl += "endloop\nendfacet\n";
  }
  folder.write("box.ply", ply);
  folder.write("box.stl", stl + "endsolid box\n");
  for (const char* name : {"box.obj", "box.stl", "box.ply"}) {
    const auto read = scene::read_mesh(folder.path() / name);
    ASSERT_TRUE(read) << name << ": " << read.error().text();
    EXPECT_EQ(read->vertices.size(), 8U) << name << ": corners become one";
    EXPECT_EQ(read->triangles.size(), 12U) << name;
    EXPECT_EQ(scene::count_open_edges(*read), 0U) << name;
    const std::string scene = R"({ "hooke": 1, "time": { "step": 0.01, "end": 1 },
      "domain": { "min": [0, 0, 0], "max": [10, 10, 10] },
      "materials": { "water": { "radius": 0.5, "mass": 2, "stiffness": 100 } }, "particles": [],
      "colliders": [ { "shape": { "mesh": { "file": ")" +
                              std::string(name) +
                              R"(", "scale": 2, "rotate": [0, 0, 3, 90], "translate": [5, 1, 1] } } } ] })";
    const auto loaded = scene::parse_scene(scene, "scene.json", folder.path());
    ASSERT_TRUE(loaded) << loaded.error().text();
    const Box3d bounds = bounds_of(loaded->scene.colliders.at(0).shape);
    // 2 x 4 x 6 m; a quarter of a turn about z brings x to y and y to -x.
    EXPECT_NEAR(bounds.min.x, 1, 1e-6) << name;
    EXPECT_NEAR(bounds.max.x, 5, 1e-6);
    EXPECT_NEAR(bounds.min.y, 1, 1e-6);
    EXPECT_NEAR(bounds.max.y, 3, 1e-6);
    EXPECT_NEAR(bounds.max.z, 7, 1e-6);
    EXPECT_TRUE(loaded->warnings.empty());
  }
}

TEST(MeshCollider, SaysThatAMeshIsOpen) {
  HOOKE_NEEDS_OPENVDB();
  const ScratchFolder folder;
  folder.write("funnel.obj", obj_text(turned({{2, 2}, {0.5, 0}}, 32)));
  const auto loaded = scene::parse_scene(R"({ "hooke": 1, "time": { "step": 0.01, "end": 1 },
      "domain": { "min": [-5, -5, -5], "max": [5, 5, 5] },
      "materials": { "water": { "radius": 0.1, "mass": 2, "stiffness": 100 } }, "particles": [],
      "colliders": [ { "shape": { "mesh": { "file": "funnel.obj" } } } ] })",
                                         "scene.json", folder.path());
  ASSERT_TRUE(loaded) << loaded.error().text();
  ASSERT_EQ(loaded->warnings.size(), 1U);
  EXPECT_EQ(loaded->warnings[0].where, "colliders[0].shape.mesh.file");
  EXPECT_EQ(loaded->warnings[0].message,
            "64 edges have a triangle on one side only: the mesh is open, a shell that is touched from both sides");
}

}  // namespace
}  // namespace hooke::test
