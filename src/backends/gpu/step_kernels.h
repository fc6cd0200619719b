// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "hooke/backends/gpu/device_report.h"
#include "hooke/backends/gpu/fixed_sum.h"
#include "hooke/backends/gpu/motion_kernels.h"
#include "hooke/backends/gpu/warp.h"
#include "hooke/core/rules.h"
#include "hooke/neighbours/layout.h"
#include "hooke/passes/force_pass.h"
#include "hooke/passes/particle_record.h"
#include "hooke/physics/integrate.h"
#include "hooke/physics/periodic.h"

// A thread of a GPU is an instruction set whose packs have one lane.
#define HOOKE_ISA gpu
#include "hooke/passes/pack_lane.h"
// After the packs.
#include "hooke/passes/force_pass.inl"

#if defined(__CUDA_ARCH__)
#define HOOKE_UNROLL _Pragma("unroll")
#else
#define HOOKE_UNROLL
#endif

namespace hooke::gpu {

/// The list, and where the particles were when it was built.
template <class Real>
struct ListView {
  const std::uint32_t* first_row = nullptr;  // of each slice, and one more
  const std::uint32_t* entries = nullptr;
  const Vec3<Real>* position_at_build = nullptr;  // m, by slot
  std::uint32_t listed = 0;                       // slots from here on touch no others
};

/// Where the kernels of a step report to.
template <class Real>
struct StepOutput {
  DeviceReport* report = nullptr;
  WarpMoves* moves = nullptr;
  SumCopies<Real> sums;                  // PassSum::kCount
  std::uint32_t* suspects = nullptr;    // id indices of particles with a contact that may be too fast
  std::uint32_t* departed = nullptr;    // id indices of particles outside of open faces
};

/// The windows of a step's sums.
struct SumWindows {
  SumWindow of[PassSum::kCount];
};

/// Brings a particle back across periodic faces, and notes it where it is outside of an open one.
template <class Real>
HOOKE_HD void apply_boundaries(const RulesView<Real>& rules, const StepOutput<Real>& out, ParticleRecord<Real>& p) {
  wrap_periodic(rules, p.x);
  if (is_outside_open_face(rules, p.x)) out.departed[add_to(&out.report->departed, 1)] = id_index_of(p.id_index);
}

/// A kernel of one of several steps in a row: it does nothing where a step before needs the host.
template <class Kernel>
struct UnlessHalted {
  const std::uint32_t* halted;
  Kernel kernel;

  HOOKE_HD void operator()(std::uint32_t i) const {
    if (*halted == 0) kernel(i);
  }
};

/// Runs the kernels of steps.
template <class Device>
class StepRunner {
 public:
  StepRunner(const Device& device, DeviceReport* report) : device_(&device), report_(report) {}

  template <class Kernel>
  void each(std::uint32_t count, const Kernel& kernel) const {
    device_->each(count, UnlessHalted<Kernel>{&report_->halted, kernel});
  }
  DeviceReport* report() const { return report_; }

 private:
  const Device* device_;
  DeviceReport* report_;
};

/// One item: the end of one of several steps in a row.
struct EndStep {
  DeviceReport* report;

  HOOKE_HD void operator()(std::uint32_t) const {
    ++report->steps;
    report->halted = report->stale != 0 || report->suspects != 0 || report->departed != 0 || report->torn != 0 ? 1 : 0;
    if (report->halted != 0) return;
    for (std::uint32_t& moved : report->moved) moved = 0;
  }
};

/// How far a particle is from where it was listed, m.
template <class Real>
HOOKE_HD Vec3<Real> moved_since_build(const RulesView<Real>& rules, const ListView<Real>& list, std::uint32_t i,
                                      const Vec3<Real>& x) {
  return nearest_displacement(x, list.position_at_build[i], rules.period);
}

/// The force pass of one particle. Run on whole warps.
template <class Real, Materials kMaterials, PeriodicKind kPeriodic, bool kColliders>
struct StepParticle {
  ForcePass<Real> pass;
  ListView<Real> list;
  StepOutput<Real> out;
  SumWindows windows;

  // What run_pack() reports to.
  struct Report {
    Real of[PassSum::kCount];
    TouchFlags touches;
    bool suspect = false, has_moved = false;
    Vec3<Real> at{};

