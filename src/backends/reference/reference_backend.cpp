// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/reference/reference_backend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "hooke/backends/reference/reference_attraction.h"
#include "hooke/backends/reference/reference_fields.h"
#include "hooke/backends/reference/reference_springs.h"
#include "hooke/base/assert.h"
#include "hooke/base/stopwatch.h"
#include "hooke/core/contact_walk.h"
#include "hooke/core/placed_colliders.h"
#include "hooke/core/rules.h"
#include "hooke/core/state_hash.h"
#include "hooke/core/sums.h"
#include "hooke/physics/drag.h"
#include "hooke/physics/enclosure.h"
#include "hooke/physics/integrate.h"

namespace hooke {
namespace {

class ReferenceBackend final : public Backend {
 public:
  BackendInfo info() const override { return {"reference", "scalar", Precision::double_precision, 1}; }

  void configure(const Scene& scene) override {
    scene_ = scene;
    rules_ = Rules<double>(scene);
    springs_.configure(scene);
    attraction_.configure(scene);
    external_.clear();
    sinks_.clear();
    for (const Sink& sink : scene.sinks) sinks_.push_back(geometry_of(sink.shape, false, {0, 0, 0}));
    walls_ = scene.domain.walls();
    images_.period = scene.domain.period();
    for (int axis = 0; axis < 3; ++axis) {
      const RulesView<double>& rules = rules_.view();
      images_.most[static_cast<std::size_t>(axis)] = rules.images[axis];
      component(period_, axis) =
          rules.periodic[axis] ? component(rules.period, axis) : std::numeric_limits<double>::infinity();
    }
  }

  void break_springs(const std::vector<std::uint64_t>& broken) override { springs_.break_these(broken); }
  std::vector<std::uint64_t> broken_springs() const override { return springs_.broken(); }

  void assign(const ParticleSet& particles) override {
    HOOKE_ASSERT(are_particles_of(particles, scene_), particles.size(), scene_.materials.size());
    p_ = particles;
    for (Vec3d& x : p_.position) wrap_periodic(rules_.view(), x);
    p_.acceleration.resize(verlet() ? p_.size() : 0);
  }

  void download(const ParticleColumns<double>& out) const override { copy_to(out); }
  void download(const ParticleColumns<float>& out) const override { copy_to(out); }
  std::uint64_t particle_count() const override { return p_.size(); }

  std::optional<ParticleAt> find(std::uint64_t id) const override {
    const std::size_t i = p_.find(id);
    if (i == p_.size()) return std::nullopt;
    return ParticleAt{id, p_.material[i], p_.position[i], p_.velocity[i]};
  }

  void edit(std::span<const ParticleAt> edited) override {
    for (const ParticleAt& to : edited) {
      const std::size_t i = p_.find(to.id);
      HOOKE_ASSERT(i < p_.size(), to.id);
      p_.position[i] = to.position;
      p_.velocity[i] = to.velocity;
      wrap_periodic(rules_.view(), p_.position[i]);
    }
  }

  std::optional<std::uint64_t> set_external_forces(std::span<const std::uint64_t> ids,
                                                   std::span<const Vec3d> forces) override {
    HOOKE_ASSERT(ids.size() == forces.size(), ids.size(), forces.size());
    for (const std::uint64_t id : ids) {
      if (p_.find(id) == p_.size()) return id;
    }
    external_.clear();
    for (std::size_t k = 0; k < ids.size(); ++k) external_[ids[k]] = forces[k];
    return std::nullopt;
  }

  RemovalSums insert(const ParticleSet& newborn) override {
    HOOKE_ASSERT(are_particles_of(newborn, scene_), newborn.size(), scene_.materials.size());
    HOOKE_ASSERT(newborn.empty() || p_.empty() || newborn.id.front() > p_.id.back(), newborn.id.front(), p_.id.back());
    RemovalSums born;
    for (std::size_t k = 0; k < newborn.size(); ++k) {
      p_.id.push_back(newborn.id[k]);
      p_.material.push_back(newborn.material[k]);
      p_.position.push_back(newborn.position[k]);
      p_.velocity.push_back(newborn.velocity[k]);
      if (verlet()) p_.acceleration.push_back({0, 0, 0});
      wrap_periodic(rules_.view(), p_.position.back());
      born.add_particle(material(p_.size() - 1).mass, p_.position.back(), p_.velocity.back(), scene_.gravity);
    }
    const std::size_t first = p_.size() - newborn.size();
    if (!newborn.empty()) add_elastic([&](std::size_t i) { return i >= first; }, born.elastic);
    return born;
  }

