// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "scenarios.h"

#include "support/colliders.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

constexpr Boundary kBoundaries[] = {Boundary::spring, Boundary::open, Boundary::periodic};
const char* const kBoundaryNames[] = {"spring", "open", "periodic"};

// Materials of radius 0.25 to 0.4, gravity askew.
Scene mixed_scene(const Vec3d& min, const Vec3d& max) {
  Scene scene = open_scene();
  mix_materials(scene, 0.25);
  scene.gravity = {0.3, -9.8, 0.1};
  scene.domain.min = min;
  scene.domain.max = max;
  scene.domain.boundary = {Boundary::spring, Boundary::spring, Boundary::spring};
  return scene;
}

Scene uniform_scene(const Vec3d& min, const Vec3d& max) {
  Scene scene = mixed_scene(min, max);
  scene.materials = open_scene().materials;
  scene.contacts.clear();
  return scene;
}

// Rounded to single precision. Through memory, because GCC 12 at -O2 optimises the cast of a vector to float and back
// away.
Vec3d rounded(const Vec3d& a) {
  const volatile float x = static_cast<float>(a.x), y = static_cast<float>(a.y), z = static_cast<float>(a.z);
  return {x, y, z};
}

class Collection {
 public:
  void add(const std::string& name, const Scene& scene, ParticleSet particles, std::int64_t steps = 40) {
    for (Vec3d& x : particles.position) x = rounded(x);
    for (Vec3d& v : particles.velocity) v = rounded(v);
    all.push_back({name, scene, std::move(particles), steps});
  }
  void add_cloud(const std::string& name, const Scene& scene, std::size_t count, std::int64_t steps = 40) {
    add(name, scene, cloud(scene, count, scene.domain.min, scene.domain.max, 0.5, count), steps);
  }

  std::vector<Scenario> all;
};

void add_counts(Collection& out) {
  for (const std::size_t count : {0UL, 1UL, 2UL, 15UL, 16UL, 17UL, 33UL, 255UL}) {
    out.add_cloud("count_" + std::to_string(count), mixed_scene({0, 0, 0}, {4, 4, 4}), count);
  }
  out.add_cloud("count_1025", mixed_scene({0, 0, 0}, {8, 6, 6}), 1025, 12);
  out.add_cloud("count_4096", uniform_scene({0, 0, 0}, {20, 14, 20}), 4096, 4);
}

void add_boundaries(Collection& out) {
  for (int mix = 0; mix < 27; ++mix) {
    Scene scene = mixed_scene({0, 0, 0}, {4, 5, 6});
    std::string name = "boundaries";
    for (int axis = 0, rest = mix; axis < 3; ++axis, rest /= 3) {
      scene.domain.boundary[static_cast<std::size_t>(axis)] = kBoundaries[rest % 3];
      name += std::string("_") + kBoundaryNames[rest % 3];
    }
    out.add(name, scene, cloud(scene, 121, scene.domain.min, scene.domain.max, 4, 7), 30);
  }
}

void add_places(Collection& out) {
  out.add_cloud("random_one_material", uniform_scene({0, 0, 0}, {6, 8, 5}), 151, 100);
  out.add_cloud("random_mixed", mixed_scene({0, 0, 0}, {6, 8, 5}), 200, 100);
  out.add_cloud("negative", mixed_scene({-130, -72, -9}, {-125, -66, -4}), 150);
  for (const double at : {-5e5, 5e5 - 8}) {  // a million radii from 0; floats are 0.03 apart there
    out.add_cloud(at < 0 ? "huge_negative" : "huge", uniform_scene({at, at, at}, {at + 8, at + 8, at + 8}), 200);
  }
  Scene sparse = uniform_scene({-5e5, -5e5, -5e5}, {5e5, 5e5, 5e5});
  ParticleSet scattered;
  for (std::size_t i = 0; i < 60; ++i) {
    const auto u = random4(9, i);
    const Vec3d x = 9e5 * Vec3d{u[0] - 0.5, u[1] - 0.5, u[2] - 0.5};
    add(scattered, x, {0, 0, 0});
    add(scattered, x + Vec3d{0.75, 0.25, 0}, {-1, 0, 0.5});
  }
  out.add("huge_sparse_pairs", sparse, scattered);
}

void add_degenerate(Collection& out) {
  const Scene scene = mixed_scene({0, 0, 0}, {9, 9, 9});
  out.add("one_cell", scene, cloud(scene, 90, {4, 4, 4}, {4.5, 4.5, 4.5}, 0.1, 1), 10);
  out.add("coincident", scene, cloud(scene, 21, {4, 4, 4}, {4, 4, 4}, 0, 1), 10);
  out.add("coincident_moving", scene, cloud(scene, 21, {4, 4, 4}, {4, 4, 4}, 0.5, 1), 10);
  out.add("line", scene, cloud(scene, 40, {0, 4, 4}, {9, 4, 4}, 0.1, 1));
  out.add("plane", scene, cloud(scene, 150, {0, 4, 0}, {9, 4, 9}, 0.1, 1));
  out.add("corner", scene, cloud(scene, 30, {0, 0, 0}, {0.5, 0.5, 0.5}, 0.1, 1), 10);
  out.add("on_the_faces", scene, cloud(scene, 50, {0, 0, 9}, {9, 0, 9}, 0.1, 1));
  Scene no_forces = scene;
  for (Material& m : no_forces.materials) m = {m.name, m.radius, m.mass, {0, 0, 0}, 0, ""};
  no_forces.contacts.clear();
  out.add("no_forces", no_forces, cloud(scene, 50, {0, 0, 0}, {9, 9, 9}, 1, 1));
}

