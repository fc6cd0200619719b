// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "inspection.h"

#include <algorithm>

#include "hooke/base/printable.h"
#include "hooke/core/contacts.h"
#include "hooke/physics/periodic.h"

namespace hooke::view {
namespace {

// The particles that may touch one at `x`, across periodic faces too, and itself.
ParticleSet surroundings(const Scene& scene, const ParticleSet& all, const Vec3d& x, double radius) {
  double largest = 0, range = 0;
  for (const Material& m : scene.materials) {
    largest = std::max(largest, m.radius);
    range = std::max(range, m.surface.range);
  }
  const double reach = radius + largest + range;
  ParticleSet near;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Vec3d off = nearest_displacement(all.position[i], x, scene.domain.period());
    if (dot(off, off) > reach * reach) continue;
    near.id.push_back(all.id[i]);
    near.material.push_back(all.material[i]);
    near.position.push_back(all.position[i]);
    near.velocity.push_back(all.velocity[i]);
  }
  return near;
}

std::string partner_of(const Contact& contact, bool is_a, const ParticleSet& near, const Scene& scene) {
  if (contact.b == Contact::kWall) return std::string("wall ") + to_string(contact.face);
  if (contact.b == Contact::kCollider) return "collider " + printable(scene.colliders[contact.collider].name);
  return "particle " + std::to_string(near.id[is_a ? contact.b : contact.a]);
}

}  // namespace

std::optional<Inspection> inspect_particle(const Simulation& simulation, std::uint64_t id) {
  const auto particle = simulation.find(id);
  if (!particle) return {};
  const Scene& scene = simulation.scene();
  Inspection found;
  found.particle = *particle;
  const double radius = scene.materials[particle->material].radius;
  const ParticleSet near = surroundings(scene, simulation.particles(), particle->position, radius);
  const std::vector<std::uint64_t> broken = simulation.broken_springs();
  for (const Contact& contact : find_contacts(scene, near, {simulation.time(), broken})) {
    const bool is_a = near.id[contact.a] == id;
    const bool of_particles = contact.b != Contact::kWall && contact.b != Contact::kCollider;
    if (!is_a && !(of_particles && near.id[contact.b] == id)) continue;
    const Vec3d force = is_a ? contact.force : -contact.force;
    found.contacts.push_back({partner_of(contact, is_a, near, scene), contact.overlap, force});
    found.force += force;
  }
  return found;
}

}  // namespace hooke::view
