// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "simulation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <string_view>

#include "hooke/io/checkpoint.h"
#include "hooke/run/numbers.h"
#include "hooke/run/start_checks.h"
#include "process_check.h"

namespace hooke::python {
namespace {

constexpr double kBatchSeconds = 0.05;

}  // namespace

PythonSimulation::PythonSimulation(scene::LoadedScene loaded, const DeviceOptions& device,
                                   const std::optional<std::filesystem::path>& resume) {
  constexpr std::string_view kDevices[] = {"cpu", "cuda", "auto", "reference"};
  if (std::find(std::begin(kDevices), std::end(kDevices), device.device) == std::end(kDevices)) {
    raise_input("device",
                fmt::format("\"{}\" is not known; known are \"{}\"", device.device, fmt::join(kDevices, "\", \"")));
  }
  if (resume) resume_ = *resume;
  auto opened =
      without_gil([&] { return run::open_simulation(std::move(loaded), {device.device, device.threads}, resume_); });
  opened_.emplace(unwrap(std::move(opened), ErrorClass::scene));
}

Simulation& PythonSimulation::use() {
  if (!opened_) raise(ErrorClass::closed, {{"simulation", "is closed"}});
  refuse_fork();  // another thread of the parent may have been at work
  if (is_busy()) raise(ErrorClass::busy, {{"simulation", "is at work in another thread"}});
  return opened_->simulation;
}

const run::OpenedSimulation& PythonSimulation::opened() {
  use();
  return *opened_;
}

void PythonSimulation::close() {
  if (!opened_) return;
  use();
  if (is_stepping()) raise(ErrorClass::busy, {{"simulation", "can't be closed while it steps"}});
  pictures_.close();
  opened_.reset();
  drop_force_function();
}

void PythonSimulation::step(std::int64_t count) {
  Simulation& simulation = use();
  if (count < 0) raise_input("count", fmt::format("{} steps; 0 or more are possible", count));
  if (is_stepping())
    raise(ErrorClass::busy, {{"simulation", "is in a step already: external_forces must not step it"}});
  const ThreadMark stepping(stepper_);
  std::int64_t left = count, batch = 1;
  do {
    step_batch(simulation, left, batch);
    if (left > 0 && PyErr_CheckSignals() != 0) throw py::error_already_set();
  } while (left > 0);
}

void PythonSimulation::step_batch(Simulation& simulation, std::int64_t& left, std::int64_t& batch) {
  const bool has_forces = !force_function_.is_none();
  if (has_forces && left > 0) apply_force_function();
  const std::int64_t now = std::min(left, has_forces ? std::int64_t{1} : batch);
  const auto start = std::chrono::steady_clock::now();
  if (now > 0) resume_.clear();
  auto taken = without_gil([&] { return simulation.step(now); });
  if (now > 0 && !has_forces) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    batch = run::next_batch(now, seconds, kBatchSeconds);
  }
  unwrap(std::move(taken));
  left -= now;
}

void PythonSimulation::apply_force_function() {
  const SnapshotView now = snapshot();
  const ParticleSet& particles = now.get().particles;
  const py::object function = force_function_;
  const py::object value = function(py::cast(now));
  if (!force_function_.is(function)) return;  // it has ended itself, or named another for the steps to come
  const std::vector<Vec3d> forces = to_vectors(value, particles.size(), "external_forces");
  Simulation& simulation = use();
  change([&] { return simulation.set_external_forces(particles.id, forces); });
  forces_set_ = true;
}

void PythonSimulation::set_force_function(const py::object& function) {
  Simulation& simulation = use();
  if (!function.is_none() && PyCallable_Check(function.ptr()) == 0) {
    raise_input("external_forces",
                fmt::format("expected a function of a snapshot, or None, got {}", Py_TYPE(function.ptr())->tp_name));
  }
  if (forces_set_) change([&] { return simulation.set_external_forces({}, {}); });
  forces_set_ = false;
  force_function_ = function;
}

SnapshotView PythonSimulation::snapshot() {
  Simulation& simulation = use();
  return SnapshotView(without_gil([&] { return simulation.snapshot(); }));
}

template <class Real>
py::array PythonSimulation::column(const py::object& out, bool velocities) {
  Simulation& simulation = use();
  const auto count = static_cast<py::ssize_t>(simulation.particle_count());
  py::array_t<Real> array;
  if (out.is_none()) {
    array = py::array_t<Real>({count, py::ssize_t{3}});
  } else {
    array = py::reinterpret_borrow<py::array_t<Real>>(out);
    const bool fits = array.ndim() == 2 && array.shape(0) == count && array.shape(1) == 3;
    constexpr int kPlain = int{py::array::c_style} | int{py::detail::npy_api::NPY_ARRAY_ALIGNED_};
    if (!fits || (array.flags() & kPlain) != kPlain || !array.writeable()) {
      raise_input("out", fmt::format("expected a writeable, aligned array of shape ({}, 3) in C order", count));
    }
  }
  static_assert(sizeof(Vec3<Real>) == 3 * sizeof(Real));
  auto* const data = reinterpret_cast<Vec3<Real>*>(array.mutable_data());
  ParticleColumns<Real> columns;
  (velocities ? columns.velocity : columns.position) = data;
  unwrap(without_gil([&] { return simulation.copy_particles(columns); }));
  return array;
}

py::array PythonSimulation::column(const py::object& out, bool velocities) {
  if (out.is_none()) {
    const bool single = use().backend_info().precision == Precision::single_precision;
    return single ? column<float>(out, velocities) : column<double>(out, velocities);
  }
  if (py::isinstance<py::array_t<float>>(out)) return column<float>(out, velocities);
  if (py::isinstance<py::array_t<double>>(out)) return column<double>(out, velocities);
  raise_input("out", "expected a numpy array of float32 or float64");
}

py::array PythonSimulation::positions(const py::object& out) { return column(out, false); }
py::array PythonSimulation::velocities(const py::object& out) { return column(out, true); }

std::string PythonSimulation::state_hash() {
  Simulation& simulation = use();
  return fmt::format("{:016x}", without_gil([&] { return simulation.state_hash(); }));
}

void PythonSimulation::write_checkpoint(const std::filesystem::path& file) {
  Simulation& simulation = use();
  unwrap(without_gil([&] { return io::write_checkpoint(file, simulation.state(), io::describe_run(simulation)); }));
}

SimulationState PythonSimulation::state() {
  Simulation& simulation = use();
  return without_gil([&] { return simulation.state(); });
}

void PythonSimulation::restore(const SimulationState& state) {
  Simulation& simulation = use();
  if (is_stepping()) raise(ErrorClass::busy, {{"simulation", "can't be restored while it steps"}});
  change([&] { return simulation.restore(state); });
}

py::list PythonSimulation::warnings() {
  const Simulation& simulation = use();
  std::vector<Finding> findings = opened_->warnings;
  without_gil([&] {
    for (Finding& finding : run::deep_starts(simulation)) findings.push_back(std::move(finding));
    for (std::string sentence : {run::unstable_step(simulation), run::coarse_positions(simulation)}) {
      if (!sentence.empty()) findings.push_back({"", std::move(sentence)});
    }
  });
  return to_list(findings);
}

}  // namespace hooke::python
