// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/spray.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hooke/base/random.h"

namespace hooke::render {

namespace {

constexpr std::uint64_t kSeed = 7;
constexpr std::uint32_t kFineDrops = 8;
constexpr float kSmallest = 0.1f, kLargest = 0.38f;  // radius of a fine drop, over the particle's
constexpr float kNear = 0.7f, kFar = 2.2f;           // its distance from the particle, likewise
constexpr float kLeastDrop = 0.35f;                  // share of its radius that the particle's own drop keeps
constexpr float kWhite = 70;                         // foam of fine drops at their most
constexpr float kGone = 0.05f;  // a fine drop of less than this, over the particle's radius, is none

}  // namespace

void make_spray(Sphere& drop, std::uint64_t particle, float radius, float loose, float dense,
                std::vector<Sphere>& fine) {
  if (loose <= 0) return;
  const auto random = [&](std::uint32_t draw) { return uniform4(kSeed, particle, draw); };
  const auto share = static_cast<float>(random(0)[0]);
  drop.radius *= 1 - loose * (1 - kLeastDrop) * (1 - share * share * share);
  const float spray = loose * dense;
  for (std::uint32_t k = 1; k <= kFineDrops; ++k) {
    const auto u = random(k);
    const auto size = static_cast<float>(u[0] * u[0]);  // many small ones, few large ones
    Sphere one = drop;
    one.radius = radius * spray * (kSmallest + (kLargest - kSmallest) * size);
    if (one.radius < kGone * radius) continue;
    const double height = 2 * u[1] - 1, across = std::sqrt(1 - height * height), angle = 2 * std::numbers::pi * u[2];
    const Vec3d to{across * std::cos(angle), across * std::sin(angle), height};
    const auto away = radius * (kNear + (kFar - kNear) * static_cast<float>(u[3]));
    one.x += away * static_cast<float>(to.x);
    one.y += away * static_cast<float>(to.y);
    one.z += away * static_cast<float>(to.z);
    one.roughness = 255;
    one.foam = std::max(one.foam, static_cast<std::uint8_t>(1 + kWhite * spray));
    fine.push_back(one);
  }
}

}  // namespace hooke::render
