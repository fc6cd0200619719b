// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Against brute force: every pixel's ray against every sphere, in double precision.

#include "hooke/render/visible_spheres.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "hooke/base/random.h"
#include "hooke/base/threads.h"

namespace hooke {
namespace {

constexpr int kWidth = 93, kHeight = 53;

std::vector<render::Sphere> random_spheres(std::size_t count, const Vec3d& half_size, double smallest, double largest,
                                           std::uint64_t seed) {
  std::vector<render::Sphere> spheres;
  for (std::size_t i = 0; i < count; ++i) {
    const auto u = uniform4(seed, i, 0);
    const Vec3f at = vec_cast<float>(
        Vec3d{half_size.x * (2 * u[0] - 1), half_size.y * (2 * u[1] - 1), half_size.z * (2 * u[2] - 1)});
    const double radius = smallest * std::pow(largest / smallest, u[3]);
    spheres.push_back({at.x, at.y, at.z, static_cast<float>(radius), {}, 0});
  }
  return spheres;
}

Vec3d across(double x, double y, const render::Projection& view) {
  return x * vec_cast<double>(view.right) + y * vec_cast<double>(view.up);
}

// The spheres seen at the centre of any pixel. A sphere shows only its outside, from the projection's nearest depth on.
std::set<std::uint32_t> owners(const std::vector<render::Sphere>& spheres, const render::Projection& view) {
  std::set<std::uint32_t> all;
  const Vec3d ahead = -1.0 * vec_cast<double>(view.back);
  for (int row = 0; row < static_cast<int>(view.height); ++row) {
    for (int column = 0; column < static_cast<int>(view.width); ++column) {
      const Vec3d shift =
          across((column + 0.5 - 0.5 * static_cast<double>(view.width)) / static_cast<double>(view.scale),
                 (row + 0.5 - 0.5 * static_cast<double>(view.height)) / static_cast<double>(view.scale), view);
      const Vec3d from = vec_cast<double>(view.eye) + (view.parallel ? shift : Vec3d{0, 0, 0});
      const Vec3d ray = view.parallel ? ahead : ahead + shift;
      double nearest = std::numeric_limits<double>::infinity();
      std::uint32_t owner = 0;
      const double a = dot(ray, ray);
      for (std::uint32_t i = 0; i < spheres.size(); ++i) {
        const render::Sphere& s = spheres[i];
        const Vec3d to = Vec3d{s.x, s.y, s.z} - from;
        const double radius = static_cast<double>(s.radius), b = dot(ray, to);
        const double discriminant = b * b - a * (dot(to, to) - radius * radius);
        if (discriminant < 0) continue;
        const double depth = (b - std::sqrt(discriminant)) / a;
        if (depth < static_cast<double>(view.nearest) || depth >= nearest) continue;
        nearest = depth;
        owner = i;
      }
      if (nearest < std::numeric_limits<double>::infinity()) all.insert(owner);
    }
  }
  return all;
}

struct Case {
  std::string name;
  std::vector<render::Sphere> spheres;
  render::Camera camera;
  bool parallel = false;

  render::Projection view() const {
    render::Projection view = render::project(camera, kWidth, kHeight);
    if (!parallel) return view;
    view.parallel = true;
    view.nearest = 0;
    view.scale = kHeight / 3.0f;
    return view;
  }
};

render::Camera looking(const Vec3d& eye, double field_of_view) {
  return {eye, {0.1, -0.2, 0.05}, {0, 1, 0}, field_of_view};
}

std::vector<Case> cases() {
  const Vec3d cube{1, 1, 1};
  std::vector<Case> all;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto add = [&](const char* name, std::vector<render::Sphere> spheres, const render::Camera& camera,
                         bool parallel = false) {
      all.push_back({name + (", seed " + std::to_string(seed)), std::move(spheres), camera, parallel});
    };
    const auto equal = random_spheres(4000, cube, 0.06, 0.06, seed);
    const auto mixed = random_spheres(4000, cube, 0.02, 0.4, seed);
    add("equal balls from outside", equal, looking({2, 1.5, 4}, 35));
    add("radii 1 to 20", mixed, looking({2, 1.5, 4}, 35));
    add("smaller than a pixel", random_spheres(8000, cube, 0.001, 0.02, seed), looking({2, 1.5, 4}, 35));
    add("in the midst of them", equal, looking({0.9, 0.3, 0.2}, 100));
    add("inside of large ones", mixed, looking({0.3, 0.2, 0.6}, 100));
    add("very wide", equal, looking({0.5, 0.7, 1.2}, 150));
    add("close and wide", random_spheres(2000, {3, 2, 0.3}, 0.05, 0.3, seed), looking({0, 0, 0.9}, 100));
    add("large and wide", random_spheres(300, {6, 4, 1}, 0.3, 1.2, seed), looking({0, 0, 1.9}, 100));
    add("most of them outside of the picture", random_spheres(4000, {8, 8, 8}, 0.2, 0.4, seed), looking({0, 0, 3}, 20));
    add("all behind", random_spheres(500, {1, 1, 1}, 0.1, 0.2, seed), {{0, 0, 3}, {0, 0, 6}, {0, 1, 0}, 60});
    add("parallel", mixed, looking({2, 1.5, 4}, 35), true);
    add("parallel, the eye among them", equal, looking({0.2, 0.1, 0.3}, 35), true);
  }
  return all;
}

TEST(VisibleSpheres, NoneIsMissed) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const auto visible = render::visible_spheres(c.spheres, c.view());
    const auto owning = owners(c.spheres, c.view());
    EXPECT_EQ(owning.empty(), c.name.starts_with("all behind"));
    EXPECT_TRUE(std::is_sorted(visible.begin(), visible.end()));
    EXPECT_EQ(std::set(visible.begin(), visible.end()).size(), visible.size());
    std::vector<std::uint32_t> missed;
    std::set_difference(owning.begin(), owning.end(), visible.begin(), visible.end(), std::back_inserter(missed));
    EXPECT_EQ(missed.size(), 0u) << "of " << owning.size() << " that own a pixel; the first is " << missed.front();
    RecordProperty(c.name, std::to_string(owning.size()) + " own pixels, " + std::to_string(visible.size()) + " kept");
  }
}

