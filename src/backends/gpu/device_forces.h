// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "hooke/backends/gpu/applied_kernels.h"
#include "hooke/backends/gpu/device.h"
#include "hooke/backends/gpu/device_attraction.h"
#include "hooke/backends/gpu/device_external_forces.h"
#include "hooke/backends/gpu/device_fields.h"
#include "hooke/backends/gpu/device_springs.h"
#include "hooke/backends/gpu/particles_view.h"
#include "hooke/core/scene.h"
#include "hooke/core/sums.h"
#include "hooke/passes/id_table.h"

namespace hooke::gpu {

/// The forces beside those of the pass, in a device's memory: their sum, what each of them does, and pinned particles.
/// A scene without any of this pays nothing.
template <class Device, class Real>
class DeviceForces {
  template <class T>
  using DeviceBuffer = Buffer<Device, T>;

 public:
  explicit DeviceForces(Device& device) : device_(&device) {}

  void configure(const Scene& scene, const RulesView<Real>& rules) {
    structure_ = scene.structure;
    kick_ = scene.integrator == Integrator::velocity_verlet ? scene.time_step / 2 : scene.time_step;
    std::vector<double> mass;
    std::vector<std::uint8_t> fixed;
    any_fixed_ = false;
    for (const Material& m : scene.materials) {
      mass.push_back(m.mass);
      fixed.push_back(m.fixed ? 1 : 0);
      any_fixed_ = any_fixed_ || m.fixed;
    }
    mass_.hold(mass);
    fixed_.hold(fixed);
    springs_.configure(scene, rules);
    fields_.configure(scene);
    attraction_.configure(scene);
    external_.clear();
    windows_ = {};
  }

  DeviceSprings<Device, Real>& springs() { return springs_; }
  const DeviceSprings<Device, Real>& springs() const { return springs_; }
  DeviceAttraction<Device, Real>& attraction() { return attraction_; }
  DeviceExternalForces<Device, Real>& external() { return external_; }

  bool none() const {
    return springs_.empty() && fields_.empty() && attraction_.empty() && external_.empty() && !any_pinned();
  }

  /// After a new layout of all particles: finds the particles of springs and cloths, those that are pinned, and those
  /// that the caller pushes.
  void bind(const IdTable& ids) {
    springs_.bind(ids);
    fields_.bind(ids);
    external_.bind(ids);
    std::vector<std::uint8_t> pinned;
    pinned_by_structure_ = false;
    if (structure_ && !structure_->pinned.empty()) {
      pinned.assign(ids.size(), 0);
      for (const std::uint64_t id : structure_->pinned) {
        const std::size_t id_index = ids.find(id);
        if (id_index == ids.size()) continue;
        pinned[id_index] = 1;
        pinned_by_structure_ = true;
      }
    }
    if (pinned_by_structure_) pinned_.hold(pinned);
    id_count_ = ids.size();
    is_laid_out_ = false;
  }

  /// There are more id indices now; the new ones belong to no spring, no cloth, and are pinned by their material alone.
  void grow(std::size_t id_indices) {
    if (id_indices == id_count_) return;
    springs_.grow(id_indices);
    fields_.grow(id_indices);
    if (pinned_by_structure_) {
      const std::size_t before = id_count_;
      pinned_.grow(id_indices + id_indices / 2, before);
      device_->fill(pinned_.data() + before, 0, pinned_.room() - before);
    }
    id_count_ = id_indices;
  }

  /// Slots have changed: lay_out() is to follow before the next step.
  void invalidate() { is_laid_out_ = false; }
  bool needs_layout() const { return !is_laid_out_ && (!springs_.empty() || any_pinned()); }

  /// After a sort of the particles.
  void lay_out(const ParticlesView<Real>& particles) {
    is_laid_out_ = true;
    mark_pinned(particles);
    springs_.lay_out(particles);
  }

  /// Newborns have been added.
  void mark_pinned(const ParticlesView<Real>& particles) {
    if (!any_pinned()) return;
    const std::uint32_t slices = particles.whole_end() / kLanes;
    pinned_bits_.reserve(particles.room / kSliceLanes + 1);
    device_->each(slices, MarkPinned<Real>{particles.records, fixed_.data(),
                                           pinned_by_structure_ ? pinned_.data() : nullptr, pinned_bits_.data()});
  }

  /// A bit for each particle that is pinned, an entry a slice; null where none is.
  const std::uint16_t* pinned() const { return any_pinned() ? pinned_bits_.data() : nullptr; }

  /// Before the first of several steps, after which they are booked.
  void clear_sums() {
    clear(work_sums_, kSums);
    if (any_pinned()) clear(hold_sums_, HoldSum::count);
  }

  /// Sums all forces at `time` (s) into one column, N by slot; null where nothing acts. `may_tear`: as of the springs.
  const Vec3<Real>* apply(const ParticlesView<Real>& particles, double time, bool may_tear,
                          const StepRunner<Device>& step) {
    applied_.clear();
    if (!springs_.empty()) {
      applied_.push_back(
          {Cause::springs, springs_.apply(particles, may_tear, work_sums(), windows_.dissipation, step)});
    }
    if (!fields_.empty()) applied_.push_back({Cause::field, fields_.apply(particles, time, step)});
    if (!attraction_.empty()) applied_.push_back({Cause::attraction, attraction_.apply(particles, step)});
    if (!external_.empty()) applied_.push_back({Cause::external, external_.apply(particles, step)});
    if (applied_.empty()) return nullptr;
    if (applied_.size() == 1) return applied_.front().force;
    total_.reserve(particles.room);
    for (std::size_t k = 0; k < applied_.size(); ++k)
      step.each(particles.whole_end(), AddForces<Real>{applied_[k].force, total_.data(), k == 0});
    return total_.data();
  }

