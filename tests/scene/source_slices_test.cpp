// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Scenes whose particles are made a slice at a time.

#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

#include "hooke/core/particle_slices.h"
#include "hooke/scene/load_scene.h"
#include "minimal_scene.h"
#include "scratch_folder.h"

namespace hooke {
namespace {

using testing::HasSubstr;

class SourceSlices : public testing::Test {
 protected:
  Expected<scene::LoadedScene> load(const std::vector<std::string>& overrides, bool in_slices) const {
    scene::LoadOptions options = options_;
    options.overrides = overrides;
    options.in_slices = in_slices;
    return scene::parse_scene(kMinimalScene, "scene.json", folder_.path(), options);
  }

  // The slices of the scene with these sources are the whole set, bit by bit, wherever they end.
  void expect_same(const std::string& sources, std::vector<std::string> overrides = {}) const {
    SCOPED_TRACE(sources);
    overrides.push_back("particles=" + sources);
    const auto whole = load(overrides, false);
    const auto sliced = load(overrides, true);
    ASSERT_TRUE(whole) << whole.error().text();
    ASSERT_TRUE(sliced) << sliced.error().text();
    EXPECT_FALSE(whole->slices);
    ASSERT_TRUE(sliced->slices);
    EXPECT_TRUE(sliced->particles.empty());
    const ParticleSet& all = whole->particles;
    EXPECT_GT(all.size(), 20U);
    EXPECT_EQ(sliced->slices->size(), all.size());
    EXPECT_EQ(sliced->slices->identity(), hooke::SlicesOfSet(all).identity());
    EXPECT_FALSE(sliced->slices->has_accelerations());
    EXPECT_EQ(sliced->resolved, whole->resolved);
    ASSERT_EQ(sliced->warnings.size(), whole->warnings.size());
    for (std::size_t k = 0; k < whole->warnings.size(); ++k)
      EXPECT_EQ(sliced->warnings[k].message, whole->warnings[k].message);
    for (const std::size_t rows : {1U, 7U, 64U, 1000U, 100'000U}) {
      SCOPED_TRACE(rows);
      ParticleSet together;
      std::vector<std::size_t> sizes;
      const auto visited = sliced->slices->visit(rows, [&](const ParticleSlice& slice) {
        sizes.push_back(slice.size());
        together.id.insert(together.id.end(), slice.id.begin(), slice.id.end());
        together.material.insert(together.material.end(), slice.material.begin(), slice.material.end());
        together.position.insert(together.position.end(), slice.position.begin(), slice.position.end());
        together.velocity.insert(together.velocity.end(), slice.velocity.begin(), slice.velocity.end());
      });
      ASSERT_TRUE(visited) << visited.error().text();
      ASSERT_EQ(sizes.size(), (all.size() + rows - 1) / rows);
      for (std::size_t k = 0; k + 1 < sizes.size(); ++k) EXPECT_EQ(sizes[k], rows);
      EXPECT_EQ(together.id, all.id);
      EXPECT_EQ(together.material, all.material);
      EXPECT_EQ(together.position, all.position);
      EXPECT_EQ(together.velocity, all.velocity);
    }
  }

  // Findings are those of the whole set.
  void expect_same_refusal(const std::vector<std::string>& overrides, const std::string& part) const {
    SCOPED_TRACE(part);
    const auto whole = load(overrides, false);
    const auto sliced = load(overrides, true);
    ASSERT_FALSE(whole);
    ASSERT_FALSE(sliced);
    EXPECT_EQ(sliced.error().text(), whole.error().text());
    EXPECT_THAT(sliced.error().text(), HasSubstr(part));
  }

  // A CSV file of particles on a line, with ids from `first` on, `step` apart; none where that is 0.
  void write_line(const std::string& name, double z, int count, int first = 1, int step = 0) const {
    std::string text = step == 0 ? "x,y,z,vx,vy,vz\n" : "id,x,y,z,vx,vy,vz\n";
    for (int k = 0; k < count; ++k) {
      if (step != 0) text += std::to_string(first + step * k) + ",";
      text += std::to_string(0.5 + 0.1 * k) + ",5.25," + std::to_string(z) + ",0.25," + std::to_string(k) + ",0\n";
    }
    folder_.write(name, text);
  }

  ScratchFolder folder_;
  scene::LoadOptions options_;
};

constexpr const char* kPeriodic = R"(domain.walls="periodic")";

std::string block(const std::string& keys) {
  return R"({"material":"water","velocity":[1,2,3],"block":{"min":[1,1,1],)" + keys + "}}";
}

TEST_F(SourceSlices, OfLatticesAreTheWholeLattice) {
  for (const std::string lattice : {R"("lattice":"cubic")", R"("lattice":"hcp")"}) {
    const std::string box = lattice + R"(,"max":[7.3,8.1,8.9],"spacing":1)";
    for (const std::string gravity : {"gravity=[0,-9.8,0]", "gravity=[0,0,9.8]", "gravity=[-9.8,0,0]"}) {
      expect_same("[" + block(box) + "]", {gravity});
      expect_same("[" + block(box + R"(,"jitter":0.1,"seed":5)") + "]", {gravity});
      expect_same("[" + block(lattice + R"(,"spacing":1,"count":123,"jitter":0.1)") + "]", {gravity});
    }
    // Jitter wraps around at periodic faces.
    const std::string full =
        R"({"material":"water","block":{"min":[0,0,0],)" + lattice + R"(,"max":[9,9,9],"spacing":1,"jitter":0.3}})";
    expect_same("[" + full + "]", {kPeriodic});
    // Flat, and a single row.
    expect_same("[" + block(lattice + R"(,"max":[8,1,8],"spacing":0.7)") + "]");
    expect_same("[" + block(lattice + R"(,"max":[1,1,8],"spacing":0.2)") + "]");
  }
}

TEST_F(SourceSlices, OfManySourcesFollowEachOther) {
  write_line("a.csv", 9.25, 30);
  const std::string lattice = block(R"("max":[4,4,4],"spacing":1,"jitter":0.05)");
  const std::string other = R"({"material":"oil","block":{"min":[1,6,1],"max":[4,7,4],"spacing":1}})";
  const std::string random =
      R"({"material":"oil","velocity":[0,0,1],"block":{"lattice":"random","min":[6,1,1],"max":[9,4,4],"spacing":0.9,"jitter":0.1}})";
  const std::string cluster =
      R"({"material":"water","velocity":[0,1,0],"cluster":{"center":[5,5,5],"scale":0.1,"count":40}})";
  const std::string file = R"({"material":"water","file":"a.csv"})";
  const std::vector<std::string> scene{R"(materials.oil={"radius":0.2,"mass":3,"stiffness":50})",
                                       R"(attraction={"G":1})"};
  expect_same("[" + random + "]", scene);
  expect_same("[" + cluster + "]", scene);
  expect_same("[" + file + "]", scene);
  expect_same("[" + lattice + "," + random + "," + other + "," + cluster + "," + file + "," + lattice + "]", scene);
  expect_same("[" + file + "," + cluster + "," + file + "," + random + "]", scene);
}

TEST_F(SourceSlices, KeepIdsThatAscend) {
  write_line("a.csv", 9.25, 30, 5, 3);
  write_line("b.csv", 9.75, 30, 93, 1);
  const std::string lattice = block(R"("max":[4,4,4],"spacing":1)");
  const std::string a = R"({"material":"water","file":"a.csv"})", b = R"({"material":"water","file":"b.csv"})";
  expect_same("[" + a + "," + b + "," + lattice + "]");
  // Ids that don't, and springs, which name ids, take the whole set.
  for (const std::vector<std::string>& overrides :
       {std::vector<std::string>{"particles=[" + b + "," + a + "]"},
        std::vector<std::string>{"particles=[" + a + "]",
                                 R"(springs=[{"pairs":[[5,8]],"stiffness":1,"damping":0}])"}}) {
    const auto whole = load(overrides, false);
    const auto sliced = load(overrides, true);
    ASSERT_TRUE(whole) << whole.error().text();
    ASSERT_TRUE(sliced) << sliced.error().text();
    EXPECT_FALSE(sliced->slices);
    EXPECT_GE(sliced->particles.size(), 30U);
    EXPECT_EQ(sliced->particles.id, whole->particles.id);
    EXPECT_EQ(sliced->particles.position, whole->particles.position);
  }
}

TEST_F(SourceSlices, AreRefusedLikeTheWholeSet) {
  write_line("a.csv", 9.25, 30, 5, 3);
  write_line("out.csv", 11, 30);
  folder_.write("bad.csv", "x,y,z\n1,2,3\n1,2\n");
  const std::string a = R"({"material":"water","file":"a.csv"})";
  expect_same_refusal({"particles=[" + block(R"("max":[14,4,4],"spacing":1)") + "]"}, "outside the domain");
  expect_same_refusal({"particles=[" + block(R"("spacing":1,"count":800)") + "]"}, "only 729 centres");
  expect_same_refusal({"particles=[" + a + "," + a + "]"}, "is taken");
  expect_same_refusal({"particles=[" + a + R"(,{"material":"water","file":"out.csv"}])"}, "out.csv:2");
  expect_same_refusal({R"(particles=[{"material":"water","file":"bad.csv"}])"}, "bad.csv:3");
  expect_same_refusal({"particles=[" + a + "]", "domain.min=[-1e9,3,0]", "domain.max=[-1,1,1]"}, "domain");
  options_.memory_limit = 40'000;
  expect_same_refusal({"particles=[" + block(R"("max":[8,8,8],"spacing":1)") + "]"}, "memory");
  options_.memory_limit = 400'000;
  expect_same_refusal({"particles=[" + block(R"("max":[2,2,2],"spacing":0.1)") + "]"}, "overlap in about");
}

// Several machines have more memory than one.
TEST_F(SourceSlices, NeedTheMemoryOfTheirShare) {
  const std::vector<std::string> scene{"particles=[" + block(R"("max":[8,8,8],"spacing":1)") + "]"};
  options_.memory_limit = 80'000;
  EXPECT_FALSE(load(scene, true));
  options_.share_here = 0.25;
  const auto shared = load(scene, true);
  ASSERT_TRUE(shared) << shared.error().text();
  EXPECT_EQ(shared->slices->size(), 512U);
}

// Of two files one is read again at each visit.
TEST_F(SourceSlices, NoticeAFileThatChanges) {
  write_line("a.csv", 9.25, 30);
  write_line("b.csv", 8.25, 30);
  const auto loaded =
      load({R"(particles=[{"material":"water","file":"a.csv"},{"material":"water","file":"b.csv"}])"}, true);
  ASSERT_TRUE(loaded) << loaded.error().text();
  ASSERT_TRUE(loaded->slices);
  std::size_t visited = 0;
  const ParticleSlices::Take count = [&](const ParticleSlice& slice) { visited += slice.size(); };
  ASSERT_TRUE(loaded->slices->visit(7, count));
  EXPECT_EQ(visited, 60U);
  write_line("a.csv", 9.25, 31);
  const auto changed = loaded->slices->visit(7, count);
  ASSERT_FALSE(changed);
  EXPECT_THAT(changed.error().text(), HasSubstr("a.csv: has changed"));
  folder_.write("a.csv", "x,y,z\n1,2\n");
  const auto broken = loaded->slices->visit(7, count);
  ASSERT_FALSE(broken);
  EXPECT_THAT(broken.error().text(), HasSubstr("a.csv:2"));
}

}  // namespace
}  // namespace hooke
