// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
//
// A broken precondition is reported where it is broken: one test for each kind of precondition that headers state.

#include <gtest/gtest.h>

#include <cmath>

#include "hooke/core/attraction.h"
#include "hooke/core/births.h"
#include "hooke/core/colliders.h"
#include "hooke/core/contacts.h"
#include "hooke/core/emission.h"
#include "hooke/core/free_space.h"
#include "hooke/core/materials.h"
#include "hooke/core/placed_colliders.h"
#include "hooke/core/placed_fields.h"
#include "hooke/core/ranks.h"
#include "hooke/core/simulation.h"
#include "hooke/core/springs.h"
#include "hooke/core/sums.h"
#include "hooke/core/torn_edges.h"
#include "support/assertions.h"
#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

TEST(CorePreconditions, SetsOfParticlesFitTheirScene) {
  const Scene scene = open_scene();
  ParticleSet particles = pair_on_x(scene, 0.1, {0, 0, 0}, {0, 0, 0});
  EXPECT_TRUE(are_particles_of(particles, scene));
  std::swap(particles.id[0], particles.id[1]);
  EXPECT_ASSERTS((void)find_contacts(scene, particles), "are_particles_of");
  particles.sort_by_id();
  particles.material[1] = 7;
  EXPECT_ASSERTS((void)contact_figures(scene, particles), "are_particles_of");
  particles.material.pop_back();
  EXPECT_ASSERTS((void)count_overlaps(scene, particles), "are_particles_of");
  EXPECT_ASSERTS(particles.sort_by_id(), "id.size() = 2, material.size() = 1");
}

TEST(CorePreconditions, SetsAreSearchedInOrder) {
  ParticleSet particles;
  particles.id = {5, 3};
  EXPECT_ASSERTS((void)particles.find(3), "id.front() = 5, id.back() = 3");
  EXPECT_ASSERTS((void)check_ids(Structure{}, particles), "is_ascending(particles.id)");
}

TEST(CorePreconditions, BrokenSpringsAscend) {
  const std::vector<std::uint64_t> broken{2, 1};
  EXPECT_ASSERTS((void)find_contacts(open_scene(), {}, {0, broken}), "is_ascending(now.broken_springs)");
}

TEST(CorePreconditions, CoefficientsAreInRange) {
  Attraction attraction;
  attraction.accuracy = 0.5;
  EXPECT_ASSERTS((void)attracts_by_tree(attraction, 10), "attraction.accuracy = 0.5");
  EXPECT_ASSERTS((void)OutputCadence{}.is_due(1, 0), "step = 1, dt = 0");
  EXPECT_ASSERTS((void)OutputCadence{}.is_due(-1, 1), "step = -1, dt = 1");
}

TEST(CorePreconditions, ShapesAreValid) {
  EXPECT_ASSERTS((void)geometry_of(SphereShape{{0, 0, 0}, 0}, false, {0, 0, 0}), "s.radius = 0");
  EXPECT_ASSERTS((void)geometry_of(PlaneShape{{0, 0, 0}, {0, 0, 0}}, false, {0, 0, 0}), "along = (0, 0, 0)");
  EXPECT_ASSERTS((void)geometry_of(BoxShape{{0, 0, 0}, {1, 0, 1}}, false, {0, 0, 0}), "s.max = (1, 0, 1)");
  EXPECT_ASSERTS((void)geometry_of(CapsuleShape{{0, 0, 0}, {0, 0, 0}, 1}, false, {0, 0, 0}), "along = (0, 0, 0)");
  EXPECT_ASSERTS((void)bounds_of(DiscShape{{0, 0, 0}, {0, 1, 0}, -1}), "radius = -1");
  EXPECT_ASSERTS((void)middle_of(MeshShape{}), "s.field != nullptr");
}

TEST(CorePreconditions, MotionsAreValid) {
  Collider collider{"door", BoxShape{}, false, {}, KeyframeMotion{}};
  EXPECT_ASSERTS((void)pose_at(collider, 0), "m.keyframes.size() = 0");
  collider.motion = KeyframeMotion{{{1, {}, {}}, {1, {}, {}}}, {}};
  EXPECT_ASSERTS((void)pose_at(collider, 0), "m.keyframes.size() = 2");
  collider.motion = Oscillation{{1, 0, 0}, -1, 0};
  EXPECT_ASSERTS((void)pose_at(collider, 0), "m.frequency = -1");
  EXPECT_ASSERTS((void)pose_at(collider, NAN), "collider.name = \"door\", time = nan");
}

TEST(CorePreconditions, EachColliderHasAPose) {
  Scene scene = open_scene();
  scene.colliders.push_back({"door", BoxShape{}, false, {}, NoMotion{}});
  EXPECT_ASSERTS((void)place_colliders<double>(scene, {}, 1), "poses.size() = 0, scene.colliders.size() = 1");
  EXPECT_ASSERTS((void)place_collider<double>(scene.colliders[0], {}, -1), "collider.name = \"door\", reach = -1");
}