  Removal remove(std::span<const std::uint64_t> ids) override {
    Removal removal;
    for (const std::uint64_t id : ids) removal.was_there.push_back(p_.find(id) < p_.size() ? 1 : 0);
    const std::set<std::uint64_t> gone(ids.begin(), ids.end());
    removal.sums = remove_where([&](std::size_t i) { return gone.contains(p_.id[i]); });
    return removal;
  }

  RemovalSums remove_sunk() override {
    return remove_where([&](std::size_t i) {
      return std::any_of(sinks_.begin(), sinks_.end(),
                         [&](const ShapeGeometry<double>& sink) { return encloses(sink, p_.position[i]); });
    });
  }

  void half_kick_and_drift() override {
    HOOKE_ASSERT(verlet());
    const Stopwatch drifting(times_.drift);
    for (std::size_t i = 0; i < p_.size(); ++i) {
      if (is_pinned(i)) continue;
      p_.velocity[i] = kick(p_.velocity[i], p_.acceleration[i], scene_.time_step / 2);
      p_.position[i] = drift(p_.position[i], p_.velocity[i], scene_.time_step);
    }
  }

  void follow_motion() override {
    for (Vec3d& x : p_.position) wrap_periodic(rules_.view(), x);
  }

  // Under velocity Verlet they have had their half kick.
  void remove_departed(RemovalSums& left) override {
    left.add(remove_where([&](std::size_t i) { return is_outside_open_face(rules_.view(), p_.position[i]); }, false));
  }

  bool neighbours_stale() override { return true; }  // there is no list: every pair is looked at, every step

  Condition build_neighbours() override {
    for (std::size_t i = 0; i < p_.size(); ++i) {
      const Vec3d& x = p_.position[i];
      if (!std::isfinite(x.x) || !std::isfinite(x.y) || !std::isfinite(x.z)) {
        return {Condition::Kind::not_finite, p_.id[i], 0, 0};
      }
    }
    return {};
  }

  void apply_forces(const Instant& now, StepReport& report) override {
    const Stopwatch forcing(times_.force);
    Forces forces = accelerations(now, report);
    const std::vector<std::size_t> torn = springs_.torn(p_, report.applied->springs);
    const double dt = scene_.time_step, kick_time = verlet() ? dt / 2 : dt;
    for (std::size_t i = 0; i < p_.size(); ++i) {
      const Vec3d before = p_.velocity[i];
      const Vec3d kicked = kick(before, forces.a[i], kick_time);
      if (is_pinned(i)) {
        report.applied->add_pinned(material(i).mass, before, kicked, kick_time);
        forces.a[i] = {0, 0, 0};
      } else {
        p_.velocity[i] = kicked;
        if (!verlet()) p_.position[i] = drift(p_.position[i], p_.velocity[i], dt);
      }
      add_work(forces, i, before, p_.velocity[i], *report.applied);
    }
    if (verlet()) p_.acceleration = forces.a;
    springs_.tear(torn);
  }

  void evaluate_accelerations(const Instant& now, StepReport& report) override {
    HOOKE_ASSERT(verlet());
    Forces forces = accelerations(now, report);
    report.condition = {};  // nothing moves yet: the first step reports it
    for (std::size_t i = 0; i < p_.size(); ++i) {
      if (is_pinned(i)) {
        const Vec3d& v = p_.velocity[i];
        report.applied->add_pinned(material(i).mass, v, kick(v, forces.a[i], scene_.time_step / 2),
                                   scene_.time_step / 2);
        forces.a[i] = {0, 0, 0};
      }
      add_work(forces, i, p_.velocity[i], kick(p_.velocity[i], forces.a[i], scene_.time_step / 2), *report.applied);
    }
    p_.acceleration = std::move(forces.a);
  }

