// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "hooke/scene/load_scene.h"
#include "source_dir.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

void expect_same(const scene::LoadedScene& a, const scene::LoadedScene& b) {
  EXPECT_EQ(a.resolved, b.resolved);
  EXPECT_EQ(a.particles.id, b.particles.id);
  EXPECT_EQ(a.particles.material, b.particles.material);
  EXPECT_EQ(a.particles.position, b.particles.position);
  EXPECT_EQ(a.particles.velocity, b.particles.velocity);
  EXPECT_EQ(a.scene.steps, b.scene.steps);
  EXPECT_EQ(a.scene.time_step, b.scene.time_step);
}

scene::LoadedScene load_and_reload(const fs::path& file) {
  const auto loaded = scene::load_scene(file);
  if (!loaded) {
    ADD_FAILURE() << file << "\n" << loaded.error().text();
    return {};
  }
  const auto again = scene::parse_scene(loaded->resolved, "resolved", file.parent_path());
  if (again) {
    expect_same(*loaded, *again);
  } else {
    ADD_FAILURE() << file << " as resolved\n" << again.error().text();
  }
  return *loaded;
}

TEST(RealScenes, TheGalleryLoads) {
  const fs::path folder = HOOKE_SOURCE_DIR "/scenes";
  EXPECT_EQ(load_and_reload(folder / "water.json").particles.size(), 512000U);
  EXPECT_EQ(load_and_reload(folder / "table-6.1.json").particles.size(), 512000U);
  EXPECT_EQ(load_and_reload(folder / "ball-pit.json").particles.size(), 4001U);
  EXPECT_EQ(load_and_reload(folder / "galaxy.json").particles.size(), 20000U);
  EXPECT_EQ(load_and_reload(folder / "fireworks.json").scene.emitters.size(), 29U);
  EXPECT_EQ(load_and_reload(folder / "fountain.json").scene.sinks.size(), 1U);
  const scene::LoadedScene mixed = load_and_reload(folder / "mixed.json");
  EXPECT_NEAR(static_cast<double>(mixed.particles.size()), 20000, 2000);
  EXPECT_EQ(mixed.scene.materials.size(), 2U);
}

TEST(RealScenes, TableSixOneIsLiteral) {
  scene::LoadOptions options;
  options.with_particles = false;
  const auto loaded = scene::load_scene(HOOKE_SOURCE_DIR "/scenes/table-6.1.json", options);
  ASSERT_TRUE(loaded) << loaded.error().text();
  const Material& m = loaded->scene.materials.at(0);
  EXPECT_EQ(m.contact.stiffness, 0.4);
  EXPECT_EQ(m.contact.shear, 0.2);
  EXPECT_EQ(m.contact.damping, 0.95);
  EXPECT_EQ(m.mass, 1);
  EXPECT_EQ(loaded->scene.gravity, (Vec3d{0, -9.8, 0}));
  EXPECT_EQ(loaded->scene.time_step, 0.005);
}

// The commented example of the reference page is a scene, and uses every key.
TEST(RealScenes, TheExampleOfTheReferenceLoads) {
  const auto loaded = scene::load_scene(HOOKE_SOURCE_DIR "/schema/example.json");
  ASSERT_TRUE(loaded) << loaded.error().text();
  EXPECT_EQ(loaded->scene.materials.size(), 2U);
  EXPECT_GT(loaded->particles.size(), 0U);
}

TEST(RealScenes, EveryCaseOfTheReferenceSetLoads) {
  const fs::path folder = HOOKE_SOURCE_DIR "/../shared/reference/lammps";
  if (!fs::exists(folder)) GTEST_SKIP() << "no reference set beside the checkout";
  int cases = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!fs::exists(entry.path() / "scene.json")) continue;
    ++cases;
    const scene::LoadedScene loaded = load_and_reload(entry.path() / "scene.json");
    std::ifstream csv(entry.path() / "initial.csv");
    const auto rows = std::count(std::istreambuf_iterator<char>(csv), {}, '\n') - 1;
    EXPECT_EQ(loaded.particles.size(), static_cast<std::size_t>(rows)) << entry.path();
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_EQ(loaded.warnings[0].message, R"(columns that Hooke does not read are ignored: "type", "radius", "mass")");
  }
  EXPECT_GT(cases, 0);
}

}  // namespace
}  // namespace hooke
