// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/load_scene.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "hooke/scene/json_reader.h"
#include "minimal_scene.h"
#include "scratch_folder.h"

namespace hooke {
namespace {

// The minimal scene with some of it replaced.
Expected<scene::LoadedScene> load(std::vector<std::string> overrides, const std::filesystem::path& folder = ".") {
  scene::LoadOptions options;
  options.overrides = std::move(overrides);
  return scene::parse_scene(kMinimalScene, "scene.json", folder, options);
}

// The minimal scene with this one source.
scene::LoadedScene with_source(const std::string& source, std::vector<std::string> overrides = {}) {
  overrides.push_back("particles=[" + source + "]");
  auto loaded = load(std::move(overrides));
  if (loaded) return std::move(*loaded);
  ADD_FAILURE() << loaded.error().text();
  return {};
}

TEST(LoadScene, FillsInEveryDefault) {
  const auto loaded = load({});
  ASSERT_TRUE(loaded) << loaded.error().text();
  const scene::Json resolved = scene::Json::parse(loaded->resolved);
  EXPECT_EQ(resolved.at("time").at("integrator"), "symplectic-euler");
  EXPECT_EQ(resolved.at("precision"), "single");
  EXPECT_EQ(resolved.at("domain").at("walls"), "spring");
  EXPECT_EQ(resolved.at("materials").at("water").at("drag"), 0);
  EXPECT_EQ(resolved.at("particles")[0].at("block").at("lattice"), "cubic");
  EXPECT_EQ(resolved.at("output").at("every"), 0.04);
  EXPECT_EQ(loaded->scene.steps, 100);
  EXPECT_EQ(loaded->scene.output.seconds, 0.04);
  EXPECT_EQ(loaded->particles.id, (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(loaded->particles.position, (std::vector<Vec3d>{{1, 1, 1}, {2, 1, 1}}));
}

TEST(LoadScene, AttractsOnlyWhereTheSceneSaysSo) {
  EXPECT_FALSE(load({})->scene.attraction);
  const auto loaded = load({"attraction={}"});
  ASSERT_TRUE(loaded) << loaded.error().text();
  ASSERT_TRUE(loaded->scene.attraction);
  EXPECT_EQ(loaded->scene.attraction->constant, 6.674e-11);
  EXPECT_EQ(loaded->scene.attraction->softening, 0);
  EXPECT_EQ(loaded->scene.attraction->method, Attraction::Method::automatic);
  EXPECT_EQ(loaded->scene.attraction->accuracy, 1e-3);
  EXPECT_TRUE(loaded->scene.attraction->exact);
  const auto other =
      load({"attraction={\"G\":2,\"softening\":0.5,\"method\":\"tree\",\"accuracy\":1e-4,\"exact\":false}"});
  ASSERT_TRUE(other) << other.error().text();
  EXPECT_EQ(other->scene.attraction->constant, 2);
  EXPECT_EQ(other->scene.attraction->softening, 0.5);
  EXPECT_EQ(other->scene.attraction->method, Attraction::Method::tree);
  EXPECT_EQ(other->scene.attraction->accuracy, 1e-4);
  EXPECT_FALSE(other->scene.attraction->exact);
  EXPECT_EQ(load({"attraction.method=direct"})->scene.attraction->method, Attraction::Method::direct);
}

TEST(LoadScene, ReadsEmittersAndSinks) {
  const auto loaded = scene::parse_scene(R"({
  "hooke": 1,
  "time": { "step": 0.01, "end": 1 },
  "domain": { "min": [0, 0, 0], "max": [10, 10, 10] },
  "materials": { "ball": { "radius": 0.5, "mass": 2, "stiffness": 100 },
                 "spark": { "radius": 0.1, "mass": 2, "stiffness": 100, "interacts": false, "look": "spark" } },
  "particles": [],
  "emitters": [
    { "material": "spark", "rate": 20, "shape": { "disc": { "center": [5, 5, 5], "normal": [0, 1, 0], "radius": 1 } } },
    { "name": "jet", "material": "ball", "rate": 20, "shape": { "box": { "min": [1, 1, 1], "max": [2, 2, 2] } },
      "speed": [2, 3], "direction": [1, 0, 0], "spread": 15, "life": [1, 3], "decay": [0.8, 1.2], "start": 0.5, "stop": 10,
      "count": 100000, "respawn": true, "seed": 7, "motion": { "velocity": [0, 1, 0] } } ],
  "sinks": [ { "shape": { "plane": { "point": [0, 1, 0], "normal": [0, 1, 0] } } } ]
})",
                                         "scene.json", ".");
  ASSERT_TRUE(loaded) << loaded.error().text();
  const Scene& scene = loaded->scene;
  EXPECT_TRUE(scene.materials[0].interacts);
  EXPECT_FALSE(scene.materials[1].interacts);
  EXPECT_EQ(scene.materials[1].look, MaterialLook::spark);
  ASSERT_EQ(scene.emitters.size(), 2U);
  const Emitter &plain = scene.emitters[0], &jet = scene.emitters[1];
  EXPECT_EQ(plain.name, "emitter_1");
  EXPECT_EQ(plain.material, 1U);
  EXPECT_EQ(plain.speed.most, 0);
  EXPECT_EQ(plain.direction, (Vec3d{0, 1, 0}));
  EXPECT_FALSE(plain.life || plain.count || plain.respawn);
  EXPECT_EQ(plain.decay.least, 1);
  EXPECT_TRUE(std::isinf(plain.stop));
  EXPECT_EQ(plain.seed, 1U);
  EXPECT_EQ(jet.name, "jet");
  EXPECT_EQ(jet.speed.least, 2);
  EXPECT_EQ(jet.speed.most, 3);
  EXPECT_EQ(jet.direction, (Vec3d{1, 0, 0}));
  EXPECT_EQ(jet.spread, 15);
  ASSERT_TRUE(jet.life);
  EXPECT_EQ(jet.life->most, 3);
  EXPECT_EQ(jet.decay.least, 0.8);
  EXPECT_EQ(jet.start, 0.5);
  EXPECT_EQ(jet.stop, 10);
  EXPECT_EQ(jet.count, 100000U);
  EXPECT_TRUE(jet.respawn);
  EXPECT_EQ(jet.seed, 7U);
  EXPECT_TRUE(std::holds_alternative<SteadyMotion>(jet.motion));
  ASSERT_EQ(scene.sinks.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<PlaneShape>(scene.sinks[0].shape));
}

TEST(LoadScene, RangesOfEmittersMayBeNumbers) {
  const std::string scene = R"({
    "hooke": 1, "time": { "step": 0.01, "end": 1 }, "domain": { "min": [0, 0, 0], "max": [10, 10, 10] },
    "materials": { "water": { "radius": 0.5, "mass": 2, "stiffness": 100 } },
    "emitters": [ { "material": "water", "shape": { "sphere": { "center": [5, 5, 5], "radius": 1 } }, "rate": 10,
                    "speed": 3, "life": 2.5, "decay": 0.5 } ]
  })";
  const auto loaded = scene::parse_scene(scene, "s.json", ".");
  ASSERT_TRUE(loaded) << loaded.error().text();
  EXPECT_TRUE(loaded->particles.empty());
  const Emitter& emitter = loaded->scene.emitters.front();
  EXPECT_EQ(emitter.speed.least, 3);
  EXPECT_EQ(emitter.speed.most, 3);
  EXPECT_EQ(emitter.life->least, 2.5);
  EXPECT_EQ(emitter.life->most, 2.5);
  EXPECT_EQ(emitter.decay.least, 0.5);
  std::string wrong = scene;
  wrong.replace(wrong.find("\"speed\": 3"), 10, "\"speed\": \"3\"");
  const auto refused = scene::parse_scene(wrong, "s.json", ".");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().text(), testing::HasSubstr("must be a number >= 0, or a list of 2 numbers (m/s)"));
}