  void find_inside(const Box3d& box, std::vector<Occupant>& out) const override {
    for (std::size_t i = 0; i < p_.size(); ++i) {
      if (material(i).interacts && box.contains(p_.position[i])) out.push_back({p_.position[i], material(i).radius});
    }
  }

  std::uint64_t particles_hash() const override {
    std::uint64_t hash = 0;
    for (std::size_t i = 0; i < p_.size(); ++i) hash += particle_hash(p_.id[i], p_.position[i], p_.velocity[i]);
    return hash;
  }

  Expected<MeasurementSums> measure(const Instant& now) override {
    place_colliders_at(now);
    MeasurementSums sums;
    for (std::size_t i = 0; i < p_.size(); ++i) {
      sums.add_particle(material(i).mass, p_.position[i], p_.velocity[i], scene_.gravity);
      for_each_contact(i, [&](std::size_t p, const Vec3d&, double overlap) {
        sums.add_contact_side(pair(i, p), overlap, material(i).radius + material(p).radius);
      });
      for_each_wall(i, [&](const Vec3d& normal, double overlap) {
        const ContactLaw<double> c = wall(i);
        sums.add_wall_contact(c, overlap, material(i).radius, contact_force(overlap, normal, -p_.velocity[i], c));
      });
      for_each_collider(i, [&](std::size_t c, const auto&, const ColliderFace<double>& face, double overlap) {
        const ContactLaw<double> k = collider_pair(i, c);
        const Vec3d force = contact_force(overlap, face.normal, face.velocity - p_.velocity[i], k);
        sums.add_collider_contact(c, face.point, k, overlap, material(i).radius, force);
      });
    }
    springs_.measure(p_, sums);
    sums.add_attraction(attraction_.energy(p_));
    return sums;
  }

  NeighbourStatistics neighbour_statistics() const override { return {0, static_cast<double>(p_.size())}; }
  StageTimes stage_times() const override { return times_; }

 private:
  // A cause whose forces are found for all particles at once.
  struct AppliedForce {
    Cause cause;
    std::vector<Vec3d> force;  // N, one per particle; empty where the scene has no such force
  };
  struct Forces {
    std::vector<Vec3d> a;  // m/s^2
    std::vector<AppliedForce> applied;  // in the order of their sum
  };

  // A particle and its partner: another particle, a wall or a face of a collider.
  struct Contact {
    Condition::Kind kind;  // what to report where the contact is too fast for a step
    std::uint64_t partner;  // id, or index of the collider
    double overlap;  // m
    Vec3d normal;  // to the particle
    Vec3d w;  // m/s, of the partner relative to the particle
    ContactLaw<double> law;
    bool too_fast;
  };

  // The forces on one particle, N.
  struct ParticleForces {
    SurfaceForces<double> contacts;
    Vec3d walls{0, 0, 0}, colliders{0, 0, 0}, drag{0, 0, 0}, applied{0, 0, 0};
  };

  bool verlet() const { return scene_.integrator == Integrator::velocity_verlet; }
  bool is_pinned(std::size_t i) const { return material(i).fixed || springs_.is_pinned(p_.id[i]); }
  const Material& material(std::size_t i) const { return scene_.materials[p_.material[i]]; }
  ContactLaw<double> pair(std::size_t i, std::size_t p) const {
    return law_of(rules_.pair(p_.material[i], p_.material[p]));
  }
  ContactLaw<double> wall(std::size_t i) const { return law_of(rules_.wall(p_.material[i])); }
  ContactLaw<double> collider_pair(std::size_t i, std::size_t c) const {
    return law_of(rules_.collider(p_.material[i], c));
  }

  // Accelerations of all particles (docs/theory.md eq. 1); fills the report.
  Forces accelerations(const Instant& now, StepReport& report) {
    place_colliders_at(now);
    report.applied.emplace();
    Forces out;
    out.applied.push_back({Cause::springs, springs_.forces(p_, report.applied->springs)});
    out.applied.push_back({Cause::field, field_forces(scene_, p_, now.time)});
    out.applied.push_back({Cause::attraction, attraction_.forces(p_)});
    out.applied.push_back({Cause::external, external_forces()});
    for (std::size_t i = 0; i < p_.size(); ++i) {
      const std::vector<Contact> contacts = contacts_of(i, now.moved);
      const ParticleForces forces = forces_on(i, contacts, out.applied);
      out.a.push_back((1 / material(i).mass) * total(forces) + scene_.gravity);
      report.condition = Condition::first(report.condition, check_contacts(i, contacts));
      report.mass.add(material(i).mass);
      book(i, forces, out.a[i], report.sums);
    }
    return out;
  }

