// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// What a caller changes between steps.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "simulation.h"

namespace hooke::python {
namespace {

constexpr std::size_t kMostFindings = 20;

double to_number(const py::handle& value, const std::string& name) {
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() == nullptr) return number;
  PyErr_Clear();
  raise_input(name, fmt::format("expected a number, got {}", Py_TYPE(value.ptr())->tp_name));
}

// The number of a material that has this name, or null.
double* coefficient(Material& material, const std::string& name) {
  const std::pair<const char*, double*> all[] = {{"radius", &material.radius},
                                                 {"mass", &material.mass},
                                                 {"stiffness", &material.contact.stiffness},
                                                 {"shear", &material.contact.shear},
                                                 {"damping", &material.contact.damping},
                                                 {"drag", &material.drag},
                                                 {"friction", &material.surface.friction},
                                                 {"tension", &material.surface.tension},
                                                 {"cohesion", &material.surface.cohesion},
                                                 {"range", &material.surface.range}};
  for (const auto& [key, value] : all) {
    if (name == key) return value;
  }
  return nullptr;
}

}  // namespace

std::vector<ParticleAt> PythonSimulation::find_all(const std::vector<std::uint64_t>& ids) {
  const Simulation& simulation = use();
  std::vector<ParticleAt> found;
  std::vector<Finding> findings;
  found.reserve(ids.size());
  for (const std::uint64_t id : ids) {
    auto particle = simulation.find(id);
    if (particle) {
      found.push_back(*particle);
    } else if (particle.error().kind != Error::Kind::bad_input) {
      raise(particle.error());
    } else if (findings.size() < kMostFindings) {
      findings.push_back(particle.error().findings.front());
    }
  }
  if (!findings.empty()) raise(ErrorClass::input, findings);
  return found;
}

// All are checked before one is moved.
void PythonSimulation::set_particles(const std::vector<ParticleAt>& particles) {
  Simulation& simulation = use();
  const Domain& domain = simulation.scene().domain;
  std::vector<Finding> findings;
  for (const ParticleAt& p : particles) {
    for (int axis = 0; axis < 3 && findings.size() < kMostFindings; ++axis) {
      const double at = component(p.position, axis);
      const double min = component(domain.min, axis), max = component(domain.max, axis);
      if (at >= min && at <= max) continue;
      findings.push_back({fmt::format("particle {}", p.id),
                          fmt::format("{} = {} is outside the domain, {} to {}", "xyz"[axis], at, min, max)});
    }
  }
  if (!findings.empty()) raise(ErrorClass::input, findings);
  change([&]() -> Expected<void> {
    for (const ParticleAt& p : particles) {
      if (auto set = simulation.set_particle(p.id, p.position, p.velocity); !set) return set;
    }
    return {};
  });
}

// Arguments are Python's: to convert them may run code that closes the simulation. So use() comes after that.
py::array PythonSimulation::add(const py::object& x, const py::object& v, const py::object& material) {
  const std::vector<std::string> names = material_names(use().scene());
  const std::vector<Vec3d> positions = to_vectors(x, "x");
  const std::size_t count = positions.size();
  const std::vector<Vec3d> velocities =
      v.is_none() ? std::vector<Vec3d>(count, Vec3d{0, 0, 0}) : to_vectors(v, count, "v");
  const std::vector<std::size_t> materials = to_materials(material, count, names);
  std::vector<NewParticle> particles(count);
  for (std::size_t i = 0; i < count; ++i) particles[i] = {materials[i], positions[i], velocities[i]};
  Simulation& simulation = use();
  return to_array(change([&] { return simulation.add_particles(particles); }));
}

void PythonSimulation::remove(const py::object& ids) {
  const std::vector<std::uint64_t> gone = to_ids(ids);
  find_all(gone);
  Simulation& simulation = use();
  change([&] { return simulation.remove_particles(gone); });
}

void PythonSimulation::apply_impulse(const py::object& ids, const py::object& impulses) {
  const std::vector<std::uint64_t> pushed = to_ids(ids);
  const std::vector<Vec3d> by = to_vectors(impulses, pushed.size(), "impulses");
  find_all(pushed);
  Simulation& simulation = use();
  change([&]() -> Expected<void> {
    for (std::size_t k = 0; k < pushed.size(); ++k) {
      if (auto done = simulation.apply_impulse(pushed[k], by[k]); !done) return done;
    }
    return {};
  });
}

void PythonSimulation::set_positions(const py::object& ids, const py::object& x, const py::object& v) {
  const std::vector<std::uint64_t> moved = to_ids(ids);
  const std::vector<Vec3d> positions = to_vectors(x, moved.size(), "x");
  const std::vector<Vec3d> velocities = v.is_none() ? std::vector<Vec3d>{} : to_vectors(v, moved.size(), "v");
  std::vector<ParticleAt> particles = find_all(moved);
  for (std::size_t k = 0; k < particles.size(); ++k) {
    particles[k].position = positions[k];
    if (!v.is_none()) particles[k].velocity = velocities[k];
  }
  set_particles(particles);
}

void PythonSimulation::set_velocities(const py::object& ids, const py::object& v) {
  const std::vector<std::uint64_t> pushed = to_ids(ids);
  const std::vector<Vec3d> velocities = to_vectors(v, pushed.size(), "v");
  std::vector<ParticleAt> particles = find_all(pushed);
  for (std::size_t k = 0; k < particles.size(); ++k) particles[k].velocity = velocities[k];
  set_particles(particles);
}

void PythonSimulation::set_external_forces(const py::object& ids, const py::object& forces) {
  const std::vector<std::uint64_t> pushed = to_ids(ids);
  const std::vector<Vec3d> by = to_vectors(forces, pushed.size(), "forces");
  Simulation& simulation = use();
  if (!force_function_.is_none()) raise_input("external_forces", "is a function, which sets the forces of each step");
  change([&] { return simulation.set_external_forces(pushed, by); });
}

void PythonSimulation::set_material(const std::string& name, const py::kwargs& values) {
  const std::size_t index = to_materials(py::str(name), 1, material_names(use().scene())).front();
  std::vector<std::pair<std::string, double>> changes;
  for (const auto& [key, value] : values) {
    const auto word = key.cast<std::string>();
    changes.emplace_back(word, to_number(value, word));
  }
  Simulation& simulation = use();
  Material material = simulation.scene().materials[index];
  for (const auto& [word, value] : changes) {
    double* const number = coefficient(material, word);
    if (number == nullptr) {
      raise_input(word,
                  "is nothing that a material can change; known are radius, mass, stiffness, shear, damping, "
                  "drag, friction, tension, cohesion, range");
    }
    *number = value;
  }
  change([&] { return simulation.set_material(material); });
}

void PythonSimulation::move_collider(const std::string& name, const py::object& position, const py::object& rotation,
                                     const py::object& velocity, const py::object& angular_velocity) {
  HeldMotion motion;
  motion.position = to_vector(position, "position");
  motion.rotation = to_vector(rotation, "rotation");
  motion.velocity = to_vector(velocity, "velocity");
  motion.angular_velocity = to_vector(angular_velocity, "angular_velocity");
  Simulation& simulation = use();
  change([&] { return simulation.set_collider_motion(name, motion); });
}

}  // namespace hooke::python
