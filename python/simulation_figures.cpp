// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// What a caller reads of the present state.
#include <fmt/format.h>

#include "hooke/core/contacts.h"
#include "simulation.h"

namespace hooke::python {
namespace {

// What follows builds Python objects, and so may run Python code that closes the simulation: all is copied before.

// One of the tuples of hooke/_figures.py.
py::object figures(const char* type, const py::dict& fields) {
  return py::module_::import("hooke._figures").attr(type)(**fields);
}

constexpr const char* kCauseNames[kCauses] = {
    "contact_spring", "contact_shear", "contact_damping", "contact_friction", "wall",    "collider", "drag", "gravity",
    "hold",           "springs",       "field",           "attraction",       "external"};

std::vector<std::string> collider_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Collider& collider : scene.colliders) names.push_back(collider.name);
  return names;
}

py::dict collider_loads(const Measurements& m, const std::vector<std::string>& names) {
  py::dict loads;
  for (std::size_t k = 0; k < m.colliders.size(); ++k) {
    const ColliderLoad& load = m.colliders[k];
    py::dict fields;
    fields["force"] = to_array(load.force);
    fields["torque"] = to_array(load.torque);
    fields["contacts"] = load.contacts;
    loads[py::str(names[k])] = figures("ColliderLoad", fields);
  }
  return loads;
}

}  // namespace

py::object PythonSimulation::measure() {
  const Simulation& simulation = use();
  const std::vector<std::string> names = collider_names(simulation.scene());
  const Measurements m = unwrap(without_gil([&] { return simulation.measure(); }));
  py::dict fields;
  fields["particles"] = m.particles;
  fields["contacts"] = m.contacts;
  fields["wall_contacts"] = m.wall_contacts;
  fields["kinetic_energy"] = m.kinetic_energy;
  fields["potential_energy"] = m.potential_energy;
  fields["elastic_energy"] = m.elastic_energy;
  fields["wall_elastic_energy"] = m.wall_elastic_energy;
  fields["collider_elastic_energy"] = m.collider_elastic_energy;
  fields["springs"] = m.springs;
  fields["spring_energy"] = m.spring_energy;
  fields["attraction_energy"] = m.attraction_energy;
  fields["momentum"] = to_array(m.momentum);
  fields["centre_of_mass"] = to_array(m.centre_of_mass);
  fields["max_speed"] = m.max_speed;
  fields["max_overlap_ratio"] = m.max_overlap_ratio;
  fields["mean_overlap_ratio"] = m.mean_overlap_ratio;
  fields["min"] = to_array(m.min);
  fields["max"] = to_array(m.max);
  fields["wall_force"] = to_array(m.wall_force);
  fields["colliders"] = collider_loads(m, names);
  return figures("Measurements", fields);
}

py::object PythonSimulation::ledger() {
  const Ledger ledger = use().ledger();
  py::dict work, impulse, fields;
  for (std::size_t k = 0; k < kCauses; ++k) {
    const auto cause = static_cast<Cause>(k);
    work[kCauseNames[k]] = ledger.work[cause];
    impulse[kCauseNames[k]] = to_array(ledger.impulse[cause]);
  }
  fields["work"] = work;
  fields["impulse"] = impulse;
  fields["dissipated"] = ledger.dissipated();
  fields["removed"] = ledger.removed;
  fields["removed_momentum"] = to_array(ledger.removed_momentum);
  fields["removed_energy"] = ledger.removed_energy;
  fields["removed_elastic"] = ledger.removed_elastic;
  fields["born"] = ledger.population.born;
  fields["expired"] = ledger.population.expired;
  fields["sunk"] = ledger.population.sunk;
  fields["born_energy"] = ledger.population.born_energy;
  fields["born_momentum"] = to_array(ledger.population.born_momentum);
  fields["broken_springs"] = ledger.springs.broken;
  return figures("Ledger", fields);
}

py::object PythonSimulation::contacts() {
  const Simulation& simulation = use();
  std::vector<std::uint64_t> a, b;
  std::vector<std::uint8_t> kind;
  std::vector<std::int32_t> partner;
  std::vector<double> overlap;
  std::vector<Vec3d> force, point;
  without_gil([&] {
    const auto now = simulation.snapshot();
    const auto broken = simulation.broken_springs();
    const std::vector<std::uint64_t>& ids = now->particles.id;
    for (const Contact& c : find_contacts(simulation.scene(), now->particles, {now->time, broken})) {
      const bool wall = c.b == Contact::kWall, collider = c.b == Contact::kCollider;
      a.push_back(ids[c.a]);
      b.push_back(wall || collider ? 0 : ids[c.b]);
      kind.push_back(wall ? 1 : collider ? 2 : 0);
      partner.push_back(wall       ? static_cast<std::int32_t>(c.face) - static_cast<std::int32_t>(Face::x_min)
                        : collider ? static_cast<std::int32_t>(c.collider)
                                   : -1);
      overlap.push_back(c.overlap);
      force.push_back(c.force);
      point.push_back(c.point);
    }
  });
  py::dict fields;
  fields["a"] = to_array(a);
  fields["b"] = to_array(b);
  fields["kind"] = to_array(kind);
  fields["partner"] = to_array(partner);
  fields["overlap"] = to_array(overlap);
  fields["force"] = to_array(force);
  fields["point"] = to_array(point);
  return figures("Contacts", fields);
}

py::dict PythonSimulation::collider_poses() {
  const Simulation& simulation = use();
  const std::vector<std::string> names = collider_names(simulation.scene());
  const std::vector<ColliderPose> now(simulation.collider_poses().begin(), simulation.collider_poses().end());
  py::dict poses;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const ColliderPose& pose = now[k];
    py::dict fields;
    fields["pivot"] = to_array(pose.pivot);
    fields["axes"] = to_array(std::vector<Vec3d>(pose.turn.begin(), pose.turn.end()));
    fields["velocity"] = to_array(pose.velocity);
    fields["angular_velocity"] = to_array(pose.angular_velocity);
    poses[py::str(names[k])] = figures("ColliderPose", fields);
  }
  return poses;
}

}  // namespace hooke::python