void add_tight(Collection& out) {
  const auto box = [&](const std::string& name, const Vec3d& max, std::array<Boundary, 3> boundary, std::size_t count) {
    Scene scene = mixed_scene({0, 0, 0}, max);
    scene.domain.boundary = boundary;
    scene.time_step = 5e-4;
    out.add_cloud(name, scene, count, 20);
  };
  constexpr Boundary P = Boundary::periodic, S = Boundary::spring, O = Boundary::open;
  // The largest radius is 0.4: boxes of one, two, three and four radii.
  box("periodic_one_radius", {0.40625, 5, 5}, {P, S, S}, 40);
  box("periodic_one_diameter", {0.8125, 5, 3}, {P, O, P}, 50);
  box("periodic_three_radii", {5, 1.25, 5}, {S, P, S}, 60);
  box("periodic_two_diameters", {5, 5, 1.625}, {O, S, P}, 60);
  box("periodic_all_tiny", {0.5, 0.625, 0.75}, {P, P, P}, 5);
  box("periodic_one_alone", {0.5, 0.5, 0.5}, {P, P, P}, 1);
  box("thin_between_walls", {0.5, 6, 6}, {S, S, S}, 60);
  box("thin_open", {0.25, 6, 6}, {O, S, S}, 60);
}

// Radii in a ratio of one to ten and more: each size has cells of its own.
void add_sizes(Collection& out) {
  for (std::size_t b = 0; b < std::size(kBoundaries); ++b) {
    Scene scene = mixed_scene({0, 0, 0}, {6, 7, 5});
    scene.materials[0].radius = 0.0625;
    scene.materials[1].radius = 0.75;
    scene.domain.boundary = {kBoundaries[b], Boundary::spring, kBoundaries[b]};
    scene.time_step = 5e-4;
    out.add_cloud(std::string("one_to_twelve_") + kBoundaryNames[b], scene, 200, 20);
  }
}

// Every kind of collider, in the way of particles that fall apart.
void add_colliders(Collection& out) {
  for (std::size_t b = 0; b < std::size(kBoundaries); ++b) {
    Scene scene = mixed_scene({-4, 2, -4}, {4, 10, 4});
    scene.domain.boundary = {kBoundaries[b], Boundary::spring, kBoundaries[b]};
    add_every_collider(scene, {0, 6, 0}, 7);
    out.add(std::string("colliders_") + kBoundaryNames[b], scene,
            cloud(scene, 300, scene.domain.min, scene.domain.max, 4, 12), 60);
  }
}

// Friction, no tension and cohesion, for contacts of every kind.
void add_surface_laws(Collection& out) {
  for (std::size_t b = 0; b < std::size(kBoundaries); ++b) {
    Scene scene = mixed_scene({-4, 2, -4}, {4, 10, 4});
    add_surfaces(scene);
    scene.domain.boundary = {kBoundaries[b], Boundary::spring, kBoundaries[b]};
    add_every_collider(scene, {0, 6, 0}, 7);
    out.add(std::string("surfaces_") + kBoundaryNames[b], scene,
            cloud(scene, 300, scene.domain.min, scene.domain.max, 4, 12), 60);
  }
  Scene tiny = mixed_scene({0, 0, 0}, {0.8125, 5, 3});
  add_surfaces(tiny);
  tiny.domain.boundary[0] = Boundary::periodic;
  tiny.time_step = 5e-4;
  out.add_cloud("surfaces_periodic_one_diameter", tiny, 50, 20);
  Scene many = mixed_scene({0, 0, 0}, {6, 8, 5});
  add_surfaces(many);
  for (const char* name : {"d", "e"}) {
    Material material = many.materials[1];
    material.name = name;
    material.surface.friction *= 2;
    many.materials.push_back(material);
  }
  out.add_cloud("surfaces_five_materials", many, 200, 60);
  Scene alone = uniform_scene({0, 0, 0}, {6, 8, 5});
  alone.materials[0].surface = {0.5, 0, 3, 0.125};
  out.add_cloud("surfaces_one_material", alone, 150, 60);
}

std::vector<Scenario> make_scenarios() {
  Collection out;
  add_counts(out);
  add_boundaries(out);
  add_places(out);
  add_degenerate(out);
  add_tight(out);
  add_sizes(out);
  add_colliders(out);
  add_surface_laws(out);
  return std::move(out.all);
}

}  // namespace

const std::vector<Scenario>& scenarios() {
  static const std::vector<Scenario> all = make_scenarios();
  return all;
}

}  // namespace hooke::test
