// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "arrays.h"
#include "hooke/run/open_simulation.h"
#include "picture_thread.h"
#include "scene_source.h"
#include "snapshot.h"

namespace hooke::python {

/// Sets a flag while it exists.
class Flag {
 public:
  explicit Flag(bool& flag) : flag_(flag) { flag_ = true; }
  ~Flag() { flag_ = false; }
  Flag(const Flag&) = delete;
  Flag& operator=(const Flag&) = delete;

 private:
  bool& flag_;
};

/// Names the calling thread while it exists.
class ThreadMark {
 public:
  explicit ThreadMark(std::thread::id& thread) : thread_(thread) { thread_ = std::this_thread::get_id(); }
  ~ThreadMark() { thread_ = {}; }
  ThreadMark(const ThreadMark&) = delete;
  ThreadMark& operator=(const ThreadMark&) = delete;

 private:
  std::thread::id& thread_;
};

/// The back end, as Python asks for it.
struct DeviceOptions {
  int threads = 0;  ///< 0: as many as the machine has
  std::string device = "cpu";
};

/// What Simulation.run() writes, as Python calls it.
struct RunOptions {
  std::filesystem::path folder;
  bool overwrite = false;
  std::optional<double> checkpoint_every;
  std::optional<std::filesystem::path> film;
  std::pair<int, int> size{1280, 720};
  double frames_per_second = 30;
  double speed = 1;
  std::string color_by = "material";
  py::object on_progress = py::none();
};

/// hooke.Simulation. Python threads share it: while one is at work without the GIL, or in step() or run(), calls of
/// others raise BusyError.
class PythonSimulation {
 public:
  /// refuse_fork() was called before the scene was read.
  PythonSimulation(scene::LoadedScene loaded, const DeviceOptions& device,
                   const std::optional<std::filesystem::path>& resume);

  void step(std::int64_t count);
  SnapshotView snapshot();
  py::array positions(const py::object& out);
  py::array velocities(const py::object& out);

  py::array add(const py::object& x, const py::object& v, const py::object& material);
  void remove(const py::object& ids);
  void apply_impulse(const py::object& ids, const py::object& impulses);
  void set_positions(const py::object& ids, const py::object& x, const py::object& v);
  void set_velocities(const py::object& ids, const py::object& v);
  void set_external_forces(const py::object& ids, const py::object& forces);
  void set_force_function(const py::object& function);  ///< None ends it
  const py::object& force_function() const { return force_function_; }
  void drop_force_function() { force_function_ = py::none(); }  ///< without a look at the engine
  void set_material(const std::string& name, const py::kwargs& values);
  void move_collider(const std::string& name, const py::object& position, const py::object& rotation,
                     const py::object& velocity, const py::object& angular_velocity);

  py::object measure();
  py::object ledger();
  py::object contacts();
  py::dict collider_poses();
  std::string state_hash();  ///< 16 hex digits, as in reports
  void write_checkpoint(const std::filesystem::path& file);
  SimulationState state();
  void restore(const SimulationState& state);

  py::array render(std::pair<int, int> size, const std::string& color_by,
                   const std::optional<std::array<double, 2>>& range, int samples, bool legend, bool alpha);
  py::object png();  ///< bytes for notebooks; None where no picture can be drawn
  void run(const RunOptions& options);

  /// Frees the particles; every later use raises ClosedError.
  void close();
  bool is_closed() const { return !opened_; }

  /// For readers; ClosedError, BusyError.
  const Simulation& get() { return use(); }
  const run::OpenedSimulation& opened();
  py::list warnings();

 private:
  // ClosedError, BusyError. The reference is good until Python code runs, which may close the simulation.
  Simulation& use();
  bool is_stepping() const { return stepper_ != std::thread::id(); }
  // Whether another thread is at work; the one that steps may call from the Python code that step() and run() call.
  bool is_busy() const { return working_ || (is_stepping() && stepper_ != std::this_thread::get_id()); }
  template <class Body>
  auto without_gil(const Body& body) {
    const Flag working(working_);
    const py::gil_scoped_release free;
    return body();
  }
  // Calls the engine for a change. Afterwards, a folder that the simulation goes on from is another run's.
  template <class Body>
  auto change(const Body& body) {
    auto done = without_gil(body);
    if (done) resume_.clear();
    return unwrap(std::move(done));
  }
  // Refuses unknown ids before anything is changed.
  std::vector<ParticleAt> find_all(const std::vector<std::uint64_t>& ids);
  void set_particles(const std::vector<ParticleAt>& particles);
  template <class Real>
  py::array column(const py::object& out, bool velocities);
  py::array column(const py::object& out, bool velocities);
  void apply_force_function();
  // Steps between two looks at signals, so that Ctrl-C works soon: about as many as take 0.05 s.
  void step_batch(Simulation& simulation, std::int64_t& left, std::int64_t& batch);

  std::optional<run::OpenedSimulation> opened_;
  std::filesystem::path resume_;  // empty once the simulation was changed
  py::object force_function_ = py::none();
  bool forces_set_ = false;   // by the force function
  bool working_ = false;      // without the GIL
  std::thread::id stepper_;   // the thread in step() or run(), which may call Python; none outside of them
  PictureMaker pictures_;     // goes before the scene that it draws
};

void bind_simulation(py::module_& module);

}  // namespace hooke::python
