// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/core/contacts.h"
#include "hooke/base/threads.h"

#include <gtest/gtest.h>
#include <cmath>
#include <numbers>
#include <ostream>
#include <tuple>

#include "hooke/physics/contact.h"
#include "support/engines.h"
#include "support/particles.h"

namespace hooke {
namespace {

using test::add;

double volume(double radius) { return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }

// All contacts by the law, from a search through all pairs and all images, without any short cuts.
std::vector<Contact> all_pairs(const Scene& scene, const ParticleSet& p, ContactFigures& figures) {
  const ContactTable table(scene.materials, scene.contacts);
  const auto radius = [&](std::size_t i) { return scene.materials[p.material[i]].radius; };
  std::vector<Contact> found;
  figures.count.assign(p.size(), 0);
  figures.pressure.assign(p.size(), 0);
  const auto press = [&](std::size_t i, double force) {
    ++figures.count[i];
    figures.pressure[i] += radius(i) * force / (3 * volume(radius(i)));
  };
  int images[3];
  for (int axis = 0; axis < 3; ++axis) {
    const bool periodic = scene.domain.boundary[static_cast<std::size_t>(axis)] == Boundary::periodic;
    images[axis] = periodic ? static_cast<int>(3 / scene.domain.length(axis)) + 1 : 0;  // 3 m: more than two diameters
  }
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t k = i; k < p.size(); ++k) {
      for (int sx = -images[0]; sx <= images[0]; ++sx) {
        for (int sy = -images[1]; sy <= images[1]; ++sy) {
          for (int sz = -images[2]; sz <= images[2]; ++sz) {
            if (i == k && std::tuple(sx, sy, sz) <= std::tuple(0, 0, 0)) continue;
            const Vec3d shift{sx * scene.domain.length(0), sy * scene.domain.length(1), sz * scene.domain.length(2)};
            const Vec3d d = p.position[i] - p.position[k] - shift;
            const double distance = std::sqrt(dot(d, d));
            const double overlap = radius(i) + radius(k) - distance;
            if (overlap <= 0) continue;
            const Vec3d normal = distance == 0 ? Vec3d{-1, 0, 0} : (1 / distance) * d;
            const Vec3d force =
                contact_forces(overlap, normal, p.velocity[k] - p.velocity[i], table.pair(p.material[i], p.material[k]))
                    .total();
            found.push_back({static_cast<std::uint32_t>(i),
                             static_cast<std::uint32_t>(k),
                             Face::none,
                             {sx, sy, sz},
                             overlap,
                             force});
            press(i, dot(force, normal));
            press(k, dot(force, normal));
          }
        }
      }
    }
    const Face lower[] = {Face::x_min, Face::y_min, Face::z_min};
    const Face upper[] = {Face::x_max, Face::y_max, Face::z_max};
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (scene.domain.boundary[a] != Boundary::spring) continue;
      for (const bool is_lower : {true, false}) {
        const double gap = is_lower ? component(p.position[i], axis) - component(scene.domain.min, axis)
                                    : component(scene.domain.max, axis) - component(p.position[i], axis);
        const double overlap = radius(i) - gap;
        if (overlap <= 0) continue;
        Vec3d normal{0, 0, 0};
        component(normal, axis) = is_lower ? 1 : -1;
        const Vec3d force = contact_forces(overlap, normal, -p.velocity[i], table.wall(p.material[i])).total();
        found.push_back(
            {static_cast<std::uint32_t>(i), Contact::kWall, is_lower ? lower[a] : upper[a], {}, overlap, force});
        press(i, dot(force, normal));
      }
    }
  }
  return found;
}

struct Box {
  const char* name;
  Vec3d size;
  std::array<Boundary, 3> boundary;
};

void PrintTo(const Box& box, std::ostream* os) { *os << box.name; }

constexpr Boundary kSpring = Boundary::spring, kOpen = Boundary::open, kPeriodic = Boundary::periodic;
const Box kBoxes[] = {
    {"walls", {6, 5, 7}, {kSpring, kSpring, kSpring}},
    {"open", {6, 5, 7}, {kOpen, kOpen, kOpen}},
    {"periodic", {6, 5, 7}, {kPeriodic, kPeriodic, kPeriodic}},
    {"periodic_two_cells", {2.5, 9, 8}, {kPeriodic, kSpring, kPeriodic}},
    {"periodic_one_cell", {9, 1.1, 9}, {kSpring, kPeriodic, kOpen}},
    {"periodic_shorter_than_a_radius", {0.3, 25, 25}, {kPeriodic, kPeriodic, kSpring}},
};

