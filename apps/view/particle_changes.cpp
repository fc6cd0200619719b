// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "particle_changes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hooke/base/box3.h"
#include "hooke/base/random.h"
#include "hooke/core/free_space.h"
#include "hooke/core/placed_colliders.h"

namespace hooke::view {
namespace {

constexpr double kLoose = 1.02;  // lattice spacing over the diameter
constexpr std::int64_t kMostSites = 4'000'000;

std::optional<std::size_t> material_index(const Scene& scene, const std::string& name) {
  for (std::size_t k = 0; k < scene.materials.size(); ++k) {
    if (scene.materials[k].name == name && scene.materials[k].is_of_particles()) return k;
  }
  return {};
}

// The sites of a hexagonal lattice in a ball, from below; its middle alone where it is smaller than the spacing.
std::vector<Vec3d> sites_in_ball(const Vec3d& center, double radius, double spacing) {
  std::vector<Vec3d> sites;
  const double layer = spacing * 0.816496580927726, row = spacing * 0.8660254037844386;  // sqrt(2/3), sqrt(3)/2
  const auto reach = [&](double step) { return static_cast<std::int64_t>(radius / step) + 1; };
  for (std::int64_t k = -reach(layer); k <= reach(layer); ++k) {
    const bool odd = k % 2 != 0;
    for (std::int64_t j = -reach(row); j <= reach(row); ++j) {
      for (std::int64_t i = -reach(spacing); i <= reach(spacing); ++i) {
        const double shift = (j % 2 != 0 ? 0.5 : 0) + (odd ? 0.5 : 0);
        const Vec3d from{spacing * (static_cast<double>(i) + shift), layer * static_cast<double>(k),
                         row * (static_cast<double>(j) + (odd ? 1.0 / 3 : 0))};
        if (dot(from, from) <= radius * radius) sites.push_back(center + from);
      }
    }
  }
  if (sites.empty()) sites.push_back(center);
  return sites;
}

// Free space among the particles in a box, and among the colliders.
class Room {
 public:
  Room(const Simulation& simulation, std::size_t material)
      : scene_(simulation.scene()),
        colliders_(place_colliders<double>(scene_, simulation.collider_poses(), 2 * largest_radius(scene_))),
        free_(scene_, material, colliders_.all) {}

  void add(const Vec3d& position, std::size_t material) {
    if (scene_.materials[material].interacts) free_.add({position, scene_.materials[material].radius});
  }
  void add_all_in(const Box3d& box, const ParticleSet& particles) {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      if (box.contains(particles.position[i])) add(particles.position[i], particles.material[i]);
    }
  }
  bool has_room_at(const Vec3d& x) const { return free_.has_room_at(x); }
  double reach() const { return free_.reach(); }

 private:
  static double largest_radius(const Scene& scene) {
    double largest = 0;
    for (const Material& m : scene.materials) largest = std::max(largest, m.radius);
    return largest;
  }

  const Scene& scene_;
  PlacedColliders<double> colliders_;
  FreeSpace free_;
};

}  // namespace

Expected<void> add_ball(Simulation& simulation, const AddBall& ball) {
  const Scene& scene = simulation.scene();
  const auto material = material_index(scene, ball.material);
  if (!material) {
    return fail(Error::Kind::bad_input, "ball",
                "the scene has no material \"" + printable(ball.material) + "\" of particles");
  }
  const double spacing = kLoose * 2 * scene.materials[*material].radius;
  const double across = 2 * ball.radius / spacing + 1;
  if (!(across * across * across < static_cast<double>(kMostSites))) {
    return fail(Error::Kind::bad_input, "ball", "is too large for its particles");
  }
  Room room(simulation, *material);
  const double reach = ball.radius + room.reach();
  Box3d box{ball.center - Vec3d{reach, reach, reach}, ball.center + Vec3d{reach, reach, reach}};
  // Across a periodic face the ball may meet anything.
  for (int axis = 0; axis < 3; ++axis) {
    if (scene.domain.boundary[static_cast<std::size_t>(axis)] != Boundary::periodic) continue;
    component(box.min, axis) = component(scene.domain.min, axis);
    component(box.max, axis) = component(scene.domain.max, axis);
  }
  room.add_all_in(box, simulation.particles());
  std::vector<NewParticle> added;
  for (const Vec3d& site : sites_in_ball(ball.center, ball.radius, spacing)) {
    if (room.has_room_at(site)) added.push_back({*material, site, ball.velocity});
  }
  if (added.empty()) return fail(Error::Kind::bad_input, "ball", "there is no room for a particle");
  const auto ids = simulation.add_particles(added);
  if (!ids) return fail(ids.error());
  return {};
}

Expected<void> scatter(Simulation& simulation, const Scatter& how) {
  constexpr std::uint32_t kTries = 400;
  const Scene& scene = simulation.scene();
  SimulationState state = simulation.state();
  ParticleSet& particles = state.particles;
  std::set<std::uint64_t> tied;
  if (state.structure) {
    tied.insert(state.structure->pinned.begin(), state.structure->pinned.end());
    tied.insert(state.structure->springs.a.begin(), state.structure->springs.a.end());
    tied.insert(state.structure->springs.b.begin(), state.structure->springs.b.end());
  }
  const auto stays = [&](std::size_t i) {
    return scene.materials[particles.material[i]].fixed || tied.count(particles.id[i]) != 0;
  };
  // A room for each material, each with all that has a place so far; large particles first, which need most room.
  std::vector<std::optional<Room>> rooms(scene.materials.size());
  std::vector<std::size_t> moved;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (!stays(i)) {
      moved.push_back(i);
      if (!rooms[particles.material[i]]) rooms[particles.material[i]].emplace(simulation, particles.material[i]);
    }
  }
  if (moved.empty()) return fail(Error::Kind::bad_input, "scatter", "no particle may be moved");
  const auto add_everywhere = [&](std::size_t i) {
    for (std::optional<Room>& room : rooms) {
      if (room) room->add(particles.position[i], particles.material[i]);
    }
  };
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (stays(i)) add_everywhere(i);
  }
  std::stable_sort(moved.begin(), moved.end(), [&](std::size_t a, std::size_t b) {
    return scene.materials[particles.material[a]].radius > scene.materials[particles.material[b]].radius;
  });
  const Domain& domain = scene.domain;
  for (const std::size_t i : moved) {
    const Room& room = *rooms[particles.material[i]];
    bool placed = false;
    for (std::uint32_t attempt = 0; attempt < kTries && !placed; ++attempt) {
      const auto u = uniform4(how.seed, particles.id[i], attempt);
      const Vec3d x{domain.min.x + u[0] * domain.length(0), domain.min.y + u[1] * domain.length(1),
                    domain.min.z + u[2] * domain.length(2)};
      if (!room.has_room_at(x)) continue;
      placed = true;
      particles.position[i] = x;
      particles.velocity[i] = {0, 0, 0};
      if (!particles.acceleration.empty()) particles.acceleration[i] = {0, 0, 0};
      add_everywhere(i);
    }
    if (!placed)
      return fail(Error::Kind::bad_input, "scatter", "the domain has no room for all particles at random places");
  }
  return simulation.restore(std::move(state));
}

}  // namespace hooke::view
