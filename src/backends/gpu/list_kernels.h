// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "hooke/backends/gpu/brick_grid.h"
#include "hooke/backends/gpu/device.h"
#include "hooke/backends/gpu/device_report.h"
#include "hooke/backends/gpu/warp.h"
#include "hooke/neighbours/layout.h"
#include "hooke/neighbours/row_network.h"
#include "hooke/passes/force_pass.h"
#include "hooke/passes/particle_record.h"
#include "hooke/physics/periodic.h"

namespace hooke::gpu {

// A new list: particles are sorted into the cells of the grid, then each one's neighbours are listed in rows of 16
// lanes, in ascending order of id index. Slots after a sort: particles that touch others, then those that touch none.

inline constexpr std::uint32_t kNoSlot = ~std::uint32_t{0};

/// The slot of an id index's particle; kNoSlot where it has none. What is noted may be of a particle that is gone.
template <class Real>
HOOKE_HD std::uint32_t slot_of(const ParticleRecord<Real>* records, const std::uint32_t* slot_of_id_index,
                               std::uint32_t id_index) {
  const std::uint32_t slot = slot_of_id_index[id_index];
  const bool there = slot != kNoSlot && !is_vacant(records[slot]) && id_index_of(records[slot].id_index) == id_index;
  return there ? slot : kNoSlot;
}

/// Numbers the cell of each particle, and counts its particles. Those that touch none are in one more cell, at the end.
template <class Real>
struct NumberCells {
  static constexpr std::uint32_t kVacant = ~std::uint32_t{0};

  const ParticleRecord<Real>* records;
  BrickGrid grid;
  const std::uint8_t* interacts;  // by material
  std::uint32_t* key;
  std::uint32_t* place;  // in its cell, in no order
  std::uint32_t* count;  // by cell
  DeviceReport* report;

  HOOKE_HD void operator()(std::uint32_t i) const {
    const ParticleRecord<Real> p = records[i];
    if (is_vacant(p)) {
      key[i] = kVacant;
      return;
    }
    std::uint32_t cell = grid.key_end();
    if (interacts[static_cast<std::size_t>(p.material)] != 0) {
      for (int axis = 0; axis < 3; ++axis) {
        const Real x = component(p.x, axis);
        if (!(x < static_cast<Real>(kFurthest) && x > static_cast<Real>(-kFurthest)))
          raise_to(&report->lost, ~id_index_of(p.id_index));
      }
      cell = grid.key(grid.index(p.x.x, 0), grid.index(p.x.y, 1), grid.index(p.x.z, 2));
    }
    key[i] = cell;
    place[i] = add_to(count + cell, 1);
  }
};

/// Moves the particles to the slots of their cells.
template <class Real>
struct PutInPlace {
  const ParticleRecord<Real>* from;
  const Vec3<Real>* acceleration_from;  // null without
  const std::uint32_t* key;
  const std::uint32_t* place;
  const std::uint32_t* start;  // of each cell
  ParticleRecord<Real>* to;
  Vec3<Real>* acceleration_to;
  Vec3<Real>* position_at_build;
  std::uint32_t* slot_of_id_index;

  HOOKE_HD void operator()(std::uint32_t i) const {
    if (key[i] == NumberCells<Real>::kVacant) return;
    const ParticleRecord<Real> p = from[i];
    const std::uint32_t slot = start[key[i]] + place[i];
    to[slot] = p;
    if (acceleration_from != nullptr) acceleration_to[slot] = acceleration_from[i];
    position_at_build[slot] = p.x;
    slot_of_id_index[id_index_of(p.id_index)] = slot;
  }
};

/// Fills slots `first` and on of both buffers with vacant records.
template <class Real>
struct Vacate {
  ParticleRecord<Real>* records;
  ParticleRecord<Real>* next;
  std::uint32_t first;

  HOOKE_HD void operator()(std::uint32_t i) const {
    records[first + i] = next[first + i] = vacant_record<Real>(Real(0));
  }
};

/// Pairs that springs keep apart, by id index: partners `first[i]` and on of id index i.
struct ExcludedPairs {
  const std::uint32_t* first = nullptr;  // null: none
  const std::uint32_t* partners = nullptr;

  HOOKE_HD bool hold(std::uint32_t a, std::uint32_t b) const {
    if (first == nullptr) return false;
    for (std::uint32_t k = first[a]; k < first[a + 1]; ++k) {
      if (partners[k] == b) return true;
    }
    return false;
  }
};

/// Finds the neighbours of a particle among those that touch others.
template <class Real>
struct Search {
  const ParticleRecord<Real>* records;
  BrickGrid grid;
  const std::uint32_t* start;  // of each cell
  const Real* reach_of;  // by material: half the skin, and what the radius needs, m
  Vec3<Real> period;  // m, of periodic axes, else 0
  bool list_self;  // whether a particle may touch its own image
  ExcludedPairs excluded;