class ContactsOfACloud : public testing::TestWithParam<Box> {};

TEST_P(ContactsOfACloud, AreThoseOfAllPairs) {
  Scene scene = test::open_scene();
  test::mix_materials(scene, 0.5);
  scene.domain = {{-1, 2, -3}, Vec3d{-1, 2, -3} + GetParam().size, GetParam().boundary};
  const ParticleSet particles = test::cloud(scene, 300, scene.domain.min, scene.domain.max, 2, 11);

  ContactFigures expected_figures;
  const std::vector<Contact> expected = all_pairs(scene, particles, expected_figures);
  const std::vector<Contact> found = find_contacts(scene, particles);
  ASSERT_GT(expected.size(), 200U);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t n = 0; n < found.size(); ++n) {
    const Contact& f = found[n];
    const Contact& e = expected[n];
    ASSERT_EQ(std::tie(f.a, f.b, f.face, f.image), std::tie(e.a, e.b, e.face, e.image)) << n;
    EXPECT_NEAR(f.overlap, e.overlap, 1e-12);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(component(f.force, axis), component(e.force, axis), 1e-8);
  }

  const ContactFigures figures = contact_figures(scene, particles);
  EXPECT_EQ(figures.count, expected_figures.count);
  ASSERT_EQ(figures.pressure.size(), particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    EXPECT_NEAR(figures.pressure[i], expected_figures.pressure[i], 1e-10 * (1 + std::abs(figures.pressure[i]))) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, ContactsOfACloud, testing::ValuesIn(kBoxes),
                         [](const auto& box) { return box.param.name; });

TEST(Contacts, OfTwoMaterialsFollowTheirOwnCoefficients) {
  Scene scene = test::open_scene();
  Material heavy = scene.materials[0];
  heavy.name = "heavy";
  heavy.radius = 1;
  scene.materials.push_back(heavy);
  scene.contacts.push_back({0, 1, {200, 0, 5}});
  ParticleSet p;
  add(p, {0, 0, 0}, {0, 0, 0}, 0);
  add(p, {0, 1.25, 0}, {0, -2, 0}, 1);  // overlap 1.5 - 1.25, approaching at 2 m/s

  const auto contacts = find_contacts(scene, p);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].a, 0U);
  EXPECT_EQ(contacts[0].b, 1U);
  EXPECT_EQ(contacts[0].overlap, 0.25);
  EXPECT_EQ(contacts[0].force, (Vec3d{0, -60, 0}));  // 200 * 0.25 + 5 * 2, downward on the lower particle

  const auto figures = contact_figures(scene, p);
  EXPECT_EQ(figures.count, (std::vector<std::uint32_t>{1, 1}));
  EXPECT_DOUBLE_EQ(figures.pressure[0], 0.5 * 60 / (3 * volume(0.5)));
  EXPECT_DOUBLE_EQ(figures.pressure[1], 1.0 * 60 / (3 * volume(1)));
}

TEST(Contacts, ThatADashpotHoldsBackPull) {
  const Scene scene = test::open_scene();
  const ParticleSet p = test::pair_on_x(scene, 0.001, {-1, 0, 0}, {1, 0, 0});  // k * overlap = 1 N < c_d * 2 m/s
  EXPECT_LT(contact_figures(scene, p).pressure[0], 0);
}

