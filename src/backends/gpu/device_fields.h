// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hooke/backends/gpu/applied_kernels.h"
#include "hooke/backends/gpu/device.h"
#include "hooke/backends/gpu/particles_view.h"
#include "hooke/core/placed_fields.h"
#include "hooke/core/scene.h"
#include "hooke/passes/cloth_triangles.h"

namespace hooke::gpu {

/// The fields of a scene on a device. Wind on cloths takes two kernels: the force on each triangle, then the sum over
/// each particle's triangles, in their order.
template <class Device, class Real>
class DeviceFields {
  template <class T>
  using DeviceBuffer = Buffer<Device, T>;
  using Feeling = typename FieldView<Real>::Feeling;

 public:
  explicit DeviceFields(Device& device) : device_(&device) {}

  void configure(const Scene& scene) {
    scene_.materials = scene.materials;
    scene_.fields = scene.fields;
    scene_.structure = scene.structure;
    period_ = vec_cast<Real>(scene.domain.period());
    blows_on_sheets_ = false;
    std::vector<Feeling> feels;
    for (const PlacedField<Real>& field : place_fields<Real>(scene_, 0)) {
      blows_on_sheets_ = blows_on_sheets_ || field.blows_on_sheets();
      feels.insert(feels.end(), field.feels, field.feels + scene_.materials.size());
    }
    feels_.hold(feels);
  }

  bool empty() const { return scene_.fields.empty(); }

  /// Finds the corners of cloths among the particles of these ids.
  void bind(const IdTable& ids) {
    triangles_.clear();
    if (!blows_on_sheets_ || !scene_.structure) return;
    triangles_.bind(*scene_.structure, ids);
    corners_.hold(triangles_.all());
    first_triangle_.hold(triangles_.first());
    own_triangles_.hold(triangles_.own());
    on_triangle_.reserve(triangles_.all().size());
  }

  /// There are more id indices now; the new ones belong to no triangle.
  void grow(std::size_t id_indices) {
    if (triangles_.empty()) return;
    triangles_.grow(id_indices);
    first_triangle_.hold(triangles_.first());
  }

  /// Sums the forces at `time` (s) on every particle, N by slot.
  const Vec3<Real>* apply(const ParticlesView<Real>& particles, double time, const StepRunner<Device>& step) {
    force_.reserve(particles.room);
    const std::vector<PlacedField<Real>> fields = place_fields<Real>(scene_, time);
    for (std::size_t k = 0; k < fields.size(); ++k) {
      FieldView<Real> view = fields[k];
      view.feels = feels_.data() + k * scene_.materials.size();
      const bool on_sheets = view.blows_on_sheets() && !triangles_.empty();
      if (on_sheets) {
        step.each(static_cast<std::uint32_t>(triangles_.all().size()),
                  BlowOnTriangles<Real>{view, particles.records, particles.slot_of_id_index, corners_.data(), period_,
                                        on_triangle_.data()});
      }
      step.each(particles.whole_end(),
                PushByField<Real>{view, particles.records, k == 0, on_sheets ? first_triangle_.data() : nullptr,
                                  own_triangles_.data(), on_triangle_.data(), force_.data()});
    }
    return force_.data();
  }

 private:
  Device* device_;
  Scene scene_;  // the parts that fields need
  Vec3<Real> period_{};  // m
  bool blows_on_sheets_ = false;
  ClothTriangles triangles_;  // where wind blows on them
  DeviceBuffer<ClothTriangles::Triangle> corners_{*device_};
  DeviceBuffer<std::uint32_t> first_triangle_{*device_}, own_triangles_{*device_};
  DeviceBuffer<Feeling> feels_{*device_};  // by field and material
  DeviceBuffer<Vec3<Real>> on_triangle_{*device_}, force_{*device_};  // N
};

}  // namespace hooke::gpu
