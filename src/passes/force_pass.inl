// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The force pass, written once and compiled once for each instruction set (HOOKE_ISA): a pack of particles at a time,
// their contacts row by row, walls, drag, gravity and the integrator, all in registers. What each lane computes is
// exactly what ReferenceBackend spells out for one particle. Whoever includes it includes packs before: those of a
// processor (backends/cpu/packs.h), or the pack of one lane (pack_lane.h), which is what a thread of a GPU computes.

#include <type_traits>

#include "hooke/neighbours/window_search.h"
#include "hooke/passes/force_pass.h"
#include "hooke/passes/pack_field.h"
#include "hooke/physics/contact.h"
#include "hooke/physics/drag.h"
#include "hooke/physics/integrate.h"
#include "hooke/physics/periodic.h"
#include "hooke/physics/wall.h"

namespace hooke::HOOKE_ISA {

// Some particles, one a lane.
template <class Real>
struct Lanes {
  Vec3<Pack<Real>> x;
  Pack<Real> material;
  Vec3<Pack<Real>> v;
  Pack<Real> id_index;
};

template <class Real, class At>
HOOKE_HD Lanes<Real> load_lanes(const At& at) {
  // Register by register: GCC 12 keeps quads that are copied whole in memory, which costs a third of a row's time.
  const TwoQuads<Real> quads = load_two_quads(Real{}, at);
  Lanes<Real> lanes;
  lanes.x.x.v = quads.first.a.v;
  lanes.x.y.v = quads.first.b.v;
  lanes.x.z.v = quads.first.c.v;
  lanes.material.v = quads.first.d.v;
  lanes.v.x.v = quads.second.a.v;
  lanes.v.y.v = quads.second.b.v;
  lanes.v.z.v = quads.second.c.v;
  lanes.id_index.v = quads.second.d.v;
  return lanes;
}

// The particles of the neighbour list's row at `row`.
template <class Real>
HOOKE_HD Lanes<Real> load_neighbours(const ParticleRecord<Real>* records, const std::uint32_t* row) {
  const char* base = reinterpret_cast<const char*>(records);
  return load_lanes<Real>([=](int lane) { return reinterpret_cast<const Real*>(base + std::size_t{row[lane]} * 8); });
}

// Quads of a table, one row a lane; `part` 0 or 1 is the first or second four numbers of a row.
template <class Real, class Row>
HOOKE_HD Quad<Real> load_rows(const Row* table, const Pack<Real>& index, int part) {
  return load_quads(Real{}, [&](int lane) {
    return reinterpret_cast<const Real*>(table + static_cast<std::size_t>(index.v[lane])) + 4 * part;
  });
}

#include "hooke/passes/pair_laws.inl"

// What other particles do to the lanes' particles.
template <class Real, Materials kMaterials>
struct ContactSums {
  Contacts<Real, kMaterials> contacts;
  // True where no contact approaches or parts faster than the limit; false on NaN, i.e. coincident centres.
  Mask<Real> slow = Pack<Real>(Real(0)) == Pack<Real>(Real(0));
};

// The lanes' particles and one neighbour of each: what a contact needs, after every slow operation.
template <class Real, class Law>
struct PairState {
  using P = Pack<Real>;
  P overlap;    // m, below 0 where they do not touch
  Vec3<P> way;  // way * scale is the contact's normal
  P scale;
  Vec3<P> w;  // v_p - v_i, m/s
  Law law;
};

// Contacts with particles in ascending order of id. The first two flags drop what a scene does not need, the third what
// only coincident centres need.
template <class Real, Materials kMaterials, PeriodicKind kPeriodic, bool kTies>
struct ContactLoop {
  using P = Pack<Real>;
  using Table = PairTable<Real, kMaterials>;
  using Met = PairState<Real, decltype(Table::Pair::law)>;
  const ForcePass<Real>& pass;
  const Lanes<Real>& own;

