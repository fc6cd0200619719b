// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Every law, the rules' tables and the grid's questions, in both precisions, as code for a GPU: compiled, never run. See
// CMakeLists.txt.

#include "hooke/core/rules_view.h"
#include "hooke/neighbours/grid_geometry.h"
#include "hooke/neighbours/reference_frame.h"
#include "hooke/neighbours/layout.h"
#include "hooke/physics/attraction.h"
#include "hooke/physics/collider.h"
#include "hooke/physics/contact.h"
#include "hooke/physics/distance_field.h"
#include "hooke/physics/drag.h"
#include "hooke/physics/field.h"
#include "hooke/physics/integrate.h"
#include "hooke/physics/periodic.h"
#include "hooke/physics/shapes.h"
#include "hooke/physics/spring.h"
#include "hooke/physics/wall.h"

namespace hooke {

template <class Real>
struct Particle {
  Vec3<Real> x, v, a;
};

// One call of each law, on numbers unknown to the compiler, so that it can't fold anything.
template <class Real>
__device__ Vec3<Real> all_laws(const Particle<Real>& i, const Particle<Real>& p, const ContactLaw<Real>& law,
                               const PlacedCollider<Real>& collider, const ReferenceFrame<Real>& frame,
                               const Vec3<Real>& period, Real k) {
  const Vec3<Real> x_ip = nearest_displacement(i.x, p.x, period), w = p.v - i.v;
  const Real distance = sqrt_of(dot(x_ip, x_ip));
  const Vec3<Real> normal = contact_normal(x_ip, distance, Real(1));
  const Real overlap = k - distance;
  Vec3<Real> force = contact_forces(overlap, normal, w, law.linear).total();
  force += contact_forces(overlap, normal, w, law).total();
  force += contact_energy(overlap, law.linear.stiffness) * wall_normal(1, Real(1));
  force += upper_wall_overlap(i.x.x, k, k) * normal + lower_wall_overlap(i.x.y, k, k) * normal;
  if (spring_acts(overlap, k)) force += spring_force(overlap, normal, w, k, k).force;
  if (spring_tears(overlap, k, k)) force += spring_energy(overlap, k) * normal;
  force += drag_force(i.v, k) + wind_force(i.v, p.v, k) + sheet_force(i.x, p.x, w, k);
  force += driving_force(direction_to(p.x, i.x), i.v, k, k);
  for_each_collider_face(collider, i.x, [&](const ColliderFace<Real>& face) {
    force += contact_forces(k - face.distance, face.normal, face.velocity - i.v, law.linear).total();
  });
  force += frame.limit2(k) * frame.at(k);
  const Vec3<Real> v = kick(i.v, force, k);
  const Vec3<Real> x = drift(i.x, v, k);
  return {wrap_coordinate(x.x, Real(0), k), x.y, x.z};
}

template <class Real>
__global__ void laws(Particle<Real>* particles, const ContactLaw<Real>* law, const PlacedCollider<Real>* collider,
                     const ReferenceFrame<Real>* frame, Vec3<Real> period, Real k) {
  const unsigned i = blockIdx.x * blockDim.x + threadIdx.x;
  particles[i].a = all_laws(particles[i], particles[i + 1], *law, *collider, *frame, period, k);
}

template __global__ void laws(Particle<float>*, const ContactLaw<float>*, const PlacedCollider<float>*,
                              const ReferenceFrame<float>*, Vec3<float>, float);
template __global__ void laws(Particle<double>*, const ContactLaw<double>*, const PlacedCollider<double>*,
                              const ReferenceFrame<double>*, Vec3<double>, double);

// Which cell a particle is in, how many cells its surroundings meet, and what it has with its own kind.
template <class Real>
__global__ void grid(const Particle<Real>* particles, const GridGeometry geometry, const RulesView<Real> rules,
                     std::uint64_t* keys) {
  const unsigned i = blockIdx.x * blockDim.x + threadIdx.x;
  const Vec3d x = vec_cast<double>(particles[i].x), around{rules.pairs[0].contact_distance, rules.pairs[0].contact_distance, 0};
  std::uint64_t cells = 0;
  geometry.for_path_ranges(x - around, x + around,
                           [&](const GridGeometry::KeyRange& range) { cells += range.last - range.first + 1; });
  keys[i] = geometry.path_key_of(x) + geometry.key_of(x) + cells + geometry.key_end();
}

template __global__ void grid(const Particle<float>*, GridGeometry, RulesView<float>, std::uint64_t*);
template __global__ void grid(const Particle<double>*, GridGeometry, RulesView<double>, std::uint64_t*);

}  // namespace hooke