  std::vector<Vec3d> external_forces() const {
    std::vector<Vec3d> forces(external_.empty() ? 0 : p_.size());
    for (const auto& [id, force] : external_) {
      if (const std::size_t i = p_.find(id); i < p_.size()) forces[i] = force;
    }
    return forces;
  }

  template <class Out>
  void copy_to(const ParticleColumns<Out>& out) const {
    for (std::size_t i = 0; i < p_.size(); ++i) {
      if (out.id != nullptr) out.id[i] = p_.id[i];
      if (out.material != nullptr) out.material[i] = p_.material[i];
      if (out.position != nullptr) out.position[i] = vec_cast<Out>(p_.position[i]);
      if (out.velocity != nullptr) out.velocity[i] = vec_cast<Out>(p_.velocity[i]);
      if (verlet() && out.acceleration != nullptr) out.acceleration[i] = vec_cast<Out>(p_.acceleration[i]);
    }
  }

  // In canonical order: other particles by id and image, walls, colliders.
  std::vector<Contact> contacts_of(std::size_t i, bool moved) const {
    const Vec3d &x = p_.position[i], &v = p_.velocity[i];
    const double radius = material(i).radius, dt = scene_.time_step;
    std::vector<Contact> all;
    for_each_contact(i, [&](std::size_t p, const Vec3d& normal, double overlap) {
      const Vec3d w = p_.velocity[p] - v;
      const double approach = dot(w, normal) * dt;
      const double smaller = std::min(radius, material(p).radius), distance = radius + material(p).radius - overlap;
      all.push_back({Condition::Kind::pair_too_fast, p_.id[p], overlap, normal, w, pair(i, p),
                     approaches_too_fast(approach, smaller) || (moved && passed_through(approach, smaller, distance))});
    });
    for_each_wall(i, [&](const Vec3d& normal, double overlap) {
      all.push_back({Condition::Kind::wall_too_fast, 0, overlap, normal, -v, wall(i),
                     approaches_too_fast(dot(-v, normal) * dt, radius)});
    });
    for_each_collider(i, [&](std::size_t c, const PlacedCollider<double>& collider, const ColliderFace<double>& face,
                             double overlap) {
      const Vec3d w = face.velocity - v;
      all.push_back({Condition::Kind::collider_too_fast, c, overlap, face.normal, w, collider_pair(i, c),
                     approaches_too_fast(dot(w, face.normal) * dt, radius) ||
                         (moved && passed_through(collider, face, x, -dt * w, radius))});
    });
    return all;
  }

  // Summed in the order of the contacts, cause by cause. In a scene of one material, contacts are summed before their
  // coefficients are applied: the definition, not a shortcut (docs/theory.md section 2).
  ParticleForces forces_on(std::size_t i, const std::vector<Contact>& contacts,
                           const std::vector<AppliedForce>& applied) const {
    const bool linear = rules_.view().linear, alike = linear && rules_.material_count() == 1;
    ParticleForces on;
    ContactVectors<double> vectors;
    for (const Contact& m : contacts) {
      const auto force = [&] { return contact_forces(m.overlap, m.normal, m.w, m.law); };
      const auto linear_force = [&] { return contact_forces(m.overlap, m.normal, m.w, m.law.linear); };
      if (m.kind == Condition::Kind::pair_too_fast) {
        if (alike) {
          vectors += contact_vectors(m.overlap, m.normal, m.w);
        } else if (linear) {
          on.contacts.linear += linear_force();
        } else {
          on.contacts += force();
        }
      } else {
        Vec3d& sum = m.kind == Condition::Kind::wall_too_fast ? on.walls : on.colliders;
        sum += linear ? linear_force().total() : force().total();
      }
    }
    if (alike) on.contacts.linear = contact_forces(vectors, pair(i, i).linear);
    on.drag = drag_force(p_.velocity[i], material(i).drag);
    for (const AppliedForce& applied_force : applied) {
      if (!applied_force.force.empty()) on.applied += applied_force.force[i];
    }
    return on;
  }