TEST(Contacts, OfWallsNameTheirFace) {
  Scene scene = test::open_scene();
  scene.domain = {{0, 0, 0}, {4, 4, 4}, {kSpring, kOpen, kSpring}};
  scene.contacts.push_back({0, ContactEntry::kWall, {80, 0, 0}});
  ParticleSet p;
  add(p, {0.25, 0.1, 3.75}, {0, 0, 0});  // overlaps two walls by 0.25; the face below it is open

  const auto contacts = find_contacts(scene, p);
  ASSERT_EQ(contacts.size(), 2U);
  EXPECT_STREQ(to_string(contacts[0].face), "x-min");
  EXPECT_STREQ(to_string(contacts[1].face), "z-max");
  EXPECT_EQ(contacts[0].b, Contact::kWall);
  EXPECT_EQ(contacts[0].force, (Vec3d{20, 0, 0}));
  EXPECT_EQ(contacts[1].force, (Vec3d{0, 0, -20}));
  const auto figures = contact_figures(scene, p);
  EXPECT_EQ(figures.count[0], 2U);
  EXPECT_DOUBLE_EQ(figures.pressure[0], 0.5 * 40 / (3 * volume(0.5)));
}

TEST(Contacts, AtTheSameSpotPushApartAlongX) {
  const Scene scene = test::open_scene();
  ParticleSet p;
  add(p, {1, 1, 1}, {0, 0, 0});
  add(p, {1, 1, 1}, {0, 0, 0});
  const auto contacts = find_contacts(scene, p);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].overlap, 1);
  EXPECT_EQ(contacts[0].force, (Vec3d{-1000, 0, 0}));
}

TEST(Contacts, AcrossAPeriodicFaceNameTheImage) {
  Scene scene = test::open_scene();
  scene.domain = {{0, 0, 0}, {10, 10, 10}, {kPeriodic, kPeriodic, kOpen}};
  ParticleSet p;
  add(p, {0.25, 5, 5}, {0, 0, 0});
  add(p, {9.5, 5, 5}, {0, 0, 0});
  const auto contacts = find_contacts(scene, p);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].image, (std::array<std::int32_t, 3>{-1, 0, 0}));  // b's image is at -0.5
  EXPECT_EQ(contacts[0].overlap, 0.25);
  EXPECT_EQ(contacts[0].force, (Vec3d{250, 0, 0}));
}

TEST(Contacts, OfAParticleWithItselfAreOneContactWithTwoSides) {
  Scene scene = test::open_scene();
  scene.domain = {{0, 0, 0}, {0.75, 10, 10}, {kPeriodic, kOpen, kOpen}};
  ParticleSet p;
  add(p, {0.5, 5, 5}, {0, 0, 0});
  const auto contacts = find_contacts(scene, p);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].b, 0U);
  EXPECT_EQ(contacts[0].image, (std::array<std::int32_t, 3>{1, 0, 0}));
  EXPECT_EQ(contact_figures(scene, p).count[0], 2U);
}

// The forces of listed contacts add up to the colliders' loads in the back end's figures.
TEST(Contacts, WithCollidersAddUpToTheirLoads) {
  Scene scene = test::open_scene();
  scene.gravity = {0, -9.8, 0};
  scene.materials[0].contact.damping = scene.materials[0].contact.shear = 20;
  scene.materials[0].surface.friction = 0.4;
  Collider floor, bowl;
  floor.name = "floor";
  floor.shape = PlaneShape{{0, -2, 0}, {0, 1, 0}};
  bowl.name = "bowl";
  bowl.shape = SphereShape{{0, 0, 0}, 3};
  bowl.hollow = true;
  bowl.motion = SteadyMotion{{0.1, 0, 0}, {0, 1, 0}, {}};
  scene.colliders = {floor, bowl};
  ParticleSet heap = test::lattice(scene, {4, 3, 4}, {-1.4, -1.4, -1.4}, 0.95, 0.05, 3);
  Simulation simulation = test::simulate(scene, heap, test::kReference);
  ASSERT_TRUE(test::advance(simulation, 400));

  const double time = simulation.time();
  const std::vector<Contact> contacts = find_contacts(scene, simulation.particles(), {time, {}});
  const std::vector<ColliderLoad> loads = test::measured(simulation).colliders;
  for (std::uint32_t c = 0; c < 2; ++c) {
    Vec3d sum{0, 0, 0}, torque{0, 0, 0};
    std::uint64_t count = 0;
    for (const Contact& contact : contacts) {
      if (contact.b != Contact::kCollider || contact.collider != c) continue;
      ++count;
      sum += contact.force;
      torque += cross(contact.point - simulation.collider_poses()[c].pivot, contact.force);
      EXPECT_EQ(contact.face, Face::none);
    }
    EXPECT_GT(count, 3U);
    EXPECT_EQ(count, loads[c].contacts);
    for (int axis = 0; axis < 3; ++axis) {  // sums of the same terms
      EXPECT_NEAR(component(sum, axis), -component(loads[c].force, axis), 1e-9);
      EXPECT_NEAR(component(torque, axis), -component(loads[c].torque, axis), 1e-9);
    }
  }
  const ContactFigures figures = contact_figures(scene, simulation.particles(), {time, {}});
  std::uint64_t sides = 0;
  for (const std::uint32_t count : figures.count) sides += count;
  EXPECT_EQ(sides, 2 * test::measured(simulation).contacts + loads[0].contacts + loads[1].contacts);
}

