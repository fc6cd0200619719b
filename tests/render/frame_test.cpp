// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/render/frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "hooke/render/spring_meshes.h"

namespace hooke {
namespace {

Scene tank(const Vec3d& corner = {0, 0, 0}) {
  Scene scene;
  scene.domain = {corner, corner + Vec3d{8, 6, 4}, {Boundary::spring, Boundary::open, Boundary::periodic}};
  scene.materials = {{"a", 0.25, 1, {}, 0, "#c02040"},
                     {"b", 0.5, 1, {}, 0, ""},
                     {"c", 0.125, 1, {}, 0, ""},
                     {"water", 0.2, 1, {}, 0, "#2f7fd6", MaterialLook::water}};
  return scene;
}

ParticleSet one_of_each(const Vec3d& corner = {0, 0, 0}) {
  ParticleSet particles;
  particles.resize(4);
  particles.id = {1, 2, 3, 4};
  particles.material = {0, 1, 2, 3};
  particles.position = {corner + Vec3d{1, 1, 1}, corner + Vec3d{2, 1.5, 1}, corner + Vec3d{3.25, 1, 1.75},
                        corner + Vec3d{4, 2, 2}};
  return particles;
}

// A surface replaces the spheres of its particles.
TEST(MakeFrame, SurfacesAreDrawnInPlaceOfTheirParticles) {
  Scene scene = tank();
  ParticleSet particles = one_of_each();
  particles.position[0] = {1, 1, 1};
  particles.position[1] = {2, 1, 1};
  particles.position[2] = {2, 1, 3};
  auto structure = std::make_shared<Structure>();
  structure->surfaces = {{"linen", {1, 2, 3, 77}, {0, 1, 2, 0, 2, 3}}};  // there is no particle 77 any more
  scene.structure = structure;
  const render::Frame frame =
      render::make_frame(scene, particles, 0, render::make_look(scene, particles, render::ColorBy::material), 1.5);
  ASSERT_EQ(frame.spheres.size(), 1u) << "particle 4";
  ASSERT_EQ(frame.meshes.size(), 1u);
  const render::ShadedMesh& mesh = frame.meshes[0];
  ASSERT_EQ(mesh.corners.size(), 3u) << "one triangle is left";
  EXPECT_EQ(mesh.corners[0].normal, (Vec3f{0, -1, 0}));
  EXPECT_EQ(mesh.color, (render::Color{0xc0, 0x20, 0x40}));
  EXPECT_EQ(mesh.corners[2].position, vec_cast<float>(particles.position[2] - frame.origin));

  // A triangle is a hole where a spring along its edge, 1 m long here, is stretched so far that it breaks.
  for (const double break_strain : {0.2, 0.3}) {
    auto tearable = std::make_shared<Structure>(*structure);
    tearable->springs.push_back({2, 1, 0.8, 100, 0, break_strain});
    scene.structure = tearable;
    const render::Frame torn =
        render::make_frame(scene, particles, 0, render::make_look(scene, particles, render::ColorBy::material), 1.5);
    EXPECT_EQ(torn.meshes[0].corners.size(), break_strain < 0.25 ? 0u : 3u);
  }
  scene.structure = structure;

  // The two ends of an edge across a periodic face are neighbours, but far apart in a picture.
  scene.domain.boundary = {Boundary::periodic, Boundary::periodic, Boundary::periodic};
  particles.position[1].x = scene.domain.min.x + 0.9 * scene.domain.length(0);
  const render::Look look = render::make_look(scene, particles, render::ColorBy::material);
  EXPECT_TRUE(render::make_frame(scene, particles, 0, look, 1.5).meshes[0].corners.empty());
}

TEST(MakeFrame, TheSkyOfStarsIsBlack) {
  Scene scene;
  scene.materials = {{"star", 0.5, 1, {0, 0, 0}, 0, ""}};
  ParticleSet particles;
  particles.id = {1};
  particles.material = {0};
  particles.position = {{0.5, 0.5, 0.5}};
  particles.velocity = {{0, 0, 0}};
  const auto is_night = [&] {
    return render::make_frame(scene, particles, 0, render::make_look(scene, particles, render::ColorBy::material), 1)
        .night;
  };
  scene.gravity = {0, 0, 0};
  EXPECT_FALSE(is_night());
  scene.attraction = Attraction{};
  EXPECT_TRUE(is_night());
  scene.gravity = {0, -9.8, 0};
  EXPECT_FALSE(is_night()) << "there is a ground";
}

TEST(MakeFrame, SpheresArePlacedColouredAndSizedByTheirParticles) {
  const Scene scene = tank();
  const ParticleSet particles = one_of_each();
  const render::Frame frame =
      render::make_frame(scene, particles, 0, render::make_look(scene, particles, render::ColorBy::material), 1.5);
  ASSERT_EQ(frame.spheres.size(), 4u);
  EXPECT_FALSE(frame.scale);
  for (std::size_t i = 0; i < 4; ++i) {
    const render::Sphere& s = frame.spheres[i];
    const Vec3d expected = particles.position[i] - frame.origin;
    EXPECT_NEAR(s.x, expected.x, 1e-6);
    EXPECT_NEAR(s.y, expected.y, 1e-6);
    EXPECT_NEAR(s.z, expected.z, 1e-6);
  }
  EXPECT_EQ(frame.spheres[0].color, (render::Color{0xc0, 0x20, 0x40}));
  EXPECT_NE(frame.spheres[1].color, frame.spheres[2].color);  // materials without a colour of their own differ
  EXPECT_EQ(frame.spheres[0].radius, 0.25f);
  EXPECT_EQ(frame.spheres[1].radius, 0.5f);
}

TEST(MakeFrame, SparksGlowAtNight) {
  Scene scene = tank();
  const ParticleSet particles = one_of_each();
  const render::Look look = render::make_look(scene, particles, render::ColorBy::material);
  render::Frame frame = render::make_frame(scene, particles, 0, look, 1.5);
  EXPECT_EQ(frame.daylight, 1);
  for (const render::Sphere& sphere : frame.spheres) EXPECT_FALSE(sphere.glows);
  scene.materials[1].look = MaterialLook::spark;
  frame = render::make_frame(scene, particles, 0, look, 1.5);
  EXPECT_LT(frame.daylight, 0.5);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(frame.spheres[i].glows, i == 1);
}

// A block of 1,000 particles of water, and a drop far from it.
ParticleSet block_and_drop() {
  ParticleSet particles;
  for (std::size_t k = 0; k < 1001; ++k) {
    const auto at = [](std::size_t n) { return 0.3 + 0.38 * static_cast<double>(n); };
    particles.id.push_back(k + 1);
    particles.position.push_back(k < 1000 ? Vec3d{at(k % 10), at(k / 100), at(k / 10 % 10)} : Vec3d{6.5, 4, 2});
  }
  particles.material.assign(1001, 3);
  particles.velocity.assign(1001, {0, 0, 0});
  return particles;
}

TEST(MakeFrame, WaterFoamsWhereItChurns) {
  Scene scene = tank();
  ParticleSet particles = block_and_drop();
  const render::Look look = render::make_look(scene, particles, render::ColorBy::material);
  const auto foam_at = [&](std::size_t i) {
    return int{render::make_frame(scene, particles, 0, look, 1.5).spheres[i].foam};
  };
  EXPECT_EQ(foam_at(555), 1) << "clear, but water";
  EXPECT_EQ(foam_at(1000), 1);

  // Neighbours that move against each other; the drop is alone.
  int before = 1;
  for (const double speed : {0.1, 0.15, 0.25, 0.4}) {
    for (std::size_t i = 0; i < 1001; ++i) particles.velocity[i] = {(i % 2 ? 1 : -1) * speed * look.foam_speed, 0, 0};
    EXPECT_GT(foam_at(555), before == 255 ? 254 : before) << speed;
    EXPECT_EQ(foam_at(1000), 1) << speed;
    before = foam_at(555);
  }
  EXPECT_EQ(before, 255);
  scene.materials[3].foam = 0.5;
  EXPECT_NEAR(foam_at(555), 128, 1);
  scene.materials[3].foam = 0;
  EXPECT_EQ(foam_at(555), 1);

  // However fast water falls together, it stays clear.
  scene.materials[3].foam = 1;
  particles.velocity.assign(1001, {0, -1.5 * look.foam_speed, 0});
  EXPECT_EQ(foam_at(555), 1);
}

TEST(MakeFrame, OnlyWaterIsDrawnAsWater) {
  const Scene scene = tank();
  const ParticleSet particles = one_of_each();
  render::Frame frame =
      render::make_frame(scene, particles, 0, render::make_look(scene, particles, render::ColorBy::material), 1.5);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(render::kind_of(frame.spheres[i]), i == 3 ? render::SphereKind::water : render::SphereKind::ball) << i;
  }
  // Coloured by a quantity, water is drawn as balls like everything else.
  frame = render::make_frame(scene, particles, 0, render::make_look(scene, particles, render::ColorBy::speed), 1.5);
  EXPECT_EQ(frame.spheres[3].foam, 0);
  EXPECT_EQ(frame.spheres[3].radius, 0.2f);
}

TEST(MakeFrame, DropsAreSmallAndSheetsWide) {
  const Scene scene = tank();
  const ParticleSet particles = block_and_drop();
  const render::Frame frame =
      render::make_frame(scene, particles, 0, render::make_look(scene, particles, render::ColorBy::material), 1.5);
  EXPECT_LT(frame.spheres[1000].radius, 0.2f);
  EXPECT_NEAR(frame.spheres[555].radius, 1.25f * 0.2f, 1e-4);
  ParticleSet sheet = particles;
  for (std::size_t k = 0; k < 1000; ++k) sheet.position[k].y = k < 100 ? 3 : 5.5;
  EXPECT_GT(render::make_frame(scene, sheet, 0, render::make_look(scene, particles, render::ColorBy::material), 1.5)
                .spheres[55]
                .radius,
            0.26f);
}

// Loose particles get fine drops, which stay between the walls; a particle alone stays one drop.
TEST(MakeFrame, SprayHasFineDrops) {
  const Scene scene = tank();
  ParticleSet particles;
  for (std::size_t k = 0; k < 125; ++k) {
    const auto at = [](std::size_t n) { return 0.05 + 1.0 * static_cast<double>(n); };
    particles.id.push_back(k + 1);
    particles.position.push_back({at(k % 5), at(k / 25), 0.5 * at(k / 5 % 5)});
  }
  particles.material.assign(125, 3);
  particles.velocity.assign(125, {0, 0, 0});
  const render::Look look = render::make_look(scene, particles, render::ColorBy::material);
  const render::Frame spray = render::make_frame(scene, particles, 0, look, 1.5);
  ASSERT_GT(spray.fine_drops, 125u);
  ASSERT_EQ(spray.spheres.size(), 125 + spray.fine_drops);
  EXPECT_GT(render::typical_radius(spray, render::SphereKind::water), 0.05f) << "not of fine drops";
  for (std::size_t i = 0; i < spray.spheres.size(); ++i) {
    const render::Sphere& drop = spray.spheres[i];
    EXPECT_EQ(render::kind_of(drop), render::SphereKind::water) << i;
    if (i < 125) continue;
    EXPECT_LT(drop.radius, 0.1f) << i;
    EXPECT_GE(drop.x - drop.radius, static_cast<float>(spray.tank.min.x) - 1e-5f) << i;
  }
  const render::Frame again = render::make_frame(scene, particles, 0, look, 1.5);
  ASSERT_EQ(again.spheres.size(), spray.spheres.size());
  EXPECT_EQ(again.spheres.back().x, spray.spheres.back().x);

  particles.resize(1);
  particles.position[0] = {4, 3, 2};
  const render::Frame alone = render::make_frame(scene, particles, 0, look, 1.5);
  EXPECT_EQ(alone.fine_drops, 0u);
  EXPECT_EQ(alone.spheres.size(), 1u);
}

TEST(MakeFrame, SkinsOfDifferentBodiesAreToldApart) {
  Scene scene = tank();
  scene.materials[0].look = scene.materials[1].look = MaterialLook::skin;
  ParticleSet particles;
  particles.resize(7);
  particles.id = {1, 2, 3, 4, 5, 6, 7};
  particles.material = {0, 0, 0, 0, 0, 1, 2};
  for (std::size_t i = 0; i < 7; ++i) particles.position[i] = {1.0 + 0.5 * static_cast<double>(i), 1, 1};
  auto structure = std::make_shared<Structure>();
  structure->springs.push_back({4, 3, 1, 100});
  structure->springs.push_back({2, 1, 1, 100});
  scene.structure = structure;
  const render::Frame frame =
      render::make_frame(scene, particles, 0, render::make_look(scene, particles, render::ColorBy::material), 1.5);
  const auto body = [&](std::size_t i) { return int{frame.spheres[i].body}; };
  EXPECT_EQ(body(0), body(1));
  EXPECT_EQ(body(2), body(3));
  const std::set<int> different{body(0), body(2), body(4), body(5), body(6)};
  EXPECT_EQ(different.size(), 5u) << "two tied pairs, and what nothing ties by material";
  EXPECT_EQ(body(6), 0) << "no skin";
}

TEST(MakeFrame, SkinIsWiderThanItsParticlesAndOpaque) {
  Scene scene = tank();
  scene.materials[0].look = MaterialLook::skin;
  scene.materials[0].roughness = 0;
  const ParticleSet particles = one_of_each();
  const render::Frame frame =
      render::make_frame(scene, particles, 0, render::make_look(scene, particles, render::ColorBy::material), 1.5);
  EXPECT_EQ(render::kind_of(frame.spheres[0]), render::SphereKind::skin);
  EXPECT_GT(frame.spheres[0].radius, 0.25f);
  EXPECT_EQ(frame.spheres[0].roughness, 0);
  EXPECT_EQ(frame.spheres[1].roughness, 128) << "half by default";
}

TEST(MakeFrame, ThePictureIsAsTheSceneWantsIt) {
  Scene scene = tank();
  const ParticleSet particles = one_of_each();
  const auto frame = [&] {
    return render::make_frame(scene, particles, 0, render::make_look(scene, particles, render::ColorBy::material), 1.5);
  };
  EXPECT_TRUE(frame().tank.walls[0]);
  EXPECT_TRUE(frame().ground);
  EXPECT_FALSE(frame().background);
  scene.picture.box = scene.picture.ground = scene.picture.ground_lines = false;
  scene.picture.background = "#ff8000";
  scene.picture.ground_color = "#102030";
  scene.picture.sun = Vec3d{0, 0, 5};
  scene.picture.sunlight = 2;
  const render::Frame own = frame();
  EXPECT_FALSE(own.tank.walls[0]);
  EXPECT_FALSE(own.ground);
  EXPECT_FALSE(own.ground_lines);
  EXPECT_EQ(own.background, (render::Color{255, 128, 0}));
  EXPECT_EQ(own.ground_color, (render::Color{16, 32, 48}));
  EXPECT_EQ(own.to_sun, (Vec3d{0, 0, 1}));
  EXPECT_EQ(own.sunlight, 2);
  scene.picture.background = "sky";
  EXPECT_TRUE(frame().bright_sky);
}

TEST(MakeFrame, SpringsAreDrawnOnDemand) {
  Scene scene = tank();
  ParticleSet particles = one_of_each();
  auto structure = std::make_shared<Structure>();
  structure->springs.push_back({1, 2, 1, 100});
  structure->springs.push_back({2, 3, 1, 100, 0, 0.1});
  scene.structure = structure;
  particles.position[1] = particles.position[0] + Vec3d{1.05, 0, 0};
  particles.position[2] = particles.position[1] + Vec3d{1.05, 0, 0};
  const auto frame = [&] {
    return render::make_frame(scene, particles, 0, render::make_look(scene, particles, render::ColorBy::material), 1.5);
  };
  EXPECT_TRUE(frame().meshes.empty());
  scene.picture.springs = SpringLook::rods;
  ASSERT_EQ(frame().meshes.size(), 2u) << "a colour each";
  EXPECT_EQ(frame().meshes[0].color, (render::Color{0xc0, 0x20, 0x40}));
  EXPECT_EQ(frame().spheres.size(), 4u);
  scene.picture.springs = SpringLook::strain;
  const render::Color half = frame().meshes[0].color;
  EXPECT_EQ(half, render::strain_color(0.5)) << "5 % of the 10 % that are coloured fully";
  EXPECT_GT(half.red, half.blue);
  particles.position[2].x += 0.2;
  EXPECT_EQ(frame().meshes.size(), 1u) << "the other is broken";
  particles.position[1].x -= 0.2;
  EXPECT_EQ(frame().meshes[0].color, render::strain_color(-1)) << "pushed together";
}

TEST(MakeFrame, ColoursFollowTheScale) {
  const Scene scene = tank();
  ParticleSet particles = one_of_each();
  particles.velocity = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 9}};
  const render::Look look = render::make_look(scene, particles, render::ColorBy::speed, std::array{1.0, 3.0});
  const render::Frame frame = render::make_frame(scene, particles, 0, look, 1.5);
  ASSERT_TRUE(frame.scale);
  EXPECT_EQ(frame.scale->low, 1);
  EXPECT_EQ(frame.scale->high, 3);
  EXPECT_EQ(frame.spheres[0].color, render::map_color(0));
  EXPECT_EQ(frame.spheres[1].color, render::map_color(0.5));
  EXPECT_EQ(frame.spheres[2].color, render::map_color(1));
  EXPECT_EQ(frame.spheres[3].color, render::map_color(1));
}

