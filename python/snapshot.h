// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "arrays.h"
#include "hooke/core/snapshot.h"

namespace hooke::python {

/// hooke.Snapshot: shares a snapshot, whose columns are numpy arrays without a copy. Each array keeps it alive.
class SnapshotView {
 public:
  explicit SnapshotView(std::shared_ptr<const Snapshot> snapshot) : snapshot_(std::move(snapshot)) {}

  py::array ids() const;
  py::array materials() const;
  py::array positions() const;
  py::array velocities() const;
  py::object accelerations() const;  ///< None where the integrator keeps none
  /// Rows of these ids; InputError where one is unknown.
  py::array rows_of(const py::object& ids) const;

  const Snapshot& get() const { return *snapshot_; }
  const std::shared_ptr<const Snapshot>& shared() const { return snapshot_; }

 private:
  py::array column(const std::vector<Vec3d>& vectors) const;

  std::shared_ptr<const Snapshot> snapshot_;
};

void bind_snapshot(py::module_& module);

}  // namespace hooke::python