  /// visit(p) for every neighbour of particle i, in no order.
  template <class Visit>
  HOOKE_HD void run(std::uint32_t i, const Visit& visit) const {
    const ParticleRecord<Real> own = records[i];
    const BrickGrid::Beside x = grid.beside(grid.index(own.x.x, 0), 0), y = grid.beside(grid.index(own.x.y, 1), 1),
                            z = grid.beside(grid.index(own.x.z, 2), 2);
    for (int c = 0; c < z.count; ++c) {
      for (int b = 0; b < y.count; ++b) {
        for (int a = 0; a < x.count;) {
          // Cells of one brick along x follow each other in the table.
          const std::uint32_t from = x.of[a];
          std::uint32_t to = from;
          for (++a; a < x.count && x.of[a] == to + 1 && x.of[a] % BrickGrid::kX != 0; ++a) to = x.of[a];
          const std::uint32_t key = grid.key(from, y.of[b], z.of[c]);
          const std::uint32_t end = start[key + (to - from) + 1];
          for (std::uint32_t p = start[key]; p < end; ++p) {
            if (!is_near(own, i, p)) continue;
            if (grid.hashed && !is_in(p, from, to, y.of[b], z.of[c])) continue;
            if (excluded.hold(id_index_of(own.id_index), id_index_of(records[p].id_index))) continue;
            visit(p);
          }
        }
      }
    }
  }

 private:
  HOOKE_HD bool is_near(const ParticleRecord<Real>& own, std::uint32_t i, std::uint32_t p) const {
    struct alignas(16) Place {
      Real x, y, z, material;
    };
    const Place at = *reinterpret_cast<const Place*>(records + p);
    const Vec3<Real> apart = nearest_displacement(own.x, Vec3<Real>{at.x, at.y, at.z}, period);
    const Real reach =
        reach_of[static_cast<std::size_t>(own.material)] + reach_of[static_cast<std::size_t>(at.material)];
    return dot(apart, apart) < reach * reach && (p != i || list_self);
  }
  // Whether p is in these cells and not in others that share their places in the table.
  HOOKE_HD bool is_in(std::uint32_t p, std::uint32_t from, std::uint32_t to, std::uint32_t y, std::uint32_t z) const {
    const Vec3<Real> at = records[p].x;
    const std::uint32_t x = grid.index(at.x, 0);
    return x >= from && x <= to && grid.index(at.y, 1) == y && grid.index(at.z, 2) == z;
  }
};

/// Counts the rows that each slice needs.
template <class Real>
struct CountRows {
  Search<Real> search;
  std::uint32_t* rows;  // by slice

  HOOKE_HD void operator()(std::uint32_t i) const {
    std::uint32_t count = 0;
    search.run(i, [&](std::uint32_t) { ++count; });
    raise_to(rows + i / kLanes, count);
  }
};

/// Lists each particle's neighbours in its lane, in ascending order of id index.
template <class Real>
struct FillRows {
  Search<Real> search;
  const std::uint32_t* first_row;  // of each slice
  const std::uint32_t* slot_of_id_index;
  std::uint32_t* entries;
  std::uint32_t filler;  // entry of short lanes
  std::uint32_t listed;  // particles

  HOOKE_HD void operator()(std::uint32_t i) const {
    const std::uint32_t g = i / kLanes, rows = first_row[g + 1] - first_row[g];
    std::uint32_t* const lane = entries + std::size_t{first_row[g]} * kSliceLanes + i % kLanes;
    std::uint32_t count = 0;
    if (i < listed) {
      search.run(i, [&](std::uint32_t p) { lane[count++ * kSliceLanes] = id_index_of(search.records[p].id_index); });
    }
    if (rows <= 16) return finish<16>(lane, count, rows);
    if (rows <= 32) return finish<32>(lane, count, rows);
    for (std::uint32_t k = 1; k < count; ++k) {  // seldom
      const std::uint32_t id_index = lane[k * kSliceLanes];
      std::uint32_t to = k;
      for (; to > 0 && lane[(to - 1) * kSliceLanes] > id_index; --to)
        lane[to * kSliceLanes] = lane[(to - 1) * kSliceLanes];
      lane[to * kSliceLanes] = id_index;
    }
    for (std::uint32_t k = 0; k < rows; ++k)
      lane[k * kSliceLanes] = k < count ? entry_of(lane[k * kSliceLanes]) : filler;
  }

 private:
  HOOKE_HD std::uint32_t entry_of(std::uint32_t id_index) const {
    return record_offset<Real>(slot_of_id_index[id_index]);
  }

  // Sorts a lane in registers, where an id index above all others stands for no neighbour.
  template <std::size_t kRows>
  HOOKE_HD void finish(std::uint32_t* lane, std::uint32_t count, std::uint32_t rows) const {
    finish(lane, count, rows, std::make_index_sequence<kRows>(),
           std::make_index_sequence<RowNetwork<kRows>::count()>());
  }
  template <std::size_t... kRow, std::size_t... kPair>
  HOOKE_HD void finish(std::uint32_t* lane, std::uint32_t count, std::uint32_t rows, std::index_sequence<kRow...>,
                       std::index_sequence<kPair...>) const {
    constexpr auto kPairs = RowNetwork<sizeof...(kRow)>::pairs();
    std::uint32_t row[] = {(kRow < count ? lane[kRow * kSliceLanes] : kNoSlot)...};
    (exchange(row[kPairs.of[kPair].a], row[kPairs.of[kPair].b]), ...);
    ((kRow < rows ? void(lane[kRow * kSliceLanes] = kRow < count ? entry_of(row[kRow]) : filler) : void()), ...);
  }
  HOOKE_HD static void exchange(std::uint32_t& a, std::uint32_t& b) {
    const std::uint32_t low = a < b ? a : b;
    b = a < b ? b : a;
    a = low;
  }
};

}  // namespace hooke::gpu