TEST(LoadScene, NeedsASourceOfParticles) {
  std::string scene = kMinimalScene;
  scene.erase(scene.rfind(",\n  \"particles\""));
  const auto loaded = scene::parse_scene(scene + "}", "s.json", ".");
  ASSERT_FALSE(loaded);
  EXPECT_THAT(loaded.error().text(),
              testing::HasSubstr("needs \"particles\" or \"emitters\" or \"cloths\" or \"bodies\"; none is given"));
}

TEST(LoadScene, EndsWithTheFirstStepAtOrAfterTheEnd) {
  EXPECT_EQ(load({"time.step=0.005", "time.end=10"})->scene.steps, 2000);
  EXPECT_EQ(load({"time.step=0.1", "time.end=0.3"})->scene.steps, 3);
  EXPECT_EQ(load({"time.step=0.1", "time.end=0.31"})->scene.steps, 4);
  EXPECT_EQ(load({"time.end=0"})->scene.steps, 0);
  EXPECT_EQ(load({"time.step=1e-5", "time.end=1e4"})->scene.steps, 1000000000);
  EXPECT_EQ(load({"time.steps=1e6"})->scene.steps, 1000000);
}

TEST(LoadScene, ReadsSurfacesOfMaterialsAndOfPairs) {
  using S = SurfaceCoefficients<double>;
  const auto loaded =
      load({"materials.water.friction=0.5", "materials.water.cohesion={\"range\":0.25,\"strength\":5}",
            "materials.oil={\"radius\":1,\"mass\":1,\"stiffness\":300,\"tension\":false,\"friction\":0.75}",
            "contacts=[{\"between\":[\"water\",\"oil\"],\"tension\":true},{\"between\":[\"wall\",\"water\"],"
            "\"friction\":0}]"});
  ASSERT_TRUE(loaded) << loaded.error().text();
  const Scene& scene = loaded->scene;
  const auto of = [&](const char* name) {
    return std::find_if(scene.materials.begin(), scene.materials.end(),
                        [&](const Material& m) { return m.name == name; })
        ->surface;
  };
  EXPECT_EQ(of("water"), (S{0.5, INFINITY, 5, 0.25}));
  EXPECT_EQ(of("oil"), (S{0.75, 0, 0, 0}));
  EXPECT_EQ(scene.contacts[0].surface, (S{0.5, INFINITY, 0, 0})) << "the weaker, but for what the entry says";
  EXPECT_EQ(scene.contacts[1].surface, (S{0, INFINITY, 5, 0.25}));
}