  Vec3d total(const ParticleForces& on) const {
    const Vec3d contacts = rules_.view().linear ? on.contacts.linear.total() : on.contacts.total();
    return (((contacts + on.walls) + on.colliders) + on.drag) + on.applied;
  }

  // The first contact that is too fast for a step, if there is one.
  Condition check_contacts(std::size_t i, const std::vector<Contact>& contacts) const {
    Condition found;
    for (const Contact& m : contacts) {
      if (m.overlap > 0 && m.too_fast)
        found = Condition::first(found, {m.kind, p_.id[i], m.partner, dot(m.w, m.normal)});
    }
    return found;
  }

  // Adds the forces, and their powers in the kick with acceleration `a` and in the kick after it.
  void book(std::size_t i, const ParticleForces& on, const Vec3d& a, StepSums& sums) const {
    sums.wall_force.add(on.walls);
    sums.collider_force.add(on.colliders);
    sums.drag_force.add(on.drag);
    const auto add_powers = [&](ByCause<ExactSum, kPassCauses>& power, const Vec3d& before, const Vec3d& after) {
      const Vec3d twice_mean = before + after;
      power[Cause::contact_spring].add(dot(on.contacts.linear.spring, twice_mean));
      power[Cause::contact_shear].add(dot(on.contacts.linear.shear, twice_mean));
      power[Cause::contact_damping].add(dot(on.contacts.linear.damping, twice_mean));
      power[Cause::contact_friction].add(dot(on.contacts.friction, twice_mean));
      power[Cause::wall].add(dot(on.walls, twice_mean));
      power[Cause::collider].add(dot(on.colliders, twice_mean));
      power[Cause::drag].add(dot(on.drag, twice_mean));
      power[Cause::gravity].add(material(i).mass * dot(scene_.gravity, twice_mean));
    };
    const double dt = scene_.time_step;
    const Vec3d& v = p_.velocity[i];
    const bool pinned = is_pinned(i);
    const Vec3d after = pinned ? v : kick(v, a, verlet() ? dt / 2 : dt);
    add_powers(sums.power, v, after);
    if (verlet()) add_powers(sums.next_power, after, pinned ? v : kick(after, a, dt / 2));
  }

  // Adds the work of the applied forces on particle i in a kick from `before` to `after`, and in the coming half kick.
  void add_work(const Forces& forces, std::size_t i, const Vec3d& before, const Vec3d& after, AppliedSums& sums) const {
    for (const AppliedForce& applied_force : forces.applied) {
      if (applied_force.force.empty()) continue;
      const Vec3d& force = applied_force.force[i];
      AppliedSums::Rates& rates = sums[applied_force.cause];
      rates.power.add(dot(force, before + after));
      if (verlet()) rates.next_power.add(dot(force, after + kick(after, forces.a[i], scene_.time_step / 2)));
      if (applied_force.cause != Cause::springs) rates.force.add(force);  // spring forces sum to 0
    }
  }

  // Whether no image of y is within `far` (m) of x along some axis; both are in the domain.
  bool is_farther(double far, const Vec3d& x, const Vec3d& y) const {
    const auto along = [far](double a, double b, double period) {
      const double off = std::abs(a - b);
      return off > far && period - off > far;
    };
    return along(x.x, y.x, period_.x) || along(x.y, y.y, period_.y) || along(x.z, y.z, period_.z);
  }

  // visit(p, normal, overlap) for every image of a particle p that acts on i, by id, then image: it touches i,
  // overlap > 0, or cohesion reaches across the gap.
  template <class Visit>
  void for_each_contact(std::size_t i, Visit&& visit) const {
    if (!material(i).interacts) return;
    // Pairs further apart than this, m, are skipped: twice as far as contacts reach, so that rounding can't matter.
    const double far = 2 * (2 * rules_.largest_radius() + rules_.widest_range());
    for (std::size_t p = 0; p < p_.size(); ++p) {
      if (is_farther(far, p_.position[i], p_.position[p]) || !material(p).interacts) continue;
      for_each_image(p_.position[i], p_.position[p], images_, [&](const ImageIndex& image, const Vec3d& x_ip) {
        if (p == i && image == ImageIndex{}) return;
        const auto [overlap, normal] =
            pair_geometry(x_ip, material(i).radius + material(p).radius, p_.id[i] > p_.id[p] ? 1.0 : -1.0);
        if (!(overlap > -rules_.pair(p_.material[i], p_.material[p]).range) || springs_.excludes(p_.id[i], p_.id[p]))
          return;
        visit(p, normal, overlap);
      });
    }
  }