TEST(MakeFrame, FarFromTheOriginNothingIsLost) {
  const Vec3d far{1e6, -2e6, 3e6};
  const Scene scene = tank(far), near_scene = tank();
  const ParticleSet particles = one_of_each(far), near_particles = one_of_each();
  const render::Frame frame =
      render::make_frame(scene, particles, 0, render::make_look(scene, particles, render::ColorBy::material), 1.5);
  const render::Frame near = render::make_frame(
      near_scene, near_particles, 0, render::make_look(near_scene, near_particles, render::ColorBy::material), 1.5);
  for (std::size_t i = 0; i < frame.spheres.size(); ++i) {
    EXPECT_NEAR(frame.spheres[i].x, near.spheres[i].x, 1e-6);
    EXPECT_NEAR(frame.spheres[i].y, near.spheres[i].y, 1e-6);
    EXPECT_NEAR(frame.spheres[i].z, near.spheres[i].z, 1e-6);
  }
  EXPECT_NEAR(frame.camera.eye.x, near.camera.eye.x, 1e-6);
  EXPECT_NEAR(frame.camera.target.z, near.camera.target.z, 1e-6);
  EXPECT_NEAR(frame.tank.max.x - frame.tank.min.x, 8, 1e-9);
  ASSERT_TRUE(frame.ground && near.ground);
  EXPECT_NEAR(*frame.ground, *near.ground, 1e-6);
}

