// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "snapshot.h"

#include <fmt/format.h>

namespace hooke::python {

py::array SnapshotView::column(const std::vector<Vec3d>& vectors) const {
  constexpr auto kNumber = static_cast<py::ssize_t>(sizeof(double));
  return view(snapshot_, py::dtype::of<double>(), {static_cast<py::ssize_t>(vectors.size()), 3}, {3 * kNumber, kNumber},
              vectors.data());
}

py::array SnapshotView::ids() const {
  const auto& ids = snapshot_->particles.id;
  return view(snapshot_, py::dtype::of<std::uint64_t>(), {static_cast<py::ssize_t>(ids.size())},
              {static_cast<py::ssize_t>(sizeof(std::uint64_t))}, ids.data());
}

py::array SnapshotView::materials() const {
  const auto& materials = snapshot_->particles.material;
  return view(snapshot_, py::dtype::of<std::uint16_t>(), {static_cast<py::ssize_t>(materials.size())},
              {static_cast<py::ssize_t>(sizeof(std::uint16_t))}, materials.data());
}

py::array SnapshotView::positions() const { return column(snapshot_->particles.position); }
py::array SnapshotView::velocities() const { return column(snapshot_->particles.velocity); }

py::object SnapshotView::accelerations() const {
  if (snapshot_->particles.acceleration.size() != snapshot_->particles.size()) return py::none();
  return column(snapshot_->particles.acceleration);
}

py::array SnapshotView::rows_of(const py::object& ids) const {
  std::vector<std::int64_t> rows;
  for (const std::uint64_t id : to_ids(ids)) {
    const std::size_t row = snapshot_->particles.find(id);
    if (row == snapshot_->particles.size()) raise_input(fmt::format("particle {}", id), "there is none of this id");
    rows.push_back(static_cast<std::int64_t>(row));
  }
  return to_array(rows);
}

void bind_snapshot(py::module_& module) {
  py::class_<SnapshotView>(module, "Snapshot",
                           "The particles of one instant, by ascending id. It never changes and stays valid for as\n"
                           "long as it, or one of its arrays, is kept. The arrays are read-only views, not copies.")
      .def_property_readonly("x", &SnapshotView::positions, "Positions, m: float64 of shape (n, 3).")
      .def_property_readonly("v", &SnapshotView::velocities, "Velocities, m/s: float64 of shape (n, 3).")
      .def_property_readonly("a", &SnapshotView::accelerations,
                             "Accelerations of the last step, m/s^2: float64 of shape (n, 3); None unless the\n"
                             "integrator is velocity Verlet, and None for a snapshot of a run folder.")
      .def_property_readonly("id", &SnapshotView::ids, "Ids: uint64 of shape (n,), unique, ascending.")
      .def_property_readonly("material", &SnapshotView::materials,
                             "Indices into the simulation's or the run's `materials`: uint16 of shape (n,).")
      .def_property_readonly(
          "step", [](const SnapshotView& s) { return s.get().step; }, "Steps done.")
      .def_property_readonly(
          "time", [](const SnapshotView& s) { return s.get().time; }, "The simulated time, s.")
      .def("rows", &SnapshotView::rows_of, py::arg("ids"),
           "Row of each id: int64 of shape (n,). InputError where an id is unknown.")
      .def("__len__", [](const SnapshotView& s) { return s.get().particles.size(); })
      .def("__repr__", [](const SnapshotView& s) {
        return fmt::format("<hooke.Snapshot of {} particles at {:.6g} s>", s.get().particles.size(), s.get().time);
      });
}

}  // namespace hooke::python
