// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/comm/mpi/zoltan_cuts.h"

#include <mpi.h>
#include <zoltan.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "hooke/base/assert.h"

namespace hooke {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// What is not finite is nowhere, and a bisection would look for it for ever.
std::vector<WeightedPoint> finite(std::span<const WeightedPoint> points) {
  std::vector<WeightedPoint> kept;
  kept.reserve(points.size());
  for (const WeightedPoint& p : points) {
    HOOKE_ASSERT(p.weight > 0, p.weight);
    if (std::isfinite(p.at.x) && std::isfinite(p.at.y) && std::isfinite(p.at.z)) kept.push_back(p);
  }
  return kept;
}

std::uint64_t count_on_all_ranks(std::uint64_t count) {
  MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  return count;
}

constexpr Box3d kSpace = {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};

// Equal slabs along x, between the outermost points.
std::vector<Box3d> slabs(const std::vector<WeightedPoint>& points, int ranks) {
  double most[2] = {-kInfinity, -kInfinity};  // of -x, of x
  for (const WeightedPoint& p : points) {
    most[0] = std::max(most[0], -p.at.x);
    most[1] = std::max(most[1], p.at.x);
  }
  MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  const bool is_somewhere = most[0] > -kInfinity;
  const double first = is_somewhere ? -most[0] : 0, length = is_somewhere ? most[0] + most[1] : 1;
  std::vector<Box3d> boxes(static_cast<std::size_t>(ranks), kSpace);
  for (std::size_t rank = 1; rank < boxes.size(); ++rank)
    boxes[rank - 1].max.x = boxes[rank].min.x = first + length * static_cast<double>(rank) / ranks;
  return boxes;
}

// Zoltan's outer faces are at the largest numbers.
void open_outer_faces(Box3d& box) {
  constexpr double kOutside = 0.5 * DBL_MAX;
  for (int axis = 0; axis < 3; ++axis) {
    double &low = component(box.min, axis), &high = component(box.max, axis);
    if (low < -kOutside) low = -kInfinity;
    if (high > kOutside) high = kInfinity;
  }
}

// What Zoltan asks about points; `data` is the vector of them.
const std::vector<WeightedPoint>& points_of(void* data) {
  return *static_cast<const std::vector<WeightedPoint>*>(data);
}

int dimensions(void*, int* error) {
  *error = ZOLTAN_OK;
  return 3;
}
int count(void* data, int* error) {
  *error = ZOLTAN_OK;
  return static_cast<int>(points_of(data).size());
}
void list(void* data, int, int, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int, float* weights, int* error) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  for (std::size_t i = 0; i < points_of(data).size(); ++i) {
    global[2 * i] = static_cast<ZOLTAN_ID_TYPE>(rank);
    global[2 * i + 1] = local[i] = static_cast<ZOLTAN_ID_TYPE>(i);
    weights[i] = static_cast<float>(points_of(data)[i].weight);
  }
  *error = ZOLTAN_OK;
}
void positions(void* data, int, int, int count, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, int, double* at, int* error) {
  for (int i = 0; i < count; ++i) {
    const Vec3d& x = points_of(data)[local[i]].at;
    for (int axis = 0; axis < 3; ++axis) *at++ = component(x, axis);
  }
  *error = ZOLTAN_OK;
}

}  // namespace

struct ZoltanCuts::Impl {
  Zoltan_Struct* zoltan = nullptr;
  std::vector<WeightedPoint> points;  // for the callbacks
};

ZoltanCuts::ZoltanCuts() : impl_(std::make_unique<Impl>()) {
  float version = 0;
  Zoltan_Initialize(0, nullptr, &version);
  Zoltan_Struct* const zoltan = impl_->zoltan = Zoltan_Create(MPI_COMM_WORLD);
  HOOKE_ASSERT(zoltan != nullptr);
  for (const auto& [name, value] : {std::pair{"DEBUG_LEVEL", "0"},
                                    {"LB_METHOD", "RCB"},
                                    {"NUM_GID_ENTRIES", "2"},
                                    {"NUM_LID_ENTRIES", "1"},
                                    {"OBJ_WEIGHT_DIM", "1"},
                                    {"RETURN_LISTS", "NONE"},
                                    {"KEEP_CUTS", "1"},
                                    // Half-way between the points beside a cut, so that few lie on it.
                                    {"AVERAGE_CUTS", "1"}}) {
    Zoltan_Set_Param(zoltan, name, value);
  }
  Zoltan_Set_Num_Geom_Fn(zoltan, dimensions, nullptr);
  Zoltan_Set_Num_Obj_Fn(zoltan, count, &impl_->points);
  Zoltan_Set_Obj_List_Fn(zoltan, list, &impl_->points);
  Zoltan_Set_Geom_Multi_Fn(zoltan, positions, &impl_->points);
}

ZoltanCuts::~ZoltanCuts() { Zoltan_Destroy(&impl_->zoltan); }

std::vector<Box3d> ZoltanCuts::cut(std::span<const WeightedPoint> points, int ranks) {
  if (ranks == 1) return {kSpace};
  impl_->points = finite(points);
  // Zoltan's boxes overlap where there are fewer points than ranks.
  if (count_on_all_ranks(impl_->points.size()) < static_cast<std::uint64_t>(ranks)) return slabs(impl_->points, ranks);
  int changes = 0, gid_entries = 0, lid_entries = 0, imported = 0, exported = 0;
  ZOLTAN_ID_PTR ids[4] = {};
  int* places[4] = {};
  const int done = Zoltan_LB_Partition(impl_->zoltan, &changes, &gid_entries, &lid_entries, &imported, &ids[0], &ids[1],
                                       &places[0], &places[1], &exported, &ids[2], &ids[3], &places[2], &places[3]);
  HOOKE_ASSERT(done == ZOLTAN_OK || done == ZOLTAN_WARN, done);
  impl_->points = {};
  std::vector<Box3d> boxes(static_cast<std::size_t>(ranks));
  for (int rank = 0; rank < ranks; ++rank) {
    Box3d& box = boxes[static_cast<std::size_t>(rank)];
    int dimensions = 0;
    Zoltan_RCB_Box(impl_->zoltan, rank, &dimensions, &box.min.x, &box.min.y, &box.min.z, &box.max.x, &box.max.y,
                   &box.max.z);
    open_outer_faces(box);
  }
  return boxes;
}

}  // namespace hooke
