// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "hooke/backends/gpu/device.h"
#include "hooke/backends/gpu/population_kernels.h"
#include "hooke/core/placed_colliders.h"
#include "hooke/core/scene.h"
#include "hooke/core/shapes.h"
#include "hooke/passes/pass_rules.h"

namespace hooke::gpu {

/// What kernels read of a scene, in the device's memory: its rules, where colliders are, its sinks.
template <class Device, class Real>
class DeviceScene {
 public:
  explicit DeviceScene(Device& device) : device_(&device) {}

  void configure(const Scene& scene, const PassRules<Real>& rules, double skin) {
    const ForceConstants<Real>& from = rules.constants();
    const std::size_t materials = from.material_count;
    fields_.clear();
    skin_ = skin;
    constants_ = from;
    constants_.pairs = put(pairs_, from.pairs, materials * materials);
    constants_.wall_pairs = put(wall_pairs_, from.wall_pairs, materials);
    constants_.collider_pairs = put(collider_pairs_, from.collider_pairs, materials * scene.colliders.size());
    constants_.materials = put(materials_, from.materials, materials);
    if (from.few != nullptr) constants_.few = put(few_, from.few, 1);
    std::vector<std::uint8_t> interacts;
    std::vector<Real> reach;
    std::vector<double> radius;
    for (std::size_t m = 0; m < materials; ++m) {
      interacts.push_back(rules.interacts(m) ? 1 : 0);
      reach.push_back(static_cast<Real>(rules.interaction_radius(m) + skin / 2));
      radius.push_back(scene.materials[m].radius);
    }
    put(interacts_, interacts.data(), materials);
    put(reach_, reach.data(), materials);
    put(radius_, radius.data(), materials);
    std::vector<DeviceSink> sinks;
    for (const Sink& sink : scene.sinks)
      sinks.push_back({bounds_of(sink.shape), on_device(geometry_of(sink.shape, false, {0, 0, 0}))});
    put(sinks_, sinks.data(), sinks.size());
    sink_count_ = static_cast<std::uint32_t>(sinks.size());
  }

  /// Places the colliders of a pass.
  void place(const PlacedColliders<Real>& colliders) {
    std::vector<PlacedCollider<Real>> all = colliders.all;
    for (PlacedCollider<Real>& collider : all) collider.shape = on_device(collider.shape);
    view_ = colliders.view();
    view_.placed = put(placed_, all.data(), all.size());
    view_.index = put(placed_index_, colliders.of.data(), colliders.of.size());
  }

  const ForceConstants<Real>& constants() const { return constants_; }
  const CollidersView<Real>& colliders() const { return view_; }
  double skin() const { return skin_; }  ///< pairs are listed that are nearer than this from touching, m
  const std::uint8_t* interacts() const { return interacts_.data(); }  ///< by material
  const Real* reach() const { return reach_.data(); }                  ///< by material, half the skin included, m
  const double* radius() const { return radius_.data(); }              ///< by material, m
  const DeviceSink* sinks() const { return sinks_.data(); }
  std::uint32_t sink_count() const { return sink_count_; }

 private:
  template <class T>
  const T* put(Buffer<Device, T>& to, const T* from, std::size_t count) {
    to.hold(from, count);
    return to.data();
  }

  // A mesh's distances lie in the scene, which is kept; a copy of them on the device, made once.
  struct FieldCopy {
    explicit FieldCopy(Device& device) : slots(device), keys(device), samples(device) {}
    Buffer<Device, BrickSlot> slots;
    Buffer<Device, std::uint64_t> keys;
    Buffer<Device, float> samples;
  };
  template <class S>
  ShapeGeometry<S> on_device(ShapeGeometry<S> shape) {
    if (shape.kind != ShapeKind::mesh) return shape;
    DistanceFieldView& field = shape.field;
    std::unique_ptr<FieldCopy>& copy = fields_[field.samples];
    constexpr std::size_t kPerBrick =
        std::size_t{DistanceFieldView::kSamples} * DistanceFieldView::kSamples * DistanceFieldView::kSamples;
    const auto bricks = static_cast<std::size_t>(field.count);
    if (!copy) {
      copy = std::make_unique<FieldCopy>(*device_);
      put(copy->slots, field.slots, std::size_t{1} << (64 - field.hash_shift));
      put(copy->keys, field.keys, bricks);
      put(copy->samples, field.samples, bricks * kPerBrick);
    }
    field.slots = copy->slots.data();
    field.keys = copy->keys.data();
    field.samples = copy->samples.data();
    return shape;
  }

  Device* device_;
  double skin_ = 0;
  ForceConstants<Real> constants_;
  CollidersView<Real> view_;
  Buffer<Device, PairRow<Real>> pairs_{*device_}, wall_pairs_{*device_}, collider_pairs_{*device_};
  Buffer<Device, MaterialRow<Real>> materials_{*device_};
  Buffer<Device, FewMaterials<Real>> few_{*device_};
  Buffer<Device, std::uint8_t> interacts_{*device_};
  Buffer<Device, Real> reach_{*device_};
  Buffer<Device, double> radius_{*device_};
  Buffer<Device, PlacedCollider<Real>> placed_{*device_};
  Buffer<Device, std::uint32_t> placed_index_{*device_};
  Buffer<Device, DeviceSink> sinks_{*device_};
  std::uint32_t sink_count_ = 0;
  std::map<const float*, std::unique_ptr<FieldCopy>> fields_;  // by the samples on the host
};

}  // namespace hooke::gpu
