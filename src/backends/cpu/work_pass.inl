// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The work of applied forces, compiled once for each instruction set like the force pass.

#include "hooke/backends/cpu/work_pass.h"

#include "hooke/backends/cpu/packs.h"
#include "hooke/physics/integrate.h"

namespace hooke::HOOKE_ISA {
namespace {

template <class Real>
void add_work(const ForceWork<Real>& work, ExactParts* sums) {
  using P = Pack<Real>;
  alignas(64) Real columns[WorkSum::count][ForceWork<Real>::kMost];
  const auto velocity = [](const ParticleRecord<Real>* first) {
    const Quad<Real> v = load_quads(Real{}, [=](int lane) { return reinterpret_cast<const Real*>(first + lane) + 4; });
    return Vec3<P>{v.a, v.b, v.c};
  };
  std::size_t end = 0;
  for (; end < work.count; end += P::kLanes) {
    const Vec3<P> force = load_vectors(work.force + end), after = velocity(work.after + end);
    store(columns[WorkSum::power] + end, dot(force, velocity(work.before + end) + after));
    if (work.acceleration != nullptr) {
      const Vec3<P> next = kick(after, load_vectors(work.acceleration + end), P(work.kick));
      store(columns[WorkSum::next_power] + end, dot(force, after + next));
    }
    if (!work.has_resultant) continue;
    store(columns[WorkSum::force] + end, force.x);
    store(columns[WorkSum::force + 1] + end, force.y);
    store(columns[WorkSum::force + 2] + end, force.z);
  }
  for (int sum = 0; sum < WorkSum::count; ++sum) {
    if (sum == WorkSum::next_power && work.acceleration == nullptr) continue;
    if (sum >= WorkSum::force && !work.has_resultant) continue;
    for (std::size_t k = work.count; k < end; ++k) columns[sum][k] = Real(0);
    add_parts(columns[sum], end, sums[sum]);
  }
}

}  // namespace

void work_pass(const ForceWork<float>& work, ExactParts* sums) { add_work(work, sums); }
void work_pass(const ForceWork<double>& work, ExactParts* sums) { add_work(work, sums); }

}  // namespace hooke::HOOKE_ISA
