// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/cluster_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hooke {
namespace {

constexpr std::uint64_t kCount = 20'000;
constexpr double kMass = 0.01, kScale = 2, kConstant = 3;

scene::ClusterParticles make(scene::ClusterSource::Profile profile, double companion = 0) {
  scene::ClusterSource cluster;
  cluster.profile = profile;
  cluster.center = {1, -2, 5};
  cluster.scale = kScale;
  cluster.count = kCount;
  cluster.normal = {0, 3, 0};
  cluster.companion = companion;
  Attraction attraction;
  attraction.constant = kConstant;
  scene::ClusterParticles made = scene::make_cluster(cluster, kMass, attraction);
  for (Vec3d& x : made.position) x -= cluster.center;
  return made;
}

// A random quantity of n particles has an error of its spread over sqrt(n): four times that is allowed.
constexpr double kAllowed = 4 / 141.0;

TEST(PlummerCluster, IsInEquilibrium) {
  const scene::ClusterParticles made = make(scene::ClusterSource::Profile::plummer);
  std::vector<double> radius;
  double kinetic = 0;
  Vec3d momentum{0, 0, 0};
  for (std::size_t i = 0; i < kCount; ++i) {
    radius.push_back(std::sqrt(dot(made.position[i], made.position[i])));
    kinetic += 0.5 * kMass * dot(made.velocity[i], made.velocity[i]);
    momentum += kMass * made.velocity[i];
  }
  std::nth_element(radius.begin(), radius.begin() + kCount / 2, radius.end());
  // Half of the mass within ten scales is within 1.29 scales; without the cut it would be within 1.3048.
  EXPECT_NEAR(radius[kCount / 2] / kScale, 1.29, 1.29 * kAllowed);
  EXPECT_LE(*std::max_element(radius.begin(), radius.end()), 10.001 * kScale);
  // The virial theorem: 2 T = -W = 3 pi / 32 G M^2 / scale.
  const double total = kCount * kMass;
  EXPECT_NEAR(2 * kinetic / (3 * 3.14159265 / 32 * kConstant * total * total / kScale), 1, kAllowed);
  EXPECT_LT(std::sqrt(dot(momentum, momentum)), kAllowed * std::sqrt(2 * kinetic * total));
}

TEST(DiscCluster, TurnsOnCircles) {
  const double companion = 100, total = kCount * kMass + companion;
  const scene::ClusterParticles made = make(scene::ClusterSource::Profile::disc, companion);
  std::size_t within = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const Vec3d& x = made.position[i];
    const Vec3d& v = made.velocity[i];
    EXPECT_LE(std::abs(x.y), 0.05 * kScale);
    const double radius = std::sqrt(x.x * x.x + x.z * x.z), ratio = radius / kScale;
    EXPECT_LE(ratio, 6.001);
    if (ratio < std::sqrt(3.0)) ++within;
    EXPECT_NEAR(x.x * v.x + x.z * v.z, 0, 1e-9);
    EXPECT_GE(x.z * v.x - x.x * v.z, 0);  // counterclockwise, seen from above
    const double speed2 = kConstant * total / kScale * ratio * ratio / std::pow(1 + ratio * ratio, 1.5);
    EXPECT_NEAR(dot(v, v), speed2, 1e-9);
  }
  // Kuzmin's disc has 1 - 1 / sqrt(1 + 3) = 1 / 2 of its mass within sqrt(3) scales, 1 - 1 / sqrt(37) within the cut.
  EXPECT_NEAR(static_cast<double>(within) / kCount, 0.5 / (1 - 1 / std::sqrt(37.0)), kAllowed);
}

TEST(Clusters, AreAtRestWithoutAttraction) {
  scene::ClusterSource cluster;
  cluster.count = 10;
  for (const Vec3d& v : scene::make_cluster(cluster, 1, std::nullopt).velocity) EXPECT_EQ(v, (Vec3d{0, 0, 0}));
}

}  // namespace
}  // namespace hooke
