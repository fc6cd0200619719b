// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hooke/backends/gpu/applied_kernels.h"
#include "hooke/backends/gpu/device.h"
#include "hooke/backends/gpu/particles_view.h"
#include "hooke/core/scene.h"
#include "hooke/passes/spring_table.h"

namespace hooke::gpu {

/// The springs of a scene in a device's memory: in rows like a neighbour list's, a particle a lane.
template <class Device, class Real>
class DeviceSprings {
  template <class T>
  using DeviceBuffer = Buffer<Device, T>;

 public:
  explicit DeviceSprings(Device& device) : device_(&device) {}

  void configure(const Scene& scene, const RulesView<Real>& rules) {
    pass_.length = rules.length;
    pass_.any_periodic = false;
    for (int axis = 0; axis < 3; ++axis) {
      pass_.periodic[axis] = rules.periodic[axis];
      pass_.any_periodic = pass_.any_periodic || rules.periodic[axis];
    }
    table_.configure(scene.structure, rules.period);
  }

  bool empty() const { return table_.empty(); }
  SpringTable<Real>& table() { return table_; }
  const SpringTable<Real>& table() const { return table_; }

  /// Finds the springs' ends among the particles of these ids.
  void bind(const IdTable& ids) {
    if (empty()) return;
    table_.bind(ids);
    kinds_.hold(table_.kinds());
    kind_.hold(table_.kind());
    rest_length_.hold(table_.rest_length());
    broken_.hold(table_.broken());
    first_side_.hold(table_.first_side());
    sides_.hold(table_.sides());
    hold_exclusions();
  }

  /// There are more id indices now; no spring ties the new ones.
  void grow(std::size_t id_indices) {
    if (empty()) return;
    table_.grow(id_indices);
    first_side_.hold(table_.first_side());
    first_excluded_.hold(table_.exclusions().first());
  }

  /// After a sort of the particles.
  void lay_out(const ParticlesView<Real>& particles) {
    if (empty()) return;
    // Of the whole room: newborns come behind, and have no rows.
    const std::uint32_t slices = particles.room / kLanes;
    first_row_.reserve(slices + 1);
    first_row_.fill(0, slices + 1);
    device_->each(particles.end, CountSpringRows<Real>{particles.records, view(), first_row_.data()});
    device_->scan(first_row_.data(), slices + 1);
    std::uint32_t rows = 0;
    first_row_.download(&rows, 1, slices);
    rows_.reserve(rows);
    device_->each(particles.whole_end(),
                  FillSpringRows<Real>{particles.records, view(), first_row_.data(), particles.slot_of_id_index,
                                       rows_.data(), particles.filler(), particles.end});
  }

  /// Pairs that springs keep apart.
  ExcludedPairs excluded() const {
    if (table_.exclusions().empty()) return {};
    return {first_excluded_.data(), excluded_.data()};
  }

  /// Sums the forces on every particle, N by slot, and the dissipation, into the first of `sums`. With `may_tear`,
  /// springs that are stretched too far break, and are counted in DeviceReport::torn (take_torn()).
  const Vec3<Real>* apply(const ParticlesView<Real>& particles, bool may_tear, const SumCopies<Real>& sums,
                          const SumWindow& window, const StepRunner<Device>& step) {
    force_.reserve(particles.room);
    power_.reserve(particles.room);
    torn_.reserve(table_.size());
    pass_.records = particles.records;
    pass_.kinds = kinds_.data();
    pass_.force = force_.data();
    pass_.may_tear = may_tear && table_.is_tearable();
    step.each(particles.whole_end(), PullBySprings<Real>{pass_, rows_.data(), first_row_.data(), power_.data(), sums,
                                                         window, view(), step.report(), torn_.data()});
    return force_.data();
  }

  /// The springs that tore in apply(), of which the device has reported `count`. From now on they are broken, and their
  /// ends may touch; `changed` becomes true where that takes a new list.
  std::vector<TornSpring> take_torn(std::uint32_t count, bool& changed) {
    std::vector<TornSpring> torn(count);
    torn_.download(torn.data(), count);
    bool released = false;
    for (const TornSpring& spring : torn) released = table_.tear(spring.spring, spring.a, spring.b) || released;
    if (released) hold_exclusions();
    changed = changed || released;
    return torn;
  }

 private:
  SpringsView<Real> view() {
    return {first_side_.data(), sides_.data(), kind_.data(), rest_length_.data(), broken_.data()};
  }
  void hold_exclusions() {
    first_excluded_.hold(table_.exclusions().first());
    excluded_.hold(table_.exclusions().partners());
  }

  Device* device_;
  SpringTable<Real> table_;
  SpringPass<Real> pass_;
  DeviceBuffer<SpringKind<Real>> kinds_{*device_};
  DeviceBuffer<std::uint32_t> kind_{*device_}, first_side_{*device_}, first_excluded_{*device_}, excluded_{*device_};
  DeviceBuffer<Real> rest_length_{*device_}, power_{*device_};
  DeviceBuffer<std::uint8_t> broken_{*device_};
  DeviceBuffer<SpringSide> sides_{*device_};
  DeviceBuffer<std::uint32_t> first_row_{*device_};  // of each slice
  DeviceBuffer<SpringRow<Real>> rows_{*device_};
  DeviceBuffer<Vec3<Real>> force_{*device_};  // N, by slot
  DeviceBuffer<TornSpring> torn_{*device_};
};

}  // namespace hooke::gpu