  HOOKE_HD ContactSums<Real, kMaterials> run(const std::uint32_t* row, const std::uint32_t* end) const {
    ContactSums<Real, kMaterials> sums;
    const Table table(pass, own.material);
    while (row != end) {
      if constexpr (kPeriodic == PeriodicKind::images) {
        add_images(table, load_row(row), sums);
        row += kSliceLanes;
      } else {
        // The roots and quotients of several rows start before the first row's are needed. Row by row, the operations
        // that wait for them would keep the processor from looking further ahead.
        Met met[kRowsAtOnce];
        std::size_t count = 0;
        do {
          const Lanes<Real> other = load_row(row);
          meet(table, other, nearest(other), met[count++]);
          row += kSliceLanes;
        } while (count < kRowsAtOnce && row != end);
        for (std::size_t k = 0; k < count; ++k) add(met[k], sums);
      }
    }
    return sums;
  }

  // Number by number: GCC 12 may copy a whole struct byte by byte.
  HOOKE_HD void meet(const Table& table, const Lanes<Real>& other, const Vec3<P>& x_pi, Met& met) const {
    const typename Table::Pair pair = table.lookup(other.material);
    const P distance = sqrt_of(dot(x_pi, x_pi));
    met.overlap = pair.contact_distance - distance;
    if constexpr (kTies) {
      met.way = contact_normal(-x_pi, distance, select(own.id_index > other.id_index, P(Real(1)), P(Real(-1))));
      met.scale = P(Real(1));
    } else {
      met.way = x_pi;
      met.scale = P(Real(-1)) / distance;
    }
    met.w = other.v - own.v;
    keep<Real>(pair.law, met.law);
  }

  // From the lane's particle to the nearest image of its neighbour.
  HOOKE_HD Vec3<P> nearest(const Lanes<Real>& other) const {
    if constexpr (kPeriodic == PeriodicKind::none) {
      return other.x - own.x;
    } else {
      const auto displacement = [&](const P& x_i, const P& x_p, bool periodic, Real length) {
        if (!periodic) return x_i - x_p;
        return image_displacement(x_i, x_p, nearest_image(x_i, x_p, P(length)), P(length));
      };
      return -Vec3<P>{displacement(own.x.x, other.x.x, pass.rules.periodic[0], pass.rules.length.x),
                      displacement(own.x.y, other.x.y, pass.rules.periodic[1], pass.rules.length.y),
                      displacement(own.x.z, other.x.z, pass.rules.periodic[2], pass.rules.length.z)};
    }
  }

  // Adds all images of a neighbour, which may be the lane's particle itself.
  HOOKE_HD void add_images(const Table& table, const Lanes<Real>& other, ContactSums<Real, kMaterials>& sums) const {
    const Mask<Real> itself = own.id_index == other.id_index;
    for (int sx = -pass.rules.images[0]; sx <= pass.rules.images[0]; ++sx) {
      for (int sy = -pass.rules.images[1]; sy <= pass.rules.images[1]; ++sy) {
        for (int sz = -pass.rules.images[2]; sz <= pass.rules.images[2]; ++sz) {
          const Vec3<P> x_ip{image_displacement(own.x.x, other.x.x, P(static_cast<Real>(sx)), P(pass.rules.length.x)),
                             image_displacement(own.x.y, other.x.y, P(static_cast<Real>(sy)), P(pass.rules.length.y)),
                             image_displacement(own.x.z, other.x.z, P(static_cast<Real>(sz)), P(pass.rules.length.z))};
          Met met;
          meet(table, other, -x_ip, met);
          // No particle touches itself.
          if (sx == 0 && sy == 0 && sz == 0)
            met.overlap = select(itself, P(static_cast<Real>(-kVacantPosition)), met.overlap);
          add(met, sums);
        }
      }
    }
  }

  // The law's inputs are 0 where nothing acts, so the linear law's results are 0: fewer masks than one for each of the
  // results.
  HOOKE_HD void add(const Met& met, ContactSums<Real, kMaterials>& sums) const {
    const Mask<Real> here = acts<Real>(met.overlap, met.law);
    const P overlap = only_where(here, met.overlap);
    const Vec3<P> normal = only_where(here, met.scale) * met.way;
    const Vec3<P> w = only_where(here, met.w);
    if constexpr (have_surfaces(kMaterials)) {
      sums.contacts.add(here, contact_forces(overlap, normal, w, met.law));
    } else {
      sums.contacts.add(contact_vectors(overlap, normal, w), met.law);
    }
    // NaN, where centres coincide, is not slow. Pairs that only cohesion joins are checked, too, and those that part.
    sums.slow = sums.slow & (magnitude(dot(w, normal)) <= P(pass.rules.speed_limit));
  }