TEST(MakeFrame, TheGroundIsTheFloorAndWallsAreThoseThatPushBack) {
  Scene scene = tank({1, 2, 3});
  const ParticleSet particles = one_of_each({1, 2, 3});
  render::Frame frame =
      render::make_frame(scene, particles, 0, render::make_look(scene, particles, render::ColorBy::material), 1.5);
  EXPECT_EQ(frame.tank.walls, (std::array{true, false, false}));
  ASSERT_TRUE(frame.ground);
  EXPECT_NEAR(*frame.ground + frame.origin.y, 2, 1e-12);
  EXPECT_EQ(frame.up, (Vec3d{0, 1, 0}));
  scene.gravity = {0, 0, 0};  // no weight, no ground
  frame = render::make_frame(scene, particles, 0, render::make_look(scene, particles, render::ColorBy::material), 1.5);
  EXPECT_FALSE(frame.ground);
}

TEST(MakeFrame, NoParticlesIsAPictureToo) {
  const Scene scene = tank();
  for (const render::ColorByName& name : render::kColorByNames) {
    const render::Frame frame = render::make_frame(scene, {}, 0, render::make_look(scene, {}, name.by), 1.5);
    EXPECT_TRUE(frame.spheres.empty());
    EXPECT_TRUE(std::isfinite(frame.camera.eye.x)) << name.name;
  }
}

}  // namespace
}  // namespace hooke
