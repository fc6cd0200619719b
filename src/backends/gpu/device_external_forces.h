// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/backends/gpu/applied_kernels.h"
#include "hooke/backends/gpu/device.h"
#include "hooke/backends/gpu/particles_view.h"
#include "hooke/passes/id_table.h"

namespace hooke::gpu {

/// Forces that the caller gives to particles by their ids, on a device.
template <class Device, class Real>
class DeviceExternalForces {
  template <class T>
  using DeviceBuffer = Buffer<Device, T>;

 public:
  explicit DeviceExternalForces(Device& device) : device_(&device) {}

  bool empty() const { return ids_.empty(); }
  void clear() { ids_.clear(); }

  /// Backend::set_external_forces().
  void set(const IdTable& ids, std::span<const std::uint64_t> of, std::span<const Vec3d> forces) {
    ids_.assign(of.begin(), of.end());
    on_host_.clear();
    for (const Vec3d& force : forces) on_host_.push_back(vec_cast<Real>(force));
    bind(ids);
  }

  /// Finds the particles of these ids; those that are gone are left out.
  void bind(const IdTable& ids) {
    std::vector<std::uint32_t> id_indices;
    std::vector<Vec3<Real>> forces;
    for (std::size_t k = 0; k < ids_.size(); ++k) {
      const std::size_t id_index = ids.find(ids_[k]);
      if (id_index == ids.size()) continue;
      id_indices.push_back(static_cast<std::uint32_t>(id_index));
      forces.push_back(on_host_[k]);
    }
    id_index_.hold(id_indices);
    force_.hold(forces);
    count_ = static_cast<std::uint32_t>(id_indices.size());
  }

  /// N by slot; 0 for particles without a force.
  const Vec3<Real>* apply(const ParticlesView<Real>& particles, const StepRunner<Device>& step) {
    column_.reserve(particles.room);
    column_.fill(0, particles.room);
    slot_.reserve(count_);
    step.each(count_, FindSlots<Real>{particles.records, particles.slot_of_id_index, id_index_.data(), slot_.data()});
    step.each(count_, PutForces<Real>{slot_.data(), force_.data(), column_.data()});
    return column_.data();
  }

 private:
  Device* device_;
  std::vector<std::uint64_t> ids_;
  std::vector<Vec3<Real>> on_host_;  // N, of each
  std::uint32_t count_ = 0;  // on the device
  DeviceBuffer<std::uint32_t> id_index_{*device_}, slot_{*device_};
  DeviceBuffer<Vec3<Real>> force_{*device_}, column_{*device_};
};

}  // namespace hooke::gpu
