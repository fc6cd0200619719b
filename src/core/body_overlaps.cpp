// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/body_overlaps.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <utility>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"
#include "hooke/core/contact_walk.h"
#include "hooke/core/placed_colliders.h"
#include "hooke/physics/enclosure.h"

namespace hooke {
namespace {

constexpr std::size_t kWalls = 6;

// What some of the particles do with each wall and each collider.
class Tally {
 public:
  explicit Tally(const Scene& scene) : bodies_(kWalls + scene.colliders.size()) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (b < kWalls) bodies_[b].overlap.face = static_cast<Face>(b + 1);
      if (b >= kWalls) bodies_[b].overlap.collider = static_cast<std::uint32_t>(b - kWalls);
    }
  }

  // A face of the body: of those that a particle overlaps, it counts once.
  void add_overlap(std::size_t body, std::uint64_t id, double ratio) {
    Body& b = bodies_[body];
    if (b.last_touching != id) ++b.overlap.touching;
    b.last_touching = id;
    take_deeper(b.overlap, id, ratio);
  }
  void add_inside(std::size_t body, std::uint64_t id) {
    Body& b = bodies_[body];
    if (b.last_inside != id) ++b.overlap.inside;
    b.last_inside = id;
  }
  void add(const Tally& other) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const BodyOverlap& theirs = other.bodies_[b].overlap;
      bodies_[b].overlap.touching += theirs.touching;
      bodies_[b].overlap.inside += theirs.inside;
      if (theirs.touching > 0) take_deeper(bodies_[b].overlap, theirs.deepest, theirs.ratio);
    }
  }
  std::vector<BodyOverlap> result() const {
    std::vector<BodyOverlap> found;
    for (const Body& b : bodies_) {
      if (b.overlap.touching > 0 || b.overlap.inside > 0) found.push_back(b.overlap);
    }
    return found;
  }

 private:
  static constexpr std::uint64_t kNoId = std::numeric_limits<std::uint64_t>::max();
  struct Body {
    BodyOverlap overlap;
    std::uint64_t last_touching = kNoId, last_inside = kNoId;
  };

  // Of two that are equally deep the one with the smaller id, whatever their order.
  static void take_deeper(BodyOverlap& b, std::uint64_t id, double ratio) {
    if (ratio < b.ratio || (ratio == b.ratio && id >= b.deepest)) return;
    b.ratio = ratio;
    b.deepest = id;
  }

  std::vector<Body> bodies_;
};

double largest_radius(const Scene& scene) {
  double largest = 0;
  for (const Material& m : scene.materials) largest = std::max(largest, m.radius);
  return largest;
}

// The walls and colliders of a scene, where they are at some time, and what particles do with them.
class Finder {
 public:
  Finder(const Scene& scene, double time)
      : scene_(scene),
        colliders_(place_colliders<double>(scene, poses(scene, time), largest_radius(scene))),
        walls_(scene.domain.walls()),
        all_(scene) {}

  void add(const ParticleSlice& particles) {
    constexpr std::size_t kBlock = 4096;  // particles a piece of work
    std::mutex mutex;                     // around the tally of all
    parallel_ranges(particles.size(), kBlock, [&](std::size_t first, std::size_t last) {
      Tally some(scene_);
      for (std::size_t i = first; i < last; ++i)
        look(particles.position[i], particles.id[i], scene_.materials[particles.material[i]].radius, some);
      const std::lock_guard lock(mutex);
      all_.add(some);
    });
  }
  std::vector<BodyOverlap> result() const { return all_.result(); }

 private:
  static std::vector<ColliderPose> poses(const Scene& scene, double time) {
    std::vector<ColliderPose> poses;
    for (const Collider& collider : scene.colliders) poses.push_back(pose_at(collider, time));
    return poses;
  }

  void look(const Vec3d& x, std::uint64_t id, double radius, Tally& tally) const {
    for_each_wall(walls_, x, radius, 0, [&](int face, const Vec3d&, double overlap) {
      tally.add_overlap(static_cast<std::size_t>(face), id, overlap / radius);
    });
    for (std::size_t n = 0; n < colliders_.all.size(); ++n) {
      const PlacedCollider<double>& collider = colliders_.all[n];
      if (!collider.near.contains(x)) continue;
      const std::size_t body = kWalls + colliders_.of[n];
      for_each_collider_face(collider, x, [&](const ColliderFace<double>& face) {
        if (face.distance < radius) tally.add_overlap(body, id, (radius - face.distance) / radius);
      });
      if (!collider.shape.hollow && encloses(collider, x)) tally.add_inside(body, id);
    }
  }

  const Scene& scene_;
  PlacedColliders<double> colliders_;
  Walls walls_;
  Tally all_;
};

}  // namespace

std::vector<BodyOverlap> find_body_overlaps(const Scene& scene, const ParticleSet& particles, double time) {
  HOOKE_ASSERT(are_particles_of(particles, scene), particles.size(), scene.materials.size());
  Finder finder(scene, time);
  finder.add(ParticleSlice(particles, 0, particles.size()));
  return finder.result();
}

Expected<std::vector<BodyOverlap>> find_body_overlaps_in_slices(const Scene& scene, const ParticleSlices& particles,
                                                                double time) {
  constexpr std::size_t kRows = std::size_t{1} << 18U;
  Finder finder(scene, time);
  auto visited = particles.visit(kRows, [&finder](const ParticleSlice& slice) { finder.add(slice); });
  if (!visited) return fail(std::move(visited).error());
  return finder.result();
}

}  // namespace hooke