  // visit(normal, overlap) for every wall that acts on particle i.
  template <class Visit>
  void for_each_wall(std::size_t i, Visit&& visit) const {
    hooke::for_each_wall(walls_, p_.position[i], material(i).radius, rules_.wall(p_.material[i]).range,
                         [&](int, const Vec3d& normal, double overlap) { visit(normal, overlap); });
  }

  // visit(index, collider, face, overlap) for every face of a collider that acts on particle i, in the scene's order,
  // image by image.
  template <class Visit>
  void for_each_collider(std::size_t i, Visit&& visit) const {
    const double radius = material(i).radius;
    for (std::size_t k = 0; k < colliders_.all.size(); ++k) {
      const std::size_t c = colliders_.of[k];
      for_each_collider_face(colliders_.all[k], p_.position[i], [&](const ColliderFace<double>& face) {
        const double overlap = radius - face.distance;
        if (overlap > -rules_.collider(p_.material[i], c).range) visit(c, colliders_.all[k], face, overlap);
      });
    }
  }

  // Removes the particles for which gone(i); under velocity Verlet, with kick_to_come, at their velocities after the
  // coming half kick.
  template <class Gone>
  RemovalSums remove_where(const Gone& gone, bool kick_to_come = true) {
    RemovalSums removed;
    std::vector<bool> goes(p_.size());
    for (std::size_t i = 0; i < p_.size(); ++i) goes[i] = gone(i);
    add_elastic([&](std::size_t i) { return goes[i]; }, removed.elastic);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < p_.size(); ++i) {
      if (goes[i]) {
        const bool kicked = verlet() && kick_to_come && !springs_.is_pinned(p_.id[i]);
        const Vec3d v = kicked ? kick(p_.velocity[i], p_.acceleration[i], scene_.time_step / 2) : p_.velocity[i];
        removed.add_particle(material(i).mass, p_.position[i], v, scene_.gravity);
        continue;
      }
      p_.id[kept] = p_.id[i];
      p_.material[kept] = p_.material[i];
      p_.position[kept] = p_.position[i];
      p_.velocity[kept] = p_.velocity[i];
      if (verlet()) p_.acceleration[kept] = p_.acceleration[i];
      ++kept;
    }
    p_.resize(kept);
    return removed;
  }

  // Adds the energy of the contacts between particles and of the springs that end at a particle for which among(i).
  template <class Among>
  void add_elastic(const Among& among, ExactSum& sum) const {
    for (std::size_t i = 0; i < p_.size(); ++i) {
      if (!among(i)) continue;
      for_each_contact(i, [&](std::size_t p, const Vec3d&, double overlap) {
        sum.add((among(p) ? 0.5 : 1) * contact_energy(overlap, pair(i, p)));
      });
    }
    springs_.add_energy(p_, [&](std::size_t i, std::size_t p) { return among(i) || among(p); }, sum);
  }

  void place_colliders_at(const Instant& now) {
    colliders_ = hooke::place_colliders<double>(scene_, now.poses, rules_.largest_body_distance());
  }

  Scene scene_;
  Rules<double> rules_;
  ReferenceSprings springs_;
  ReferenceAttraction attraction_;
  Vec3d period_{};  // m; infinite along an axis that isn't periodic
  PeriodicImages images_;
  Walls walls_;
  PlacedColliders<double> colliders_;
  std::vector<ShapeGeometry<double>> sinks_;
  std::map<std::uint64_t, Vec3d> external_;  // N, by id
  ParticleSet p_;
  StageTimes times_;
};

}  // namespace

std::unique_ptr<Backend> make_reference_backend() { return std::make_unique<ReferenceBackend>(); }

}  // namespace hooke