TEST(LoadScene, ContactsTakeTheMixedValueWhereTheyNameNone) {
  const auto loaded =
      load({"materials.oil={\"radius\":1,\"mass\":1,\"stiffness\":300,\"damping\":4}",
            "contacts=[{\"between\":[\"water\",\"oil\"],\"shear\":7},{\"between\":[\"wall\",\"oil\"]}]"});
  ASSERT_TRUE(loaded) << loaded.error().text();
  EXPECT_EQ(loaded->scene.contacts[0].coefficients, (ContactCoefficients<double>{150, 7, 2}));
  EXPECT_EQ(loaded->scene.contacts[1].coefficients, (ContactCoefficients<double>{300, 0, 4}));
  EXPECT_EQ(loaded->scene.contacts[1].a, 1U);
  EXPECT_EQ(loaded->scene.contacts[1].b, ContactEntry::kWall);
  EXPECT_EQ(scene::Json::parse(loaded->resolved).at("contacts")[0].at("stiffness"), 150);
}

TEST(LoadScene, CountFillsWholeLayersFromTheLowest) {
  const auto loaded = with_source(R"({"material":"water","velocity":[1,2,3],
                                      "block":{"min":[0.5,0.5,0.5],"count":250,"spacing":1}})");
  const ParticleSet& p = loaded.particles;
  ASSERT_EQ(p.size(), 250U);
  // Ten by ten in a layer: from min up to one radius from the far faces.
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_EQ(p.position[i].y, 0.5 + static_cast<double>(i / 100));
  for (const Vec3d& x : p.position) EXPECT_LE(std::max(x.x, x.z), 9.5);
  EXPECT_EQ(p.velocity[249], (Vec3d{1, 2, 3}));
}

TEST(LoadScene, CountLeavesASpacingAcrossPeriodicFaces) {
  const auto loaded = with_source(R"({"material":"water","block":{"min":[0,0.5,0],"count":100,"spacing":1}})",
                                  {"domain.walls=[\"periodic\",\"spring\",\"periodic\"]"});
  for (const Vec3d& x : loaded.particles.position) EXPECT_EQ(x.y, 0.5);
  EXPECT_EQ(loaded.particles.size(), 100U);
}

TEST(LoadScene, JitterIsBoundedAndOfItsSeed) {
  const auto source = [](int seed) {
    return R"({"material":"water","block":{"min":[1,1,1],"max":[8,8,8],"spacing":1,"jitter":0.1,"seed":)" +
           std::to_string(seed) + "}}";
  };
  const auto one = with_source(source(1)).particles.position;
  EXPECT_EQ(one, with_source(source(1)).particles.position);
  EXPECT_NE(one, with_source(source(2)).particles.position);
  const auto plain = with_source(R"({"material":"water","block":{"min":[1,1,1],"max":[8,8,8],"spacing":1}})");
  double largest = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const Vec3d d = one[i] - plain.particles.position[i];
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(component(d, axis)));
  }
  EXPECT_LE(largest, 0.1 + 1e-12);
  EXPECT_GT(largest, 0.09);
  // The same on every machine.
  EXPECT_EQ(one[0], (Vec3d{1.0780518345534802, 1.0789369432255627, 1.0171451896429062}));
}

