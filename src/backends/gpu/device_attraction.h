// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hooke/backends/gpu/applied_kernels.h"
#include "hooke/backends/gpu/device.h"
#include "hooke/backends/gpu/particles_view.h"
#include "hooke/base/exact_sum.h"
#include "hooke/core/attraction.h"
#include "hooke/core/scene.h"

namespace hooke::gpu {

/// The attraction of a scene on a device, summed directly.
template <class Device, class Real>
class DeviceAttraction {
  template <class T>
  using DeviceBuffer = Buffer<Device, T>;

 public:
  explicit DeviceAttraction(Device& device) : device_(&device) {}

  void configure(const Scene& scene) {
    attracts_ = scene.attraction.has_value();
    if (!attracts_) return;
    exact_ = scene.attraction->exact;
    units_ = attraction_units(scene);
    softening2_ = softening_squared(scene) / (units_.length * units_.length);
    const double per_unit = units_.mass / (units_.length * units_.length);
    std::vector<Real> mass, force_of;
    weight_.clear();
    for (const Material& m : scene.materials) {
      mass.push_back(static_cast<Real>(m.mass / units_.mass));
      weight_.push_back(m.mass * scene.attraction->constant);
      force_of.push_back(static_cast<Real>(weight_.back() * per_unit));
    }
    mass_.hold(mass);
    force_of_.hold(force_of);
  }

  bool empty() const { return !attracts_; }

  /// Sums the forces on every particle, N by slot.
  const Vec3<Real>* apply(const ParticlesView<Real>& particles, const StepRunner<Device>& step) {
    gather_sources(particles);
    force_.reserve(particles.room);
    const auto run = [&](auto math) {
      step.each(particles.whole_end(),
                PullDirectly<Real, decltype(math)>{particles.records, sources_.data(), block_.data(), particles.count,
                                                   force_of_.data(), inverse_length(), static_cast<Real>(softening2_),
                                                   force_.data()});
    };
    exact_ ? run(ExactMath{}) : run(FastMath{});
    return force_.data();
  }

  /// The energy of all particles in the attraction of the others, J.
  double energy(const ParticlesView<Real>& particles, const std::vector<ParticleRecord<Real>>& records) {
    gather_sources(particles);
    potential_.reserve(particles.room);
    device_->each(particles.end,
                  PotentialDirectly<Real>{particles.records, sources_.data(), block_.data(), particles.count,
                                          inverse_length(), static_cast<Real>(softening2_), potential_.data()});
    std::vector<Real> potential(particles.end);
    potential_.download(potential.data(), particles.end);
    const double per_unit = units_.mass / units_.length;
    ExactSum sum;
    for (std::size_t i = 0; i < particles.end; ++i) {
      if (is_vacant(records[i])) continue;
      const double weight = weight_[static_cast<std::size_t>(records[i].material)];
      sum.add(0.5 * (weight * per_unit) * static_cast<double>(potential[i]));
    }
    return sum.value();
  }

 private:
  Real inverse_length() const { return static_cast<Real>(1 / units_.length); }

  // Puts all particles in order of their ids.
  void gather_sources(const ParticlesView<Real>& particles) {
    rank_.reserve(particles.id_count + 1);
    rank_.fill(0, particles.id_count + 1);
    device_->each(particles.id_count, MarkPresent<Real>{particles.records, particles.slot_of_id_index, rank_.data()});
    device_->scan(rank_.data(), particles.id_count + 1);
    sources_.reserve(particles.count);
    block_.reserve(particles.count);
    device_->each(particles.id_count,
                  GatherSources<Real>{particles.records, particles.slot_of_id_index, rank_.data(), particles.ids,
                                      mass_.data(), inverse_length(), sources_.data(), block_.data()});
  }

  Device* device_;
  bool attracts_ = false, exact_ = true;
  AttractionUnits units_;
  double softening2_ = 0;  // in units
  std::vector<double> weight_;  // by material: mass times G
  DeviceBuffer<Real> mass_{*device_}, force_of_{*device_};  // by material: in units, and N per unit
  DeviceBuffer<std::uint32_t> rank_{*device_};
  DeviceBuffer<PullSource<Real>> sources_{*device_};
  DeviceBuffer<std::uint64_t> block_{*device_};  // of each source
  DeviceBuffer<Vec3<Real>> force_{*device_};
  DeviceBuffer<Real> potential_{*device_};
};

}  // namespace hooke::gpu