  // Loads a row's neighbours, after a prefetch of a later row's.
  HOOKE_HD Lanes<Real> load_row(const std::uint32_t* row) const {
    prefetch_row(row + kRowsAhead * kSliceLanes);
    return load_neighbours(pass.buffers.in, row);
  }

  // Neighbours come in the order of their ids, which no processor predicts. This prefetches the neighbours of about the
  // next slice; at a tile's end those of the next tile, or whatever comes after the last tile.
  HOOKE_HD void prefetch_row(const std::uint32_t* row) const {
    for (std::size_t lane = 0; lane < P::kLanes; ++lane) {
      prefetch(reinterpret_cast<const char*>(pass.buffers.in) + std::size_t{row[lane]} * 8);
    }
  }
};

// Contacts with the domain's walls: x, y, z, the lower face first.
template <class Real, Materials kMaterials>
struct WallLoop {
  using P = Pack<Real>;
  const ForcePass<Real>& pass;
  const Lanes<Real>& own;
  const Mask<Real>& present;

  // The force of all walls, and whether one acts.
  HOOKE_HD Vec3<P> run(Mask<Real>& too_fast, bool& touched) const {
    Vec3<P> force{P(Real(0)), P(Real(0)), P(Real(0))};
    if (!any(is_near())) return force;
    const Vec3<P> w = -own.v;
    const auto pair = wall_pairs_of<Real, kMaterials>(pass, own);
    const auto face = [&](int axis, Real sign, const P& overlap) {
      const Mask<Real> here = present & acts<Real>(overlap, pair.law);
      if (!any(here)) return;
      touched = true;
      const Vec3<P> normal = wall_normal(axis, P(sign));
      add_where(here, force, contact_forces(overlap, normal, w, pair.law).total());
      too_fast = too_fast | (here & (dot(w, normal) > P(pass.rules.speed_limit)));
    };
    for (int axis = 0; axis < 3; ++axis) {
      if (!pass.rules.wall[axis]) continue;
      const P& x = component(own.x, axis);
      face(axis, Real(1), lower_wall_overlap(x, P(component(pass.rules.min, axis)), pair.contact_distance));
      face(axis, Real(-1), upper_wall_overlap(x, P(component(pass.rules.max, axis)), pair.contact_distance));
    }
    return force;
  }

  // Mask of lanes that may touch a wall.
  HOOKE_HD Mask<Real> is_near() const {
    const auto outside = [&](int axis) {
      const P& x = component(own.x, axis);
      return (x < P(component(pass.rules.clear_of_walls_from, axis))) |
             (x > P(component(pass.rules.clear_of_walls_to, axis)));
    };
    return present & (outside(0) | outside(1) | outside(2));
  }
};

#include "hooke/passes/collider_loop.inl"

// Mask of lanes that left the domain across an open or periodic face; NaN counts as having left.
template <class Real>
HOOKE_HD Mask<Real> left_domain(const ForcePass<Real>& pass, const Vec3<Pack<Real>>& x) {
  using P = Pack<Real>;
  Mask<Real> out = P(Real(0)) < P(Real(0));
  for (int axis = 0; axis < 3; ++axis) {
    if (!pass.rules.open_or_periodic[axis]) continue;
    const P& c = component(x, axis);
    out = out | !((c >= P(component(pass.rules.min, axis))) & (c < P(component(pass.rules.max, axis))));
  }
  return out;
}

// Whether any lane may touch other particles, or touches a wall or a collider.
struct TouchFlags {
  bool others = true, wall = false, collider = false;
};

// The index of a cause's power among the sums of a pass.
HOOKE_HD constexpr int power_of(Cause cause) { return static_cast<int>(cause); }

// The forces on the lanes' particles, N.
template <class Real, class ByContacts>
struct Forces {
  using P = Pack<Real>;
  ByContacts contacts;
  Vec3<P> walls, colliders, drag, weight;

  // Puts the powers at twice a mean velocity into the sums from `first` on.
  template <class Report>
  HOOKE_HD void put_powers(int first, const Vec3<P>& twice_mean, bool has_drag, const TouchFlags& touches,
                           Report& to) const {
    if (touches.others) put_contacts(first, contacts, twice_mean, to);
    to.put(first + power_of(Cause::gravity), dot(weight, twice_mean));
    if (has_drag) to.put(first + power_of(Cause::drag), dot(drag, twice_mean));
    if (touches.wall) to.put(first + power_of(Cause::wall), dot(walls, twice_mean));
    if (touches.collider) to.put(first + power_of(Cause::collider), dot(colliders, twice_mean));
  }