TEST(CorePreconditions, FieldsAreValid) {
  const Scene scene = open_scene();
  Field field;
  field.materials = {9};
  EXPECT_ASSERTS(PlacedField<double>(scene, field, 0), "m = 9, chosen.size() = 1");
  field = {};
  field.law = Wind{{0, 0, 0}, {}, 0, Gust{{1, 0, 0}, 1, 5}};
  EXPECT_ASSERTS(PlacedField<double>(scene, field, 0), "wind.gust->wavelength = 5");
}

TEST(CorePreconditions, EmittersAreValid) {
  Emitter emitter;
  emitter.name = "spout";
  emitter.direction = {0, 0, 0};
  EXPECT_ASSERTS((void)place_emitter(emitter, 0, 0, 0), "emitter.name = \"spout\", emitter.direction = (0, 0, 0)");
  EXPECT_ASSERTS((void)draw_position(PlacedEmitter{}, 0, 0), "emitter.emitter != nullptr");
  EXPECT_ASSERTS((void)draw_lifetime(emitter, 0, 0, 0), "dt = 0");
  emitter.life = Range{0, 1};
  EXPECT_ASSERTS((void)draw_lifetime(emitter, 0, 0, 1), "emitter.life->least = 0");
}

TEST(CorePreconditions, EmissionKnowsItsScene) {
  Scene scene = open_scene();
  scene.emitters.emplace_back();
  const auto backend = make_backend(kReference);
  Emission emission;
  Ranks alone;
  std::uint64_t next_id = 1;
  EXPECT_ASSERTS((void)emission.end_lives(0), "step = 0");
  EXPECT_ASSERTS((void)emission.give_birth(scene, 1, {}, {}, *backend, alone, next_id),
                 "emitters_.size() = 0, scene.emitters.size() = 1");
  EXPECT_ASSERTS(emission.restore({{}, {{9, 1, 0}, {5, 2, 0}}}), "state.mortals.size() = 2");
}

TEST(CorePreconditions, MaterialsAreTheScenes) {
  const ContactTable table(open_scene().materials, {});
  EXPECT_ASSERTS((void)table.pair(0, 1), "a = 0, b = 1, material_count() = 1");
  EXPECT_ASSERTS((void)table.wall(3), "a = 3, material_count() = 1");
  const ContactEntry entry{0, 4, {}};
  EXPECT_ASSERTS(ContactTable(open_scene().materials, std::span(&entry, 1)), "entry.b = 4, n = 1");
  Scene scene = open_scene();
  scene.materials[0].radius = scene.materials[0].mass = 0;
  scene.materials[0].name = "steel";
  EXPECT_ASSERTS(FreeSpace(scene, 0, {}), "scene.materials[material].name = \"steel\"");
}

TEST(CorePreconditions, SpringsAreOfTheSet) {
  EXPECT_ASSERTS((void)SpringSet{}[2], "i = 2, size() = 0");
  EXPECT_ASSERTS((void)TornEdges(open_scene()), "scene.structure != nullptr");
}

TEST(CorePreconditions, CausesHaveAnEntry) {
  AppliedSums applied;
  EXPECT_ASSERTS((void)applied[Cause::gravity], "cause = 7");
  ByCause<double, kPassCauses> pass;
  EXPECT_ASSERTS((void)pass[Cause::springs], "cause = 9, kCount = 8");
}

TEST(CorePreconditions, SumsAreOfSteps) {
  Scene still;
  still.time_step = 0;
  LedgerSums ledger;
  EXPECT_ASSERTS(ledger.book_step({}, still), "next_kick = 0");
  AppliedSums applied;
  EXPECT_ASSERTS(applied.add_pinned(0, {0, 0, 0}, {0, 0, 0}, 1), "mass = 0, seconds = 1");
  ColliderLoadSums loads;
  loads.add_contact(2, {0, 0, 0}, {1, 0, 0});
  EXPECT_ASSERTS((void)loads.result(2), "loads_.rbegin()->first = 2, count = 2");
}

// Bad contents of a checkpoint are a user's error, not a programmer's.
TEST(CorePreconditions, SavedSpringsThatDoNotAscendAreAnError) {
  Scene scene = open_scene();
  auto structure = std::make_shared<Structure>();
  structure->springs.push_back({.a = 1, .b = 2});
  scene.structure = structure;
  const Simulation simulation = simulate(scene, pair_on_x(scene, -0.1, {0, 0, 0}, {0, 0, 0}), kReference);
  SimulationState state = simulation.state();
  state.broken_springs = {7, 0};
  const auto resumed = Simulation::resume(scene, state, make_backend(kReference));
  ASSERT_FALSE(resumed);
  EXPECT_NE(resumed.error().text().find("unique and ascending"), std::string::npos) << resumed.error().text();
}

}  // namespace
}  // namespace hooke::test
