// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "hooke/backends/gpu/device.h"
#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/passes/particle_record.h"
#include "hooke/passes/pass_rules.h"
#include "hooke/physics/contact.h"
#include "hooke/physics/integrate.h"
#include "hooke/physics/wall.h"

namespace hooke::test {

// The scheme of CUDA's sample "particles" (S. Green, "Particle Simulation using CUDA", 2010), to measure Hooke's
// against on the same device: in every step all particles are sorted into the cells of a grid as wide as a diameter,
// and each looks at whoever is in the 27 cells around. One material, spring walls, symplectic Euler, single precision,
// no ledger.

struct SampleGrid {
  Vec3d min{0, 0, 0};
  double inverse = 1;  // 1/m
  std::int32_t cells[3]{1, 1, 1};

  HOOKE_HD std::int32_t index(double x, int axis) const {
    const double at = (x - component(min, axis)) * inverse;
    const std::int32_t last = cells[axis] - 1;
    return at > 0 ? (at < last ? static_cast<std::int32_t>(at) : last) : 0;
  }
  HOOKE_HD std::uint32_t key(std::int32_t x, std::int32_t y, std::int32_t z) const {
    return static_cast<std::uint32_t>((z * cells[1] + y) * cells[0] + x);
  }
  std::uint32_t key_end() const { return static_cast<std::uint32_t>(cells[0] * cells[1] * cells[2]); }
};

struct SampleCount {
  const ParticleRecord<float>* records;
  SampleGrid grid;
  std::uint32_t* key;
  std::uint32_t* place;
  std::uint32_t* count;

  HOOKE_HD void operator()(std::uint32_t i) const {
    const Vec3<float> x = records[i].x;
    key[i] = grid.key(grid.index(x.x, 0), grid.index(x.y, 1), grid.index(x.z, 2));
    place[i] = gpu::add_to(count + key[i], 1);
  }
};

struct SampleMove {
  const ParticleRecord<float>* from;
  const std::uint32_t* key;
  const std::uint32_t* place;
  const std::uint32_t* start;
  ParticleRecord<float>* to;

  HOOKE_HD void operator()(std::uint32_t i) const { to[start[key[i]] + place[i]] = from[i]; }
};

struct SampleStep {
  const ParticleRecord<float>* from;
  const std::uint32_t* start;
  SampleGrid grid;
  RulesView<float> rules;  // of one material
  ContactLaw<float> pair, wall;
  float contact_distance, radius, inverse_mass;
  ParticleRecord<float>* to;

  HOOKE_HD void operator()(std::uint32_t i) const {
    ParticleRecord<float> own = from[i];
    Vec3<float> force{0, 0, 0};
    const std::int32_t at[3] = {grid.index(own.x.x, 0), grid.index(own.x.y, 1), grid.index(own.x.z, 2)};
    for (std::int32_t z = at[2] - 1; z <= at[2] + 1; ++z) {
      for (std::int32_t y = at[1] - 1; y <= at[1] + 1; ++y) {
        for (std::int32_t x = at[0] - 1; x <= at[0] + 1; ++x) {
          if (x < 0 || y < 0 || z < 0 || x >= grid.cells[0] || y >= grid.cells[1] || z >= grid.cells[2]) continue;
          const std::uint32_t key = grid.key(x, y, z);
          for (std::uint32_t p = start[key]; p < start[key + 1]; ++p) {
            if (p != i) add_contact(own, from[p], force);
          }
        }
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      const float x = component(own.x, axis);
      add_wall(own, wall_normal(axis, 1.0F), lower_wall_overlap(x, component(rules.min, axis), radius), force);
      add_wall(own, wall_normal(axis, -1.0F), upper_wall_overlap(x, component(rules.max, axis), radius), force);
    }
    own.v = kick(own.v, inverse_mass * force + rules.gravity, rules.dt);
    own.x = drift(own.x, own.v, rules.dt);
    to[i] = own;
  }

 private:
  HOOKE_HD void add_contact(const ParticleRecord<float>& own, const ParticleRecord<float>& other,
                            Vec3<float>& force) const {
    const Vec3<float> apart = own.x - other.x;
    const float distance2 = dot(apart, apart);
    if (!(distance2 < contact_distance * contact_distance)) return;
    const float distance = sqrt_of(distance2);
    force +=
        contact_forces(contact_distance - distance, (1.0F / distance) * apart, other.v - own.v, pair.linear).total();
  }
  HOOKE_HD void add_wall(const ParticleRecord<float>& own, const Vec3<float>& normal, float overlap,
                         Vec3<float>& force) const {
    if (overlap > 0) force += contact_forces(overlap, normal, -own.v, wall.linear).total();
  }
};

/// The scheme on a device.
template <class Device>
class SampleEngine {
 public:
  SampleEngine(Device device, const Scene& scene, const ParticleSet& particles)
      : device_(std::move(device)),
        rules_(scene) {
    const PairRow<float>&pair = rules_.pair(0, 0), wall = rules_.wall(0);
    step_.rules = rules_.view();
    step_.pair = {{pair.stiffness, pair.shear, pair.damping}, {}};
    step_.wall = {{wall.stiffness, wall.shear, wall.damping}, {}};
    step_.contact_distance = pair.contact_distance;
    step_.radius = wall.contact_distance;
    step_.inverse_mass = rules_.material(0).inverse_mass;
    grid_.min = scene.domain.min;
    grid_.inverse = 1 / static_cast<double>(pair.contact_distance);
    for (int axis = 0; axis < 3; ++axis)
      grid_.cells[axis] = 1 + static_cast<std::int32_t>(scene.domain.length(axis) * grid_.inverse);
    step_.grid = grid_;
    std::vector<ParticleRecord<float>> records;
    for (std::size_t k = 0; k < particles.size(); ++k) {
      records.push_back({vec_cast<float>(particles.position[k]), 0.0F, vec_cast<float>(particles.velocity[k]),
                         sort_key<float>(static_cast<std::uint32_t>(k))});
    }
    count_ = static_cast<std::uint32_t>(records.size());
    for (auto* buffer : {&records_, &sorted_}) buffer->reserve(count_);
    for (auto* buffer : {&key_, &place_}) buffer->reserve(count_);
    start_.reserve(grid_.key_end() + 1);
    records_.upload(records.data(), count_);
  }

  void step() {
    start_.fill(0, grid_.key_end() + 1);
    device_.each(count_, SampleCount{records_.data(), grid_, key_.data(), place_.data(), start_.data()});
    device_.scan(start_.data(), grid_.key_end() + 1);
    device_.each(count_, SampleMove{records_.data(), key_.data(), place_.data(), start_.data(), sorted_.data()});
    SampleStep kernel = step_;
    kernel.from = sorted_.data();
    kernel.start = start_.data();
    kernel.to = records_.data();
    device_.each(count_, kernel);
  }

  /// By index of the particles at the start. Waits for all steps.
  std::vector<ParticleRecord<float>> state() {
    std::vector<ParticleRecord<float>> all(count_), by_index(count_);
    records_.download(all.data(), count_);
    for (const ParticleRecord<float>& p : all) by_index[id_index_of(p.id_index)] = p;
    return by_index;
  }

 private:
  Device device_;
  PassRules<float> rules_;
  SampleGrid grid_;
  SampleStep step_{};
  std::uint32_t count_ = 0;
  gpu::Buffer<Device, ParticleRecord<float>> records_{device_}, sorted_{device_};
  gpu::Buffer<Device, std::uint32_t> key_{device_}, place_{device_}, start_{device_};
};

}  // namespace hooke::test
