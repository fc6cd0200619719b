// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// What colliders cost in whole steps: a block of 512,000 balls in a box, with nothing in its middle, or with one shape
// there. A wrong result has no speed: balls must touch the shape, no ball may have got into it, and the momentum that
// the shape gave must be accounted for.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "block_of_balls.h"
#include "hooke/scene/mesh_file.h"
#include "hooke/volumes/mesh_field.h"
#include "measured_steps.h"

namespace hooke::bench {
namespace {

constexpr double kSize = 4;  // of shapes, m
constexpr Vec3d kMiddle{kBlockEdge / 2, kBlockEdge / 2, kBlockEdge / 2};

struct Surroundings {
  const char* name;
  std::vector<Collider> colliders;
  std::vector<Shape> shapes;  // the colliders' shapes, solid all through
};

// The boulder of the gallery's avalanche; distances are known up to `reach` (m) outside and three times that inside.
Expected<Shape> boulder(double reach) {
  auto mesh = scene::read_mesh(HOOKE_SOURCE_DIR "/scenes/meshes/rock.obj");
  if (!mesh) return fail(mesh.error());
  for (Vec3d& x : mesh->vertices) x = kMiddle + kSize * x;
  auto field = volumes::make_distance_field(*mesh, {kBallRadius / 3, reach, scene::count_open_edges(*mesh) == 0});
  if (!field) return fail(field.error());
  MeshShape shape;
  shape.field = std::make_shared<const DistanceField>(std::move(*field));
  shape.surface = std::make_shared<const TriangleMesh>(std::move(*mesh));
  return Shape(std::move(shape));
}

Expected<Surroundings> surroundings(std::int64_t choice) {
  const Vec3d along{0.6 * kSize, 0, 0.8 * kSize}, half{kSize, kSize, kSize};
  const auto one = [](const char* name, const Shape& shape, bool hollow = false) {
    Collider it;
    it.name = "it";
    it.shape = shape;
    it.hollow = hollow;
    return Surroundings{name, {it}, {shape}};
  };
  switch (choice) {
    case 0:
      return Surroundings{"none", {}, {}};
    case 1:  // rises to one side of the box
      return one("plane", PlaneShape{{0, 0.5, 0}, {-0.2, 1, 0}});
    case 2:
      return one("box", BoxShape{kMiddle - half, kMiddle + half});
    case 3:
      return one("sphere", SphereShape{kMiddle, kSize});
    case 4:
      return one("capsule", CapsuleShape{kMiddle - along, kMiddle + along, kSize / 2});
    case 5:
      return one("cylinder", CylinderShape{kMiddle - along, kMiddle + along, kSize / 2});
    case 6:  // balls inside and outside
      return one("hollow cylinder", CylinderShape{kMiddle - along, kMiddle + along, kSize}, true);
    default: {
      auto near = boulder(1.5 * kBallRadius), all_through = boulder(kSize / 3);
      if (!near) return fail(near.error());
      if (!all_through) return fail(all_through.error());
      Surroundings mesh = one("mesh", *near);
      mesh.shapes = {*all_through};
      return mesh;
    }
  }
}

void collider_steps(benchmark::State& state) {
  auto around = surroundings(state.range(0));
  if (!around) return state.SkipWithError(around.error().text().c_str());
  Scene scene = block_of_balls_scene(precision_of(state));
  scene.colliders = around->colliders;
  std::vector<ShapeGeometry<double>> shapes;
  for (const Shape& shape : around->shapes) {
    shapes.push_back(geometry_of(shape, scene.colliders[0].hollow, {0, 0, 0}));
  }
  const auto nearer_than = [&](const Vec3d& x, double distance) {
    for (const ShapeGeometry<double>& shape : shapes) {
      bool near = false;
      for_each_face(shape, x, [&](const SurfaceDistance<double>& face) { near = near || face.distance < distance; });
      if (near) return true;
    }
    return false;
  };
  const ParticleSet balls = block_of_balls([&](const Vec3d& x) { return nearer_than(x, 0.9 * kBallRadius); });
  auto simulation = simulate(state, std::move(scene), balls);
  if (!simulation) return state.SkipWithError(simulation.error().text().c_str());
  const auto now = run_steps(state, *simulation, 100);
  if (!now) return state.SkipWithError(now.error().text().c_str());
  for (const ColliderLoad& load : now->colliders) {
    if (load.contacts < 300 || !(load.force.y < 0)) return state.SkipWithError("the shape bears nobody");
    state.counters["touching"] = static_cast<double>(load.contacts);
  }
  for (const Vec3d& x : simulation->positions()) {
    if (nearer_than(x, kBallRadius / 2)) return state.SkipWithError("a ball has got into the shape");
  }
  state.SetLabel(std::string(around->name) + ", " + simulation->backend_info().isa);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kBallsInBlock));
}
BENCHMARK(collider_steps)
    ->ArgNames({"shape", "double", "threads"})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->ArgsProduct({{0, 1, 2, 3, 4, 5, 6, 7}, {0}, {2}})
    ->ArgsProduct({{0, 3, 7}, {1}, {2}});

}  // namespace
}  // namespace hooke::bench
