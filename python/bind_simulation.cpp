// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "process_check.h"
#include "simulation.h"

namespace hooke::python {
namespace {

using OptionalPath = std::optional<std::filesystem::path>;

std::unique_ptr<PythonSimulation> from_scene(const std::filesystem::path& file, const py::dict& set, int threads,
                                             const std::string& device, const OptionalPath& resume,
                                             bool allow_outside) {
  refuse_fork();
  return std::make_unique<PythonSimulation>(read_scene(file, {set, allow_outside, resume}),
                                            DeviceOptions{threads, device}, resume);
}

std::unique_ptr<PythonSimulation> from_dict(const py::dict& scene, const std::filesystem::path& folder,
                                            const py::dict& set, int threads, const std::string& device,
                                            const OptionalPath& resume, bool allow_outside) {
  refuse_fork();
  return std::make_unique<PythonSimulation>(read_scene(scene, folder, {set, allow_outside, resume}),
                                            DeviceOptions{threads, device}, resume);
}

std::unique_ptr<PythonSimulation> from_arrays(const py::dict& scene, const py::object& x, const py::object& v,
                                              const py::object& material, const py::object& id,
                                              const std::filesystem::path& folder, const py::dict& set, int threads,
                                              const std::string& device) {
  refuse_fork();
  const py::dict rules = py::reinterpret_borrow<py::dict>(scene.attr("copy")());
  rules.attr("setdefault")("particles", py::list());
  scene::LoadedScene loaded = read_scene(rules, folder, {set, false, {}});
  add_particles(loaded, {x, v, material, id});
  return std::make_unique<PythonSimulation>(std::move(loaded), DeviceOptions{threads, device}, OptionalPath{});
}

std::vector<std::string> collider_names(PythonSimulation& s) {
  std::vector<std::string> names;
  for (const Collider& c : s.get().scene().colliders) names.push_back(c.name);
  return names;
}

template <double Material::* kMember>
py::array of_materials(PythonSimulation& s) {
  std::vector<double> values;
  for (const Material& m : s.get().scene().materials) values.push_back(m.*kMember);
  return to_array(values);
}

std::string repr(PythonSimulation& s) {
  if (s.is_closed()) return "<hooke.Simulation, closed>";
  const Simulation& simulation = s.get();
  return fmt::format("<hooke.Simulation \"{}\" of {} particles at step {}, {:.6g} s>", simulation.scene().name,
                     simulation.particle_count(), simulation.step_count(), simulation.time());
}

using Class = py::class_<PythonSimulation>;

void bind_creation(Class& c) {
  const py::arg_v set("set", py::dict(), "{}"), threads("threads", 0), device("device", "cpu"),
      resume("resume", py::none());
  c.def_static("from_scene", &from_scene, py::arg("file"), py::kw_only(), set, threads, device, resume,
               py::arg("allow_outside") = false,
               "Reads a scene file. `set` replaces values by their paths, as --set does: {\"time.end\": 2}.\n"
               "`threads`: 0 uses all. `device`: \"cpu\", \"cuda\", \"auto\" (cuda where it can be\n"
               "used), or \"reference\" (all pairs, double). `resume`: a checkpoint\n"
               "or a run folder, from which it goes on with the same bits. `allow_outside` lets paths in the scene\n"
               "lead out of its folder. SceneError with every finding.");
  c.def_static("from_dict", &from_dict, py::arg("scene"), py::kw_only(), py::arg("folder") = ".", set, threads, device,
               resume, py::arg("allow_outside") = false,
               "The same from a dict like a scene's JSON (docs/scene.md; hooke.schema()); numpy's numbers and arrays\n"
               "may be in it. Paths in it are relative to `folder`.");
  c.def_static("from_arrays", &from_arrays, py::arg("scene"), py::arg("x"), py::arg("v") = py::none(), py::kw_only(),
               py::arg("material") = py::none(), py::arg("id") = py::none(), py::arg("folder") = ".", set, threads,
               device,
               "The same with particles from arrays, beside those of the scene: positions `x`, m, of shape (n, 3),\n"
               "velocities `v`, m/s, (n, 3) or (3,) for all, by default 0; `material`, a name or n names or indices,\n"
               "needed where the scene has several; `id`, n whole numbers above 0, by default the next ones.");
  c.def("close", &PythonSimulation::close, "Frees its memory. Every later use raises ClosedError; snapshots stay.");
  c.def_property_readonly("closed", &PythonSimulation::is_closed, "Whether close() was called.");
  c.def("__enter__", [](const py::object& self) { return self; });
  c.def("__exit__", [](PythonSimulation& s, const py::args&) { s.close(); });
}

void bind_stepping(Class& c) {
  c.def("step", &PythonSimulation::step, py::arg("count") = 1,
        "Takes `count` (>= 0) steps of time_step. Other threads of Python run meanwhile. Ctrl-C ends it within about\n"
        "0.05 s with KeyboardInterrupt, between two steps: the simulation is good to go on. RunFailed where the run\n"
        "goes bad, with the step, the particles and the likely cause; it then takes no more steps.");
  c.def_property(
      "external_forces", &PythonSimulation::force_function, &PythonSimulation::set_force_function,
      "A function that step() calls before each step with the present snapshot, and that returns the force\n"
      "on each of its particles, N: an array of shape (n, 3), or (3,) for all. None, the default, ends it: where\n"
      "the function sets that itself, or another function, the step has no forces. Its exceptions end step().\n"
      "Forces are no part of a checkpoint.");
  c.def("set_external_forces", &PythonSimulation::set_external_forces, py::arg("ids"), py::arg("forces"),
        "Pushes particles with constant forces, N, (n, 3) or (3,), in every step from now on, in place of those set\n"
        "before; no ids end it. InputError where an id is unknown or twice there.");
  c.def_property_readonly("time", [](PythonSimulation& s) { return s.get().time(); }, "Simulated time, s.");
  c.def_property_readonly("step_count", [](PythonSimulation& s) { return s.get().step_count(); }, "Steps done.");
  c.def_property_readonly(
      "time_step", [](PythonSimulation& s) { return s.get().scene().time_step; }, "The time step, s.");
  c.def_property_readonly(
      "end_step", [](PythonSimulation& s) { return s.get().scene().steps; },
      "The step at which the scene ends, and run() too; step() goes on past it.");
  c.def("__len__", [](PythonSimulation& s) { return s.get().particle_count(); });
  c.def("__bool__", [](const PythonSimulation&) { return true; });
  c.def("__repr__", &repr);
}

void bind_reading(Class& c) {
  c.def("snapshot", &PythonSimulation::snapshot,
        "The present particles. It never changes; the first call after a step copies the particles from the engine,\n"
        "into memory of snapshots that nobody keeps.");
  c.def("positions", &PythonSimulation::positions, py::arg("out") = py::none(),
        "A copy of the positions, m, by ascending id, in the engine's own precision: float32 or float64 of shape\n"
        "(n, 3); faster than a snapshot. Into `out`, float32 or float64, where it is given.");
  c.def("velocities", &PythonSimulation::velocities, py::arg("out") = py::none(), "The same of the velocities, m/s.");
  c.def("measure", &PythonSimulation::measure, "Figures of this instant: hooke.Measurements.");
  c.def_property_readonly("ledger", &PythonSimulation::ledger, "Sums over all steps so far: hooke.Ledger.");
  c.def("contacts", &PythonSimulation::contacts,
        "Every contact of this instant once: hooke.Contacts. Found afresh, so it takes as long as some steps.");
  c.def_property_readonly("collider_poses", &PythonSimulation::collider_poses,
                          "Where the colliders are now: a dict of hooke.ColliderPose by name.");
  c.def_property_readonly("state_hash", &PythonSimulation::state_hash,
                          "16 hex digits that are equal only where every id, position and velocity, the clock and the\n"
                          "id counter are: those that `hooke run` reports.");
  c.def_property_readonly(
      "scene", [](PythonSimulation& s) { return parse_json(std::string(s.opened().resolved)); },
      "The scene as it was understood, with all defaults: a new dict like its JSON.");
  c.def_property_readonly("warnings", &PythonSimulation::warnings,
                          "What is likely a mistake, of the scene and of this instant: a list of hooke.Finding, empty\n"
                          "where nothing is: a time step that is too long, deep overlaps at the start, ...");
  c.def_property_readonly(
      "stable_step", [](PythonSimulation& s) { return stable_step(s.get()).seconds; },
      "The longest stable time step, s; inf where nothing can oscillate.");
  c.def_property_readonly(
      "materials", [](PythonSimulation& s) { return material_names(s.get().scene()); },
      "Names of the materials, which snapshots index.");
  c.def_property_readonly("radii", &of_materials<&Material::radius>, "Radius of each material, m: float64.");
  c.def_property_readonly("masses", &of_materials<&Material::mass>,
                          "Mass of a particle of each material, kg: float64.");
  c.def_property_readonly("colliders", &collider_names, "Names of the colliders.");
  c.def_property_readonly(
      "device", [](PythonSimulation& s) { return s.get().backend_info().device; },
      "\"cpu\", \"cuda: \" and the name of a GPU, or \"reference\".");
  c.def_property_readonly(
      "isa", [](PythonSimulation& s) { return s.get().backend_info().isa; },
      "The instruction set in use, e.g. \"avx2\".");
  c.def_property_readonly(
      "threads", [](PythonSimulation& s) { return s.get().backend_info().threads; }, "Threads of the engine.");
  c.def_property_readonly(
      "precision", [](PythonSimulation& s) { return std::string(to_string(s.get().backend_info().precision)); },
      "\"single\" or \"double\".");
}

void bind_edits(Class& c) {
  c.def("add", &PythonSimulation::add, py::arg("x"), py::arg("v") = py::none(), py::kw_only(),
        py::arg("material") = py::none(),
        "Adds particles at `x`, m, (n, 3), inside the domain, with velocities `v`, m/s, (n, 3) or (3,), by default 0;\n"
        "`material`: a name or index, or n of them, needed where the scene has several. Returns their ids, uint64.");
  c.def("remove", &PythonSimulation::remove, py::arg("ids"),
        "Removes particles. InputError where an id is unknown: then none is removed.");
  c.def("apply_impulse", &PythonSimulation::apply_impulse, py::arg("ids"), py::arg("impulses"),
        "v += impulse / mass: impulses, N s, of shape (n, 3), or (3,) for each of them.");
  c.def("set_positions", &PythonSimulation::set_positions, py::arg("ids"), py::arg("x"), py::arg("v") = py::none(),
        "Moves particles to `x`, m, (n, 3) or (3,), inside the domain; sets their velocities too where `v` is given.\n"
        "InputError where an id is unknown or a place is outside: then none is moved.");
  c.def("set_velocities", &PythonSimulation::set_velocities, py::arg("ids"), py::arg("v"),
        "Sets velocities, m/s, (n, 3) or (3,).");
  c.def("set_material", &PythonSimulation::set_material, py::arg("name"),
        "Changes numbers of a material from the next step on, e.g. set_material(\"water\", stiffness=5000): radius,\n"
        "mass, stiffness, shear, damping, drag, friction, tension, cohesion, range, in the units of the scene.");
  const auto zero = [] { return py::make_tuple(0, 0, 0); };
  c.def("move_collider", &PythonSimulation::move_collider, py::arg("name"), py::kw_only(), py::arg("position") = zero(),
        py::arg("rotation") = zero(), py::arg("velocity") = zero(), py::arg("angular_velocity") = zero(),
        "Holds a collider, from now on, `position` (m) away from where the scene has it, turned by `rotation` (rad,\n"
        "along the axis). It stays there until the next call; particles that touch it feel `velocity` (m/s) and\n"
        "`angular_velocity` (rad/s). InputError where there is none of this name.");
  c.def("state", &PythonSimulation::state, "The complete state, for restore(): hooke.State.");
  c.def("restore", &PythonSimulation::restore, py::arg("state"),
        "Goes back to a state of this simulation: the same bits follow.");
}

void bind_output(Class& c) {
  c.def("checkpoint", &PythonSimulation::write_checkpoint, py::arg("file"),
        "Writes the complete state into a file, for from_scene(..., resume=file) and `hooke run --resume`. FileError\n"
        "where it can't be written; the old file then stays.");
  c.def(
      "render", &PythonSimulation::render, py::kw_only(), py::arg("size") = std::pair{1280, 720},
      py::arg("color_by") = "material", py::arg("range") = py::none(), py::arg("samples") = 2, py::arg("legend") = true,
      py::arg("alpha") = false,
      "The picture of this instant: uint8 of shape (height, width, 3), or 4 with alpha. `color_by`: \"material\",\n"
      "\"speed\", \"height\", \"pressure\", \"contacts\" or \"id\"; `range`: the ends of its scale. Scale and camera "
      "stay\n"
      "those of the first picture with the same options. `samples`, 1 to 4, squared are those of a pixel. InputError\n"
      "where OpenGL is missing.");
  c.def("_repr_png_", &PythonSimulation::png, "The picture in notebooks.");
  c.def(
      "run",
      [](PythonSimulation& s, const std::filesystem::path& folder, bool overwrite,
         std::optional<double> checkpoint_every, const OptionalPath& film, std::pair<int, int> size, double fps,
         double speed, const std::string& color_by, const py::object& on_progress) {
        s.run({folder, overwrite, checkpoint_every, film, size, fps, speed, color_by, on_progress});
      },
      py::arg("folder"), py::kw_only(), py::arg("overwrite") = false, py::arg("checkpoint_every") = py::none(),
      py::arg("film") = py::none(), py::arg("size") = std::pair{1280, 720}, py::arg("fps") = 30.0,
      py::arg("speed") = 1.0, py::arg("color_by") = "material", py::arg("on_progress") = py::none(),
      "Steps to the end of the scene, and meanwhile writes a run folder and, if asked, a film, as `hooke run` does.\n"
      "`fps` is 0.001 to 1000, `speed`, the simulated seconds that a second of film shows, 1e-6 to 1e6.\n"
      "`checkpoint_every`: simulated seconds, by default ten a run. `on_progress(step, particles)` is called several\n"
      "times a second; its exceptions, and Ctrl-C, end the run with a snapshot and a checkpoint of the last step.\n"
      "InputError where the folder holds a run and `overwrite` is not set; RunFailed, FileError.");
}

// The C++ object of an instance, or null before it has one.
PythonSimulation* object_of(PyObject* self) {
  auto held = reinterpret_cast<py::detail::instance*>(self)->get_value_and_holder();
  return static_cast<PythonSimulation*>(held.value_ptr());
}

// A function of forces that uses its simulation is a cycle, which only Python's garbage collector can end.
void collect_garbage(PyHeapTypeObject* heap_type) {
  PyTypeObject& type = heap_type->ht_type;
  type.tp_flags |= Py_TPFLAGS_HAVE_GC;
  type.tp_traverse = [](PyObject* self, visitproc visit, void* arg) {
    Py_VISIT(Py_TYPE(self));
    if (const PythonSimulation* simulation = object_of(self)) Py_VISIT(simulation->force_function().ptr());
    return 0;
  };
  type.tp_clear = [](PyObject* self) {
    if (PythonSimulation* simulation = object_of(self)) simulation->drop_force_function();
    return 0;
  };
}

}  // namespace

void bind_simulation(py::module_& module) {
  py::class_<SimulationState>(module, "State", "A complete state of a simulation: Simulation.state().")
      .def_property_readonly(
          "step", [](const SimulationState& s) { return s.step; }, "Steps done.")
      .def("__len__", [](const SimulationState& s) { return s.particles.size(); });
  Class simulation(module, "Simulation", py::custom_type_setup(&collect_garbage),
                   "A scene, its particles, and the engine that steps them.\n\n"
                   "One thread of Python uses it at a time; while it is at work, calls from others raise BusyError.");
  bind_creation(simulation);
  bind_stepping(simulation);
  bind_reading(simulation);
  bind_edits(simulation);
  bind_output(simulation);
}

}  // namespace hooke::python