 private:
  template <class Report>
  HOOKE_HD static void put_contacts(int first, const ContactForces<P>& by, const Vec3<P>& twice_mean, Report& to) {
    to.put(first + power_of(Cause::contact_spring), dot(by.spring, twice_mean));
    to.put(first + power_of(Cause::contact_shear), dot(by.shear, twice_mean));
    to.put(first + power_of(Cause::contact_damping), dot(by.damping, twice_mean));
  }
  template <class Report>
  HOOKE_HD static void put_contacts(int first, const SurfaceForces<P>& by, const Vec3<P>& twice_mean, Report& to) {
    put_contacts(first, by.linear, twice_mean, to);
    to.put(first + power_of(Cause::contact_friction), dot(by.friction, twice_mean));
  }
};

// Neighbours of a pack's particles: from `row` to `end`, a row every kSliceLanes entries. Null: they touch no other
// particles.
struct PackRows {
  const std::uint32_t* row = nullptr;
  const std::uint32_t* end = nullptr;
};

// The step of a pack: the particles in the slots from `first` on. `report` is told what is summed and what was noticed:
//   put(sum, pack or vector of packs)   a term a lane of PassSum `sum`, or of it and the next two
//   end_pack(touches)                   all terms of the pack are put
//   note(SliceNote)                     something to look at closely
//   moved<kPeriodic>(pass, present, x, first)   symplectic Euler: listed particles `present` are at x now
template <class Real, Materials kMaterials, PeriodicKind kPeriodic, bool kColliders, class Report>
HOOKE_HD void run_pack(const ForcePass<Real>& pass, std::size_t first, const PackRows& rows, Report& report) {
  using P = Pack<Real>;
  const std::size_t lane_offset = first % kSliceLanes;
  const bool alone = rows.row == nullptr;

  const Real* own_record = reinterpret_cast<const Real*>(pass.buffers.in + first);
  const Lanes<Real> own = load_lanes<Real>([=](int lane) { return own_record + 8 * lane; });
  const Mask<Real> present = own.x.x < P(static_cast<Real>(kVacantPosition));

  ContactSums<Real, kMaterials> sums;
  if (!alone) {
    sums = ContactLoop<Real, kMaterials, kPeriodic, false>{pass, own}.run(rows.row, rows.end);
    if (any(!sums.slow)) {
      sums = ContactLoop<Real, kMaterials, kPeriodic, true>{pass, own}.run(rows.row, rows.end);
    }
  }
  Mask<Real> too_fast = !sums.slow;

  const auto by_contacts = sums.contacts.forces(pass);
  Forces<Real, std::remove_const_t<decltype(by_contacts)>> forces{by_contacts, {}, {}, {}, {}};
  TouchFlags touches;
  touches.others = !alone;
  forces.walls = WallLoop<Real, kMaterials>{pass, own, present}.run(too_fast, touches.wall);
  const Vec3<P> zero{P(Real(0)), P(Real(0)), P(Real(0))};
  forces.colliders = zero;
  if constexpr (kColliders) {
    forces.colliders = ColliderLoop<Real, kMaterials>{pass, own, present}.run(too_fast, touches.collider);
  }
  const Quad<Real> body = body_of<Real, kMaterials>(pass, own);
  Vec3<P> force = (forces.contacts.total() + forces.walls) + forces.colliders;
  if (pass.rules.has_drag) {
    forces.drag = drag_force(own.v, body.b);
    force += forces.drag;
  }
  if (pass.buffers.applied != nullptr) force += load_vectors(pass.buffers.applied + first);

  const Vec3<P> gravity{P(pass.rules.gravity.x), P(pass.rules.gravity.y), P(pass.rules.gravity.z)};
  forces.weight = body.c * gravity;
  const Vec3<P> a = body.a * force + gravity;
  const P dt(pass.rules.dt);
  const unsigned pinned = pass.buffers.pinned != nullptr
                              ? static_cast<unsigned>(pass.buffers.pinned[first / kSliceLanes]) >> lane_offset
                              : 0;
  Vec3<P> v, x = own.x;
  if (pass.buffers.acceleration != nullptr) {  // velocity Verlet
    v = kick(own.v, a, P(Real(0.5)) * dt);
    for (std::size_t lane = 0; lane < P::kLanes; ++lane) {
      pass.buffers.acceleration[first + lane] = {a.x.v[lane], a.y.v[lane], a.z.v[lane]};
    }
  } else {  // symplectic Euler
    v = kick(own.v, a, dt);
    x = drift(own.x, v, dt);
    if (any(present & left_domain(pass, x))) report.note(kLeftDomain);
    if (!alone) {
      // Held particles are put back after the pass.
      const Vec3<P> to = pinned != 0 ? select_vector(lanes_of<Real>(pinned), own.x, x) : x;
      report.template moved<kPeriodic>(pass, present, to, first);
    }
  }
  if (any(too_fast)) report.note(kTooFast);

  x = select_vector(present, x, own.x);
  v = select_vector(present, v, zero);

  // Held particles keep their velocity.
  Vec3<P> after = v, next = v;
  if (pass.buffers.acceleration != nullptr) next = select_vector(present, kick(v, a, P(Real(0.5)) * dt), zero);
  if (pinned != 0) {
    after = select_vector(lanes_of<Real>(pinned), own.v, v);
    next = select_vector(lanes_of<Real>(pinned), own.v, next);
  }
  forces.put_powers(0, own.v + after, pass.rules.has_drag, touches, report);
  if (pass.buffers.acceleration != nullptr) {
    forces.put_powers(PassSum::kNext, after + next, pass.rules.has_drag, touches, report);
  }
  if (touches.wall) report.put(PassSum::kWallForce, forces.walls);
  if (touches.collider) report.put(PassSum::kColliderForce, forces.colliders);
  if (pass.rules.has_drag) report.put(PassSum::kDragForce, select_vector(present, forces.drag, zero));
  report.end_pack(touches);
  Real* out_record = reinterpret_cast<Real*>(pass.buffers.out + first);
  const TwoQuads<Real> record{{x.x, x.y, x.z, own.material}, {v.x, v.y, v.z, own.id_index}};
  store_two_quads(record, [=](int lane) { return out_record + 8 * lane; });
}

// Whether the scene has anything for column `sum`.
template <class Real>
HOOKE_HD bool is_summed(const ForcePass<Real>& pass, int sum) {
  if (sum >= PassSum::kDragForce) return pass.rules.has_drag;
  if (sum >= PassSum::kWallForce) return true;
  if (sum % PassSum::kPowers == power_of(Cause::drag) && !pass.rules.has_drag) return false;
  if (sum % PassSum::kPowers == power_of(Cause::contact_friction) && pass.rules.linear) return false;
  return sum < PassSum::kNext || pass.buffers.acceleration != nullptr;
}

// Calls run(materials, periodic) with the kind of loop that a scene needs, two integral constants. It follows from the
// scene alone, and bits depend on it: with one material, sums are taken before its coefficients are applied.
template <class Real, class Run>
void choose_loop(const ForceConstants<Real>& rules, const Run& run) {
  const auto choose_periodic = [&](auto materials) {
    const auto with = [&](auto kind) { run(materials, kind); };
    switch (rules.periodic_kind) {
      case PeriodicKind::none:
        return with(std::integral_constant<PeriodicKind, PeriodicKind::none>{});
      case PeriodicKind::nearest:
        return with(std::integral_constant<PeriodicKind, PeriodicKind::nearest>{});
      case PeriodicKind::images:
        return with(std::integral_constant<PeriodicKind, PeriodicKind::images>{});
    }
  };
  if (!rules.linear && rules.few != nullptr)
    return choose_periodic(std::integral_constant<Materials, Materials::few_surfaces>{});
  if (!rules.linear) return choose_periodic(std::integral_constant<Materials, Materials::many_surfaces>{});
  if (rules.material_count == 1) return choose_periodic(std::integral_constant<Materials, Materials::one>{});
  if (rules.few != nullptr) return choose_periodic(std::integral_constant<Materials, Materials::few>{});
  return choose_periodic(std::integral_constant<Materials, Materials::many>{});
}

}  // namespace hooke::HOOKE_ISA
