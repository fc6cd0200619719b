// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/cluster_source.h"

#include <array>
#include <cmath>

#include "hooke/base/assert.h"
#include "hooke/base/random.h"
#include "hooke/scene/scene_builder.h"

namespace hooke::scene {
namespace {

constexpr double kSphereCut = 10, kDiscCut = 6;  // scales
constexpr double kDiscHeight = 0.1;              // scales, from the disc's lower to its upper side

// The random numbers of one particle, in sequence.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t particle) : seed_(seed), particle_(particle) {}

  double next() {
    if (used_ == 4) {
      numbers_ = uniform4(seed_, particle_, draw_++);
      used_ = 0;
    }
    return numbers_[used_++];
  }

  // A random unit vector: a point of the unit ball, not too near its middle, normalised.
  Vec3d direction() {
    for (;;) {
      const double x = 2 * next() - 1, y = 2 * next() - 1, z = 2 * next() - 1;
      const double square = x * x + y * y + z * z;
      if (square > 1e-4 && square <= 1) return (1 / std::sqrt(square)) * Vec3d{x, y, z};
    }
  }

 private:
  std::uint64_t seed_, particle_;
  std::uint32_t draw_ = 0;
  std::array<double, 4> numbers_{};
  std::size_t used_ = 4;
};

// The cube root of `value`, 0 < value <= 1: Newton's method from above, until the root no longer decreases.
double cube_root(double value) {
  double root = 1;
  for (;;) {
    const double next = (2 * root + value / (root * root)) / 3;
    if (!(next < root)) return root;
    root = next;
  }
}

Vec3d unit(const Vec3d& a) { return (1 / std::sqrt(dot(a, a))) * a; }
Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// In units of the scale and of the speed sqrt(G M / scale).
struct Place {
  Vec3d x, v;
};

Place in_sphere(Draws& draws) {
  const double edge = kSphereCut / std::sqrt(1 + kSphereCut * kSphereCut);  // the cube root of the mass within
  const double root = edge * cube_root(1 - draws.next());
  const double radius = root / std::sqrt(1 - root * root);
  // The speed as a fraction q of the escape speed has the density q^2 (1 - q^2)^(7/2), which is nowhere above 0.1.
  double q = 0;
  for (bool taken = false; !taken;) {
    q = draws.next();
    const double rest = 1 - q * q;
    taken = 0.1 * draws.next() < q * q * rest * rest * rest * std::sqrt(rest);
  }
  const double escape = std::sqrt(2 / std::sqrt(1 + radius * radius));
  const Vec3d outward = draws.direction();
  return {radius * outward, q * escape * draws.direction()};
}

Place in_disc(Draws& draws, const Vec3d& normal) {
  const double within = 1 - 1 / std::sqrt(1 + kDiscCut * kDiscCut);  // mass within the cut
  const double rest = 1 - within * draws.next();
  const double radius = std::sqrt(1 / (rest * rest) - 1);
  const Vec3d outward = unit(cross(normal, draws.direction()));
  const double softened = std::sqrt(1 + radius * radius);
  const double speed = radius / (softened * std::sqrt(softened));
  return {radius * outward + kDiscHeight * (draws.next() - 0.5) * normal, speed * cross(normal, outward)};
}

}  // namespace

ClusterSource read_cluster(const Json& json) {
  ClusterSource cluster;
  if (json.at("profile") == "disc") cluster.profile = ClusterSource::Profile::disc;
  cluster.center = vec3_or(json.at("center"), {});
  cluster.scale = json.at("scale").get<double>();
  cluster.count = json.at("count").get<std::uint64_t>();
  cluster.normal = vec3_or(json.at("normal"), cluster.normal);
  cluster.companion = json.at("companion").get<double>();
  cluster.seed = json.at("seed").get<std::uint64_t>();
  return cluster;
}

ClusterParticles make_cluster(const ClusterSource& cluster, double mass, const std::optional<Attraction>& attraction) {
  HOOKE_ASSERT(cluster.scale > 0 && cluster.companion >= 0 && mass > 0, cluster.scale, cluster.companion, mass);
  HOOKE_ASSERT(dot(cluster.normal, cluster.normal) > 0, cluster.normal);
  const double total = static_cast<double>(cluster.count) * mass + cluster.companion;
  const double speed = std::sqrt((attraction ? attraction->constant : 0) * total / cluster.scale);
  const Vec3d normal = unit(cluster.normal);
  ClusterParticles particles;
  particles.position.reserve(cluster.count);
  particles.velocity.reserve(cluster.count);
  for (std::uint64_t i = 0; i < cluster.count; ++i) {
    Draws draws(cluster.seed, i);
    const bool is_disc = cluster.profile == ClusterSource::Profile::disc;
    const Place place = is_disc ? in_disc(draws, normal) : in_sphere(draws);
    particles.position.push_back(cluster.center + cluster.scale * place.x);
    particles.velocity.push_back(speed * place.v);
  }
  return particles;
}

}  // namespace hooke::scene