// A tied pair whose spring keeps it from touching is no contact as long as the spring holds.
TEST(Contacts, OfPairsThatASpringKeepsApartAreNone) {
  Scene scene = test::open_scene();
  auto structure = std::make_shared<Structure>();
  ParticleSet p;
  for (int k = 0; k < 4; ++k) add(p, {0.9 * k, 0, 0}, {0, 0, 0});
  for (int k = 0; k < 3; ++k) {
    Spring spring{p.id[static_cast<std::size_t>(k)], p.id[static_cast<std::size_t>(k) + 1]};
    spring.contact = k == 1;
    structure->springs.push_back(spring);
  }
  scene.structure = structure;
  const std::vector<Contact> whole = find_contacts(scene, p);
  ASSERT_EQ(whole.size(), 1U);
  EXPECT_EQ(whole[0].a, 1U);
  EXPECT_EQ(contact_figures(scene, p).count, (std::vector<std::uint32_t>{0, 1, 1, 0}));
  const std::vector<std::uint64_t> broken = {2};
  EXPECT_EQ(find_contacts(scene, p, {0, broken}).size(), 2U);
}

// 5 N at touch, falling to 0 at a gap of 0.2 m: half of it at 0.1 m. The pair is listed and pulls, but does not touch.
TEST(Contacts, ThatCohesionHoldsAcrossAGapAreListed) {
  Scene scene = test::open_scene();
  scene.materials[0].surface.cohesion = 5;
  scene.materials[0].surface.range = 0.2;
  scene.domain = {{0, 0, 0}, {9, 9, 9}, {kSpring, kPeriodic, kPeriodic}};
  Collider ball;
  ball.name = "ball";
  ball.shape = SphereShape{{2, 8.5, 4}, 0.5};
  scene.colliders = {ball};
  ParticleSet p;
  add(p, {0.6, 4, 4}, {0, 0, 0});
  add(p, {1.7, 4, 4}, {0, 0, 0});
  add(p, {2, 7.4, 4}, {0, 0, 0});
  add(p, {5, 4, 4}, {0, 0, 0});
  add(p, {6.21, 4, 4}, {0, 0, 0});  // just out of reach
  const std::vector<Contact> contacts = find_contacts(scene, p);
  ASSERT_EQ(contacts.size(), 3U);
  const Vec3d forces[] = {{2.5, 0, 0}, {-2.5, 0, 0}, {0, 2.5, 0}};
  const std::uint32_t partners[] = {1, Contact::kWall, Contact::kCollider};
  for (std::size_t n = 0; n < 3; ++n) {
    EXPECT_EQ(contacts[n].b, partners[n]);
    EXPECT_NEAR(contacts[n].overlap, -0.1, 1e-12);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(component(contacts[n].force, axis), component(forces[n], axis), 1e-9);
    }
  }
  const ContactFigures figures = contact_figures(scene, p);
  EXPECT_EQ(figures.count, (std::vector<std::uint32_t>(5, 0)));
  EXPECT_NEAR(figures.pressure[1], -0.5 * 2.5 / (3 * volume(0.5)), 1e-9);
}

TEST(Contacts, OfNobodyAreNone) {
  const Scene scene = test::open_scene();
  EXPECT_TRUE(find_contacts(scene, {}).empty());
  EXPECT_TRUE(contact_figures(scene, {}).count.empty());
}