    HOOKE_HD void put(int sum, const Pack<Real>& a) { of[sum] = a.v.number; }
    HOOKE_HD void put(int sum, const Vec3<Pack<Real>>& a) {
      of[sum] = a.x.v.number;
      of[sum + 1] = a.y.v.number;
      of[sum + 2] = a.z.v.number;
    }
    HOOKE_HD void end_pack(const TouchFlags& flags) { touches = flags; }
    HOOKE_HD void note(SliceNote what) { suspect = suspect || what == kTooFast; }
    template <PeriodicKind>
    HOOKE_HD void moved(const ForcePass<Real>&, const Mask<Real>& present, const Vec3<Pack<Real>>& x, std::size_t) {
      has_moved = present.v;
      at = {x.x.v.number, x.y.v.number, x.z.v.number};
    }
  };

  HOOKE_HD void operator()(std::uint32_t i) const {
    PackRows rows;
    if (i < list.listed) {
      const std::uint32_t* const lane = list.entries + i % kLanes;
      rows = {lane + std::size_t{list.first_row[i / kLanes]} * kSliceLanes,
              lane + std::size_t{list.first_row[i / kLanes + 1]} * kSliceLanes};
    }
    Report report;
    HOOKE_UNROLL
    for (int sum = 0; sum < PassSum::kCount; ++sum) report.of[sum] = Real(0);
    run_pack<Real, kMaterials, kPeriodic, kColliders>(pass, i, rows, report);
    if (report.suspect) out.suspects[add_to(&out.report->suspects, 1)] = id_index_of(pass.buffers.in[i].id_index);
    if (pass.buffers.acceleration == nullptr) {  // symplectic Euler: the particles have moved
      if (list.listed > 0) {
        const Vec3<Real> moved = report.has_moved ? moved_since_build(pass.rules, list, i, report.at)
                                                  : Vec3<Real>{Real(0), Real(0), Real(0)};
        add_move(out.moves, i, report.has_moved, moved);
      }
      const bool pinned = pass.buffers.pinned != nullptr && (pass.buffers.pinned[i / kLanes] >> i % kLanes & 1U) != 0;
      if (pass.rules.open_or_periodic[0] || pass.rules.open_or_periodic[1] || pass.rules.open_or_periodic[2]) {
        if (!pinned && !is_vacant(pass.buffers.out[i])) apply_boundaries(pass.rules, out, pass.buffers.out[i]);
      }
    }
    add_sums(report, i);
  }

 private:
  HOOKE_HD void add_sums(const Report& report, std::uint32_t i) const {
    FixedSum<Real>* const own = out.sums.of_item(i);
    const bool walls = any_in_warp(report.touches.wall), colliders = any_in_warp(report.touches.collider);
    HOOKE_UNROLL
    for (int sum = 0; sum < PassSum::kCount; ++sum) {
      if (!is_summed(pass, sum)) continue;
      const int power = sum < 2 * PassSum::kPowers ? sum % PassSum::kPowers : PassSum::kPowers;
      const bool of_walls =
          power == power_of(Cause::wall) || (sum >= PassSum::kWallForce && sum < PassSum::kWallForce + 3);
      const bool of_colliders =
          power == power_of(Cause::collider) || (sum >= PassSum::kColliderForce && sum < PassSum::kColliderForce + 3);
      if ((of_walls && !walls) || (of_colliders && !colliders)) continue;
      add_term(own[sum], windows.of[sum], report.of[sum]);
    }
  }
};

/// Velocity Verlet's first half of one particle: v += dt/2 a, x += dt v. Run on whole warps.
template <class Real>
struct KickAndDrift {
  RulesView<Real> rules;
  ParticleRecord<Real>* records;
  const Vec3<Real>* acceleration;
  const std::uint16_t* pinned;  // a bit each, an entry a slice; null where none is
  ListView<Real> list;
  StepOutput<Real> out;

  HOOKE_HD void operator()(std::uint32_t i) const {
    ParticleRecord<Real> p = records[i];
    const bool present = !is_vacant(p);
    const bool held = pinned != nullptr && (pinned[i / kLanes] >> i % kLanes & 1U) != 0;
    if (present && !held) {
      p.v = kick(p.v, acceleration[i], Real(0.5) * rules.dt);
      p.x = drift(p.x, p.v, rules.dt);
    }
    const bool listed = present && i < list.listed;
    if (list.listed > 0) {
      const Vec3<Real> moved = listed ? moved_since_build(rules, list, i, p.x) : Vec3<Real>{Real(0), Real(0), Real(0)};
      add_move(out.moves, i, listed, moved);
    }
    if (!present || held) return;
    apply_boundaries(rules, out, p);
    records[i] = p;
  }
};

}  // namespace hooke::gpu