  /// After the pass: puts pinned particles back, and sums the work of each force. `acceleration` (velocity Verlet, else
  /// null) is that of the coming half kick.
  void finish(const ParticlesView<Real>& particles, ParticleRecord<Real>* after, Vec3<Real>* acceleration,
              const StepRunner<Device>& step) {
    const std::uint32_t end = particles.whole_end();
    if (any_pinned()) {
      step.each(particles.end, HoldStill<Real>{pinned_bits_.data(), particles.records, after, acceleration,
                                               mass_.data(), kick_, hold_sums()});
    }
    for (std::size_t k = 0; k < applied_.size(); ++k) {
      step.each(end, SumWork<Real>{particles.records, after, applied_[k].force, acceleration, static_cast<Real>(kick_),
                                   applied_[k].cause != Cause::springs, particles.end, work_sums(), first_sum(k),
                                   windows_.applied[k]});
    }
  }

  /// Adds what apply() and finish() have summed since clear_sums().
  void book(AppliedSums& to) {
    const std::vector<FixedSum<Real>> sums = read(work_sums_, work_sums());
    const auto take = [&](std::uint32_t sum, SumWindow& window, ExactSum& into) {
      add_fixed(sums[sum], window, into);
      if (sums[sum].largest != 0) window = SumWindow::around(sums[sum].largest);
    };
    take(0, windows_.dissipation, to.springs.dissipation);
    for (std::size_t k = 0; k < applied_.size(); ++k) {
      AppliedSums::Rates& rates = to[applied_[k].cause];
      SumWindow* const windows = windows_.applied[k].of;
      take(first_sum(k) + WorkSum::power, windows[WorkSum::power], rates.power);
      take(first_sum(k) + WorkSum::next_power, windows[WorkSum::next_power], rates.next_power);
      for (int axis = 0; axis < 3; ++axis) {
        take(first_sum(k) + WorkSum::force + static_cast<std::uint32_t>(axis), windows[WorkSum::force + axis],
             rates.force[axis]);
      }
    }
    if (!any_pinned()) return;
    const std::vector<FixedSum<double>> held = read(hold_sums_, hold_sums());
    AppliedSums::Rates& hold = to[Cause::hold];
    add_fixed(held[HoldSum::power], {}, hold.power);
    add_fixed(held[HoldSum::power], {}, hold.next_power);
    for (int axis = 0; axis < 3; ++axis)
      add_fixed(held[static_cast<std::size_t>(HoldSum::force + axis)], {}, hold.force[axis]);
  }

 private:
  struct Applied {
    Cause cause;
    const Vec3<Real>* force;  // N
  };
  static constexpr std::size_t kMostApplied = 4;
  // The dissipation of springs, and what each applied force does; what holding takes.
  static constexpr std::uint32_t kSums = 1 + kMostApplied * WorkSum::count;
  static constexpr std::uint32_t first_sum(std::size_t applied) {
    return 1 + static_cast<std::uint32_t>(applied) * WorkSum::count;
  }
  SumCopies<Real> work_sums() { return {work_sums_.data(), kSums}; }
  SumCopies<double> hold_sums() { return {hold_sums_.data(), HoldSum::count}; }
  struct Windows {
    SumWindow dissipation;
    WorkWindows applied[kMostApplied];
  };

  template <class R>
  static void clear(DeviceBuffer<FixedSum<R>>& sums, std::uint32_t count) {
    sums.reserve(SumCopies<R>::kCopies * count);
    sums.fill(0, SumCopies<R>::kCopies * count);
  }
  // Sums up the copies.
  template <class R>
  std::vector<FixedSum<R>> read(DeviceBuffer<FixedSum<R>>& buffer, const SumCopies<R>& copies) {
    const AddCopies<R> add{copies};
    device_->each(add.items(), add);
    std::vector<FixedSum<R>> sums(copies.count);
    buffer.download(sums.data(), sums.size());
    return sums;
  }

  bool any_pinned() const { return any_fixed_ || pinned_by_structure_; }

  Device* device_;
  std::shared_ptr<const Structure> structure_;
  double kick_ = 0;  // s
  std::size_t id_count_ = 0;
  bool is_laid_out_ = false;
  DeviceSprings<Device, Real> springs_{*device_};
  DeviceFields<Device, Real> fields_{*device_};
  DeviceAttraction<Device, Real> attraction_{*device_};
  DeviceExternalForces<Device, Real> external_{*device_};

  bool any_fixed_ = false, pinned_by_structure_ = false;
  DeviceBuffer<double> mass_{*device_};  // by material, kg
  DeviceBuffer<std::uint8_t> fixed_{*device_};  // by material
  DeviceBuffer<std::uint8_t> pinned_{*device_};  // by id index
  DeviceBuffer<std::uint16_t> pinned_bits_{*device_};  // by slice

  std::vector<Applied> applied_;  // in the order of their sum
  DeviceBuffer<Vec3<Real>> total_{*device_};
  DeviceBuffer<FixedSum<Real>> work_sums_{*device_};
  DeviceBuffer<FixedSum<double>> hold_sums_{*device_};
  Windows windows_;
};

}  // namespace hooke::gpu