TEST(LoadScene, JitterWrapsAcrossPeriodicFaces) {
  const auto loaded =
      with_source(R"({"material":"water","block":{"min":[0,0,0],"max":[9,9,9],"spacing":1,"jitter":0.1}})",
                  {"domain.walls=periodic"});
  EXPECT_EQ(loaded.particles.size(), 1000U);
  const auto wrapped = std::count_if(loaded.particles.position.begin(), loaded.particles.position.end(),
                                     [](const Vec3d& x) { return x.x > 9.8; });
  EXPECT_NEAR(static_cast<double>(wrapped), 50, 30);
}

TEST(LoadScene, RandomBlocksTakeMaxAndCount) {
  const auto loaded = with_source(R"({"material":"water","block":{"min":[1,1,1],"max":[9,9,9],"spacing":1,
                                      "lattice":"random","count":120,"jitter":0.5}})");
  EXPECT_EQ(loaded.particles.size(), 120U);
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_EQ(loaded.warnings[0].where, "particles[0].block.jitter");
  EXPECT_EQ(with_source(R"({"material":"water","block":{"min":[1,1,1],"spacing":1,"lattice":"random","count":50}})")
                .particles.size(),
            50U);
}

TEST(LoadScene, RandomBlocksKeepApartAcrossPeriodicFaces) {
  const auto loaded = with_source(R"({"material":"water","block":{"min":[0,0,0],"max":[10,10,10],"spacing":1,
                                      "lattice":"random"}})",
                                  {"domain.walls=periodic"});
  const auto& x = loaded.particles.position;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      Vec3d d = x[i] - x[j];
      for (int axis = 0; axis < 3; ++axis) component(d, axis) -= 10 * std::round(component(d, axis) / 10);
      ASSERT_GE(dot(d, d), 1 - 1e-12);
    }
  }
  EXPECT_GT(x.size(), 500U);
}

TEST(LoadScene, SourcesWithoutIdsNumberOn) {
  const ScratchFolder folder;
  folder.write("a.csv", "x,y,z,id,material\n5,5,5,40,water\n6,6,6,7,water\n");
  const auto loaded = load({"particles[1]={\"file\":\"a.csv\"}", "particles[2].material=water",
                            "particles[2].block={\"min\":[8,8,8],\"max\":[8,8,9],\"spacing\":1}"},
                           folder.path());
  ASSERT_TRUE(loaded) << loaded.error().text();
  EXPECT_EQ(loaded->particles.id, (std::vector<std::uint64_t>{1, 2, 7, 40, 41, 42}));
  EXPECT_EQ(loaded->particles.position[2], (Vec3d{6, 6, 6}));
  EXPECT_EQ(loaded->particles.position[5], (Vec3d{8, 8, 9}));
}

TEST(LoadScene, WithoutParticlesNothingIsRead) {
  scene::LoadOptions options;
  options.with_particles = false;
  options.overrides = {"particles[0]={\"material\":\"water\",\"file\":\"not-there.csv\"}",
                       "particles[1]={\"material\":\"wine\",\"file\":\"not-there.csv\"}"};
  const auto refused = scene::parse_scene(kMinimalScene, "scene.json", "/nowhere", options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().findings.size(), 1U);
  options.overrides.pop_back();
  const auto loaded = scene::parse_scene(kMinimalScene, "scene.json", "/nowhere", options);
  ASSERT_TRUE(loaded) << loaded.error().text();
  EXPECT_TRUE(loaded->particles.empty());
}

TEST(LoadScene, ASceneMayHaveNoParticles) {
  const auto loaded = load({"particles=[]"});
  ASSERT_TRUE(loaded) << loaded.error().text();
  EXPECT_TRUE(loaded->particles.empty());
}

TEST(LoadScene, LoadsTheSameFromTheCurrentFolder) {
  const ScratchFolder folder;
  const auto file = folder.write("scene.json", kMinimalScene);
  const auto loaded = scene::load_scene(file);
  ASSERT_TRUE(loaded) << loaded.error().text();
  EXPECT_EQ(loaded->particles.size(), 2U);
}

TEST(LoadScene, NamesAFileThatCannotBeRead) {
  const auto missing = scene::load_scene("/nowhere/scene.json");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().text(), "/nowhere/scene.json: can't be opened: No such file or directory");
  const auto folder = scene::load_scene("/tmp");
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().text(), "/tmp: can't be read: it is a folder");
}

TEST(LoadScene, ReadsThousandsOfSourcesQuickly) {
  std::string sources = "particles=[";
  for (int i = 0; i < 5000; ++i) {
    sources += std::string(i ? "," : "") + R"({"material":"water","block":{"min":[1,1,1],"max":[1,1,1],"spacing":1}})";
  }
  const auto loaded = load({sources + "]"});
  ASSERT_TRUE(loaded) << loaded.error().text();
  EXPECT_EQ(loaded->particles.size(), 5000U);
}

}  // namespace
}  // namespace hooke
