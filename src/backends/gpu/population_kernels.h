// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "hooke/backends/gpu/device_report.h"
#include "hooke/backends/gpu/list_kernels.h"
#include "hooke/base/box3.h"
#include "hooke/core/backend.h"
#include "hooke/core/state_hash.h"
#include "hooke/passes/particle_record.h"
#include "hooke/physics/enclosure.h"

namespace hooke::gpu {

/// A particle as it is found by its id index; slot kNoSlot where there is none.
template <class Real>
struct FoundParticle {
  ParticleRecord<Real> record;
  Vec3<Real> acceleration;
  std::uint32_t slot;
  std::uint32_t rows;  // of its slice in the list; 0 for particles that touch no others
};

/// Finds particles by their id indices.
template <class Real>
struct FindParticles {
  const ParticleRecord<Real>* records;
  const Vec3<Real>* acceleration;  // null without
  const std::uint32_t* slot_of_id_index;
  const std::uint32_t* first_row;  // null where there is no list
  std::uint32_t listed;
  const std::uint32_t* id_index;
  FoundParticle<Real>* found;

  HOOKE_HD void operator()(std::uint32_t k) const {
    FoundParticle<Real> particle{vacant_record<Real>(Real(0)), {Real(0), Real(0), Real(0)}, kNoSlot, 0};
    const std::uint32_t slot = slot_of(records, slot_of_id_index, id_index[k]);
    if (slot != kNoSlot) {
      particle.slot = slot;
      particle.record = records[slot];
      if (acceleration != nullptr) particle.acceleration = acceleration[slot];
      if (first_row != nullptr && slot < listed)
        particle.rows = first_row[slot / kLanes + 1] - first_row[slot / kLanes];
    }
    found[k] = particle;
  }
};

/// A neighbour in a row, and where it lies.
template <class Real>
struct RowEntry {
  ParticleRecord<Real> record;
  std::uint32_t slot;
};

/// Copies the rows of particles, those of particle k to `first[k]` and on.
template <class Real>
struct CopyRows {
  const ParticleRecord<Real>* records;
  const std::uint32_t* first_row;
  const std::uint32_t* entries;
  const std::uint32_t* slot;   // of the particles
  const std::uint32_t* first;  // one more than particles
  RowEntry<Real>* rows;

  HOOKE_HD void operator()(std::uint32_t k) const {
    const std::uint32_t* const lane =
        entries + std::size_t{first_row[slot[k] / kLanes]} * kSliceLanes + slot[k] % kLanes;
    for (std::uint32_t at = first[k]; at < first[k + 1]; ++at) {
      const std::uint32_t neighbour = lane[std::size_t{at - first[k]} * kSliceLanes] / record_offset<Real>(1);
      rows[at] = {records[neighbour], neighbour};
    }
  }
};

/// Notes where particles lie after they have been put into slots `first` and on.
template <class Real>
struct IndexSlots {
  const ParticleRecord<Real>* records;
  std::uint32_t first;
  std::uint32_t* slot_of_id_index;

  HOOKE_HD void operator()(std::uint32_t k) const {
    slot_of_id_index[id_index_of(records[first + k].id_index)] = first + k;
  }
};

/// Replaces records.
template <class Real>
struct PutRecords {
  ParticleRecord<Real>* records;
  const std::uint32_t* slot;
  const ParticleRecord<Real>* from;

  HOOKE_HD void operator()(std::uint32_t k) const { records[slot[k]] = from[k]; }
};

/// Marks the id indices that have a particle.
template <class Real>
struct MarkPresent {
  const ParticleRecord<Real>* records;
  const std::uint32_t* slot_of_id_index;
  std::uint32_t* present;

  HOOKE_HD void operator()(std::uint32_t id_index) const {
    present[id_index] = slot_of(records, slot_of_id_index, id_index) != kNoSlot ? 1 : 0;
  }
};

/// The columns of particles in ascending order of id that a host asks for; null where one is not wanted.
template <class Real, class Out>
struct CopyColumns {
  const ParticleRecord<Real>* records;
  const Vec3<Real>* acceleration_from;
  const std::uint32_t* slot_of_id_index;
  const std::uint32_t* rank;  // of each id index among those that have a particle, and one more
  const std::uint64_t* ids;   // by id index
  std::uint64_t* id;
  std::uint16_t* material;
  Vec3<Out>* position;
  Vec3<Out>* velocity;
  Vec3<Out>* acceleration;

  HOOKE_HD void operator()(std::uint32_t id_index) const {
    const std::uint32_t k = rank[id_index];
    if (rank[id_index + 1] == k) return;
    const std::uint32_t slot = slot_of_id_index[id_index];
    const ParticleRecord<Real> p = records[slot];
    if (id != nullptr) id[k] = ids[id_index];
    if (material != nullptr) material[k] = static_cast<std::uint16_t>(p.material);
    if (position != nullptr) position[k] = vec_cast<Out>(p.x);
    if (velocity != nullptr) velocity[k] = vec_cast<Out>(p.v);
    if (acceleration != nullptr) acceleration[k] = vec_cast<Out>(acceleration_from[slot]);
  }
};

/// The state hash, in parts that add up to it.
template <class Real>
struct HashParticles {
  static constexpr std::uint32_t kParts = 256;

  const ParticleRecord<Real>* records;
  const std::uint64_t* ids;  // by id index
  unsigned long long* parts;

  HOOKE_HD void operator()(std::uint32_t i) const {
    const ParticleRecord<Real> p = records[i];
    if (!is_vacant(p)) add_to(parts + i % kParts, particle_hash(ids[id_index_of(p.id_index)], p.x, p.v));
  }
};

/// Finds the particles that touch others in a box. Counts all, and keeps as many as there is room for.
template <class Real>
struct FindInside {
  const ParticleRecord<Real>* records;
  const std::uint8_t* interacts;  // by material
  const double* radius;           // likewise, m
  Box3d box;
  Occupant* found;
  std::uint32_t room;
  DeviceReport* report;

  HOOKE_HD void operator()(std::uint32_t i) const {
    const ParticleRecord<Real> p = records[i];
    const Vec3d x = vec_cast<double>(p.x);
    const auto material = static_cast<std::size_t>(p.material);
    if (is_vacant(p) || interacts[material] == 0 || !box.contains(x)) return;
    const std::uint32_t at = add_to(&report->found, 1);
    if (at < room) found[at] = {x, radius[material]};
  }
};

/// A sink, with a box around it.
struct DeviceSink {
  Box3d box;
  ShapeGeometry<double> shape;
};

/// Notes the particles whose centres are inside of sinks.
template <class Real>
struct FindSunk {
  const ParticleRecord<Real>* records;
  const DeviceSink* sinks;
  std::uint32_t count;
  std::uint32_t* departed;  // id indices
  DeviceReport* report;

  HOOKE_HD void operator()(std::uint32_t i) const {
    const ParticleRecord<Real> p = records[i];
    if (is_vacant(p)) return;
    const Vec3d x = vec_cast<double>(p.x);
    for (std::uint32_t k = 0; k < count; ++k) {
      if (!sinks[k].box.contains(x) || !encloses(sinks[k].shape, x)) continue;
      departed[add_to(&report->departed, 1)] = id_index_of(p.id_index);
      return;
    }
  }
};

}  // namespace hooke::gpu