TEST(VisibleSpheres, AHiddenSphereIsLeftOut) {
  const render::Camera camera{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 35};
  const render::Sphere front{0, 0, 0, 1, {}, 0}, hidden{0.2f, 0.1f, -3, 0.5f, {}, 0}, beside{2, 0, -3, 0.5f, {}, 0},
      before{0, 0, 3, 0.1f, {}, 0}, outside{9, 0, 0, 1, {}, 0}, behind{0, 0, 12, 1, {}, 0};
  const std::vector spheres{hidden, front, outside, beside, before, behind};
  EXPECT_EQ(render::visible_spheres(spheres, render::project(camera, kWidth, kHeight)),
            (std::vector<std::uint32_t>{1, 3, 4}));
}

TEST(VisibleSpheres, NothingHidesWhatReachesBeforeIt) {
  // A small ball that sticks out of the front of a large one.
  const render::Camera camera{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 35};
  const std::vector<render::Sphere> spheres{{0, 0, 0, 1, {}, 0}, {0, 0, 0.95f, 0.2f, {}, 0}};
  EXPECT_EQ(render::visible_spheres(spheres, render::project(camera, kWidth, kHeight)).size(), 2u);
}

TEST(VisibleSpheres, OfNoneNone) {
  EXPECT_TRUE(render::visible_spheres({}, render::project(render::Camera{}, kWidth, kHeight)).empty());
}

// 100,000 balls on a slightly jittered cubic lattice, a box of 50 x 40 x 50.
std::vector<render::Sphere> dense_pile() {
  std::vector<render::Sphere> pile;
  for (std::size_t i = 0; i < 100'000; ++i) {
    const auto u = uniform4(5, i, 0);
    const auto at = [&](std::size_t k, double random, double half) {
      return static_cast<float>(static_cast<double>(k) - half + 0.1 * (random - 0.5));
    };
    pile.push_back({at(i % 50, u[0], 24.5), at(i / 2500, u[1], 19.5), at(i / 50 % 50, u[2], 24.5), 0.5f, {}, 0});
  }
  return pile;
}

TEST(VisibleSpheres, OfADensePileFewAreKept) {
  const auto pile = dense_pile();
  const render::Camera camera{{40, 45, 90}, {0, 0, 0}, {0, 1, 0}, 35};
  const auto visible = render::visible_spheres(pile, render::project(camera, 1280, 720));
  EXPECT_LT(visible.size(), pile.size() * 15 / 100);
  EXPECT_GT(visible.size(), 50u * 50u);  // at least the upper side
}

TEST(VisibleSpheres, AnyNumberOfThreadsGivesTheSame) {
  const auto pile = dense_pile();
  const render::Projection view = render::project({{40, 45, 90}, {0, 0, 0}, {0, 1, 0}, 35}, 640, 360);
  const auto expected = render::visible_spheres(pile, view);
  for (const int threads : {1, 2, 3, 8}) {
    Threads(threads).run([&] { EXPECT_EQ(render::visible_spheres(pile, view), expected) << threads << " threads"; });
  }
}

TEST(Project, PutsTheTargetInTheMiddleAndTheFieldOfViewFromBottomToTop) {
  const render::Camera camera{{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 60};
  const render::Projection view = render::project(camera, 1280, 720);
  EXPECT_EQ(view.width, 1280);
  EXPECT_EQ(view.height, 720);
  EXPECT_FALSE(view.parallel);
  // Pixels a metre at a depth of 1 m, where half the picture is tan 30 degrees.
  EXPECT_NEAR(view.scale, 360 / std::tan(std::numbers::pi / 6), 1e-3);
  EXPECT_FLOAT_EQ(view.nearest, 4e-3f);
  EXPECT_FLOAT_EQ(view.back.z, 1);
  EXPECT_FLOAT_EQ(view.right.x, 1);
  EXPECT_FLOAT_EQ(view.up.y, 1);
}

}  // namespace
}  // namespace hooke