TEST(Contacts, AreTheSameBitsForAnyNumberOfThreads) {
  Scene scene = test::open_scene();
  test::mix_materials(scene, 0.5);
  const ParticleSet particles = test::lattice(scene, {25, 25, 25}, {0, 0, 0}, 0.9, 0.2, 3);
  std::vector<Contact> one_list;
  ContactFigures one;
  Threads(1).run([&] {
    one_list = find_contacts(scene, particles);
    one = contact_figures(scene, particles);
  });
  EXPECT_GT(one_list.size(), particles.size());
  Threads(2).run([&] {
    const auto list = find_contacts(scene, particles);
    ASSERT_EQ(list.size(), one_list.size());
    for (std::size_t n = 0; n < list.size(); ++n) {
      ASSERT_EQ(std::tie(list[n].a, list[n].b, list[n].image),
                std::tie(one_list[n].a, one_list[n].b, one_list[n].image));
      ASSERT_EQ(list[n].force, one_list[n].force);
    }
    const ContactFigures figures = contact_figures(scene, particles);
    EXPECT_EQ(figures.count, one.count);
    EXPECT_EQ(figures.pressure, one.pressure);
  });
}

TEST(Overlaps, AreThoseOfTheContacts) {
  Scene scene = test::open_scene();
  test::mix_materials(scene, 0.4);
  scene.domain = {{0, 0, 0}, {6, 6, 6}, {Boundary::periodic, Boundary::spring, Boundary::open}};
  ParticleSet p;
  for (std::uint64_t i = 0; i < 800; ++i) {
    const auto u = test::random4(8, i);
    add(p, {6 * u[0], 6 * u[1], 6 * u[2]}, {0, 0, 0}, static_cast<std::uint16_t>(i % 3));
  }
  std::uint64_t pairs = 0;
  Overlaps expected;
  for (const Contact& c : find_contacts(scene, p)) {
    if (c.b >= Contact::kCollider || !(c.overlap > 0)) continue;
    ++pairs;
    const double ratio =
        c.overlap / (scene.materials[p.material[c.a]].radius + scene.materials[p.material[c.b]].radius);
    if (ratio > expected.ratio) expected = {0, c.a, c.b, c.overlap, ratio};
  }
  ASSERT_GT(pairs, 500U);
  const Overlaps found = count_overlaps(scene, p);
  EXPECT_EQ(found.pairs, static_cast<double>(pairs));
  EXPECT_EQ(found.a, expected.a);
  EXPECT_EQ(found.b, expected.b);
  EXPECT_EQ(found.overlap, expected.overlap);
  EXPECT_EQ(found.ratio, expected.ratio);
}

// 28 cubed particles a twentieth of a diameter apart: each touches some thousand others. The expected number of pairs
// is counted offset by offset.
TEST(Overlaps, OfACrowdAreEstimated) {
  constexpr int kEdge = 28;
  Scene scene = test::open_scene();
  const double radius = scene.materials[0].radius, spacing = 0.1 * radius;
  ParticleSet p;
  double expected = 0;
  for (int x = 0; x < kEdge; ++x) {
    for (int y = 0; y < kEdge; ++y) {
      for (int z = 0; z < kEdge; ++z) {
        add(p, spacing * Vec3d{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}, {0, 0, 0});
        const int sign = x * x + y * y + z * z == 0 ? 0 : (x > 0 ? 2 : 1) * (y > 0 ? 2 : 1) * (z > 0 ? 2 : 1);
        if (x * x + y * y + z * z < 20 * 20) expected += 0.5 * sign * (kEdge - x) * (kEdge - y) * (kEdge - z);
      }
    }
  }
  p.position[7777] += Vec3d{0.03 * radius, 0, 0};  // towards particle 7777 + 28 * 28
  const Overlaps found = count_overlaps(scene, p);
  // One particle in 25 is sampled; their counts differ by 40 %, depending on how near the surface they are:
  // 0.4 / sqrt(900).
  EXPECT_NEAR(found.pairs, expected, 4 * 0.014 * expected);
  EXPECT_EQ(found.a, 7777U);
  EXPECT_EQ(found.b, 7777U + kEdge * kEdge);
  EXPECT_NEAR(found.overlap, (2 - 0.07) * radius, 1e-12);
  EXPECT_NEAR(found.ratio, 1 - 0.035, 1e-12);
}

}  // namespace
}  // namespace hooke
