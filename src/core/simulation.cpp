// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/simulation.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "hooke/base/ascending.h"
#include "hooke/base/assert.h"
#include "hooke/base/bytes.h"
#include "hooke/base/floating_point.h"
#include "hooke/base/format.h"
#include "hooke/base/hash.h"
#include "hooke/base/printable.h"
#include "hooke/core/particle_checks.h"
#include "hooke/core/snapshot_pool.h"
#include "hooke/core/step.h"
#include "hooke/core/structure_message.h"

namespace hooke {
namespace {

Unexpected no_backend() { return fail(Error::Kind::bad_input, "backend", "there is none: it is null"); }

template <class Real>
void copy_columns(const ParticleSet& from, const ParticleColumns<Real>& to) {
  const auto vectors = [](const std::vector<Vec3d>& column, Vec3<Real>* out) {
    for (std::size_t i = 0; out != nullptr && i < column.size(); ++i) out[i] = vec_cast<Real>(column[i]);
  };
  if (to.id != nullptr) std::copy(from.id.begin(), from.id.end(), to.id);
  if (to.material != nullptr) std::copy(from.material.begin(), from.material.end(), to.material);
  vectors(from.position, to.position);
  vectors(from.velocity, to.velocity);
  vectors(from.acceleration, to.acceleration);
}

Error out_of_memory(std::int64_t step) {
  return {Error::Kind::run_failed, {{formatted("step {}", step), "out of memory"}}};
}

}  // namespace

struct Simulation::Impl {
  explicit Impl(std::shared_ptr<Communicator> communicator) : ranks(std::move(communicator)) {}
  ~Impl() { lead(Order::end); }

  Scene scene;
  std::unique_ptr<Backend> backend;
  Ranks ranks;
  RunState run;
  double initial_energy = 0, initial_elastic = 0;
  Vec3d initial_momentum{0, 0, 0};

  // The particles on the host: copied on the first access after a change, null before.
  std::shared_ptr<const Snapshot> host;
  SnapshotPool pool;
  StageTimes stage_times;  // of steps

  bool failed = false;
  Error failure;

  // What rank 0 has the others do (follow()), each time that it does so itself.
  enum class Order : std::uint8_t { start, step, count, hash, ledger, measure, gather, broken, neighbours, costs, end };
  struct StartOrder {
    std::int64_t step;
    std::uint64_t next_id;
    double kick;  // LedgerSums::kick
    bool take_accelerations;
  };
  template <class... Details>
  void lead(Order order, const Details&... details) {
    if (ranks.is_serial() || !ranks.leads()) return;
    std::vector<std::byte> bytes;
    append_bytes(bytes, order);
    (append_bytes(bytes, details), ...);
    ranks.communicator().broadcast(bytes);
  }

  // What several ranks can't do yet.
  Expected<void> check_ranks() const {
    if (ranks.is_serial() || backend->shared() != nullptr) return {};
    return fail(Error::Kind::bad_input, backend->info().device, "this device can't compute on several ranks yet");
  }
  // For what changes single particles, materials and motions, of which the other ranks would not know.
  Expected<void> check_alone() const {
    if (ranks.is_serial()) return {};
    return fail(Error::Kind::bad_input, "simulation", "can't be changed while several ranks compute it");
  }

  bool single() const { return scene.precision == Precision::single_precision; }
  double mass_of(std::size_t material) const { return scene.materials[material].mass; }

  const std::shared_ptr<const Snapshot>& snapshot() {
    if (host) return host;
    const std::shared_ptr<Snapshot> now = pool.take();
    now->step = run.step;
    now->time = static_cast<double>(run.step) * scene.time_step;
    gather(now->particles);
    return host = now;
  }

  // Rank 0 gets all particles.
  void gather(ParticleSet& particles) {
    lead(Order::gather);
    download(*backend, scene.integrator, particles);
    ranks.gather(particles);
  }

  // Runs what changes or asks the back end. If memory runs out or a device fails, the back end's state is unknown: the
  // simulation fails.
  template <class Body>
  auto guarded(const Body& body) -> decltype(body()) {
    if (failed) return fail(failure);
    try {
      return body();
    } catch (const std::bad_alloc&) {
      failed = true;
      failure = out_of_memory(run.step);
      if (!ranks.is_serial()) ranks.communicator().abort(failure.text());
      return fail(failure);
    } catch (const DeviceFailure& of_device) {
      return device_failed(of_device);
    }
  }

  Unexpected device_failed(const DeviceFailure& of_device) {
    failed = true;
    failure = Error{Error::Kind::run_failed, {{backend->info().device, of_device.what()}}};
    return fail(failure);
  }

  Expected<ParticleAt> find(std::uint64_t id) const {
    if (const auto found = backend->find(id)) return *found;
    return fail(Error::Kind::bad_input, formatted("particle {}", id), "there is none of this id");
  }

  void edit(const ParticleAt& before, const ParticleAt& after) {
    host.reset();
    backend->edit({&after, 1});
    const auto stored = backend->find(after.id);  // in the back end's precision
    initial_momentum += mass_of(before.material) * (stored->velocity - before.velocity);
  }

  template <class Real>
  Expected<void> copy_particles(const ParticleColumns<Real>& out) {
    const FloatingPointGuard guard;
    return guarded([&]() -> Expected<void> {
      if (ranks.is_serial()) {
        backend->download(out);
      } else {
        copy_columns(snapshot()->particles, out);
      }
      return {};
    });
  }

  Expected<void> check(const Condition& condition) {
    if (condition.good()) return {};
    failed = true;
    failure = Error{Error::Kind::run_failed,
                    {{formatted("step {} (t = {:.6g} s)", run.step, static_cast<double>(run.step) * scene.time_step),
                      describe(condition)}}};
    return fail(failure);
  }

  std::string describe(const Condition& condition) {
    const double speed = std::abs(condition.speed), moved = speed * scene.time_step;
    const bool part = condition.speed < 0;
    switch (condition.kind) {
      case Condition::Kind::good:
        break;
      case Condition::Kind::not_finite:
        return formatted("particle {} is no longer at a finite position; {}", condition.particle, likely_cause());
      case Condition::Kind::grid_overflow:
        return formatted("particle {} is too far away for the cell grid; {}", condition.particle, likely_cause());
      case Condition::Kind::pair_too_fast:
        return formatted("particles {} and {} {} at {:.6g} m/s, {:.3g} m in one step: {}; {}", condition.particle,
                         condition.partner, part ? "part" : "approach", speed, moved,
                         part ? "they have passed through each other" : "more than the smaller radius", likely_cause());
      case Condition::Kind::wall_too_fast:
        return formatted("particle {} approaches a wall at {:.6g} m/s, {:.3g} m in one step: more than its radius; {}",
                         condition.particle, speed, moved, likely_cause());
      case Condition::Kind::collider_too_fast:
        return formatted("particle {} and collider \"{}\" {} at {:.6g} m/s, {:.3g} m in one step: {}; {}",
                         condition.particle, printable(scene.colliders[condition.partner].name),
                         part ? "part" : "approach", speed, moved,
                         part ? "it has passed through" : "more than the particle's radius", likely_cause());
    }
    return {};
  }

  std::string likely_cause() {
    ParticleSet now;
    if (scene.structure) {
      download(*backend, scene.integrator, now);
      ranks.gather(now);  // all ranks have found the same condition
    }
    if (!ranks.leads()) return {};
    const StableStep stable = stable_step(scene, now);
    if (std::string unstable = unstable_step(scene, stable); !unstable.empty()) return "time.step " + unstable;
    return formatted(
        "time.step {:.6g} s is below the stable step {:.6g} s, so look at the start (overlaps, speeds) or "
        "take a smaller step",
        scene.time_step, stable.seconds);
  }

  // A back end in double precision, like the reference, takes every scene; one in single must not be given a scene that
  // asks for double.
  Expected<void> check_precision() const {
    if (scene.precision == Precision::single_precision || backend->info().precision == scene.precision) return {};
    return fail(Error::Kind::bad_input, "precision",
                "the scene asks for double, the back end computes in single precision");
  }

  // Hands all particles to the back end. Under velocity Verlet those that are new get their first accelerations.
  Expected<void> start(const ParticleSet& particles, bool are_new, const std::vector<std::uint64_t>& broken_springs) {
    if (auto right = check_precision(); !right) return right;
    if (auto can = check_ranks(); !can) return can;
    const bool take_accelerations = !particles.empty() && are_new;
    lead_start(take_accelerations, broken_springs);
    return start_here(particles, take_accelerations, broken_springs);
  }

  void lead_start(bool take_accelerations, const std::vector<std::uint64_t>& broken_springs) {
    if (ranks.is_serial() || !ranks.leads()) return;
    const EmissionState emission = run.emission.state();
    std::vector<std::byte> details;
    append_column(details, emission.emitters);
    append_column(details, emission.mortals);
    append_column(details, broken_springs);
    if (scene.structure) append_structure(details, *scene.structure);
    lead(Order::start, StartOrder{run.step, run.next_id, run.ledger.kick, take_accelerations}, details);
  }
  void follow_start(std::span<const std::byte> from) {
    StartOrder start{};
    take_bytes(from, start);
    EmissionState emission;
    take_column(from, emission.emitters);
    take_column(from, emission.mortals);
    std::vector<std::uint64_t> broken_springs;
    take_column(from, broken_springs);
    scene.structure = from.empty() ? nullptr : std::make_shared<Structure>(take_structure(from));
    run.emission.restore(std::move(emission));
    run.step = start.step;
    run.next_id = start.next_id;
    run.ledger = {};
    run.ledger.kick = start.kick;
    failed = false;
    (void)start_here({}, start.take_accelerations, broken_springs);
  }

  Expected<void> start_here(const ParticleSet& particles, bool take_accelerations,
                            const std::vector<std::uint64_t>& broken_springs) {
    host.reset();
    try {
      backend->configure(scene);
      run.emission.configure(scene);
      backend->break_springs(broken_springs);
      place_colliders(run, scene, run.step);
      ranks.assign(*backend, scene, particles);
      if (!take_accelerations) return {};
      return check(start_particles(scene, *backend, ranks, run));
    } catch (const std::bad_alloc& memory) {
      const std::string why = memory.what();  // a GPU says how much it lacks
      failed = true;
      failure = Error{Error::Kind::bad_input,
                      {{"particles", formatted("{} particles do not fit into memory{}", particles.size(),
                                               why == std::bad_alloc().what() ? "" : " (" + why + ")")}}};
      if (!ranks.is_serial()) ranks.communicator().abort(failure.text());
      return fail(failure);
    } catch (const DeviceFailure& of_device) {
      return device_failed(of_device);
    }
  }

  Expected<void> take_steps(std::int64_t count) {
    lead(Order::step, count);
    return guarded([&]() -> Expected<void> {
      if (count == 0) return {};
      host.reset();
      for (const std::int64_t last = run.step + count; run.step < last;) {
        if (auto taken = check(take_step(scene, *backend, ranks, run, last - run.step)); !taken) return taken;
      }
      // Particles that the last step has lost are reported before the state can be saved.
      return check(update_neighbours(*backend, ranks));
    });
  }

  std::uint64_t particle_count() {
    lead(Order::count);
    std::uint64_t count = backend->particle_count();
    ranks.sum(count);
    return count;
  }
  std::vector<std::uint64_t> broken_springs() {
    lead(Order::broken);
    std::vector<std::uint64_t> broken = backend->broken_springs();
    ranks.unite(broken);
    return broken;
  }
  RankCosts rank_costs() {
    lead(Order::costs);
    return ranks.costs(backend->particle_count());
  }
  NeighbourStatistics neighbour_statistics() {
    lead(Order::neighbours);
    NeighbourStatistics statistics = backend->neighbour_statistics();
    ranks.sum(statistics.missed_contacts);
    return statistics;
  }
  std::uint64_t particles_hash() {
    lead(Order::hash);
    std::uint64_t hash = backend->particles_hash();
    ranks.sum(hash);
    return hash;
  }
  LedgerSums ledger() {
    lead(Order::ledger);
    LedgerSums sums = run.ledger;
    ranks.sum(sums);
    return sums;
  }
  Expected<Measurements> measure() {
    lead(Order::measure);
    return guarded([&]() -> Expected<Measurements> {
      const Instant now = place_colliders(run, scene, run.step);
      if (!ranks.is_serial()) {
        if (auto listed = check(update_neighbours(*backend, ranks)); !listed) return fail(listed.error());
      }
      auto sums = backend->measure(now);
      if (!sums) return fail(sums.error());
      ranks.sum(*sums);
      return sums->result(scene.colliders.size());
    });
  }

  // Ranks above 0: does what rank 0 orders, until it ends. A failure is that of all ranks, and rank 0 reports it.
  void follow() {
    for (;;) {
      std::vector<std::byte> bytes;
      ranks.communicator().broadcast(bytes);
      std::span<const std::byte> from = bytes;
      Order order{};
      take_bytes(from, order);
      switch (order) {
        case Order::start:
          follow_start(from);
          break;
        case Order::step: {
          std::int64_t count = 0;
          take_bytes(from, count);
          (void)take_steps(count);
          break;
        }
        case Order::count:
          (void)particle_count();
          break;
        case Order::hash:
          (void)particles_hash();
          break;
        case Order::ledger:
          (void)ledger();
          break;
        case Order::measure:
          (void)measure();
          break;
        case Order::gather: {
          ParticleSet own;
          gather(own);
          break;
        }
        case Order::costs:
          (void)rank_costs();
          break;
        case Order::broken:
          (void)broken_springs();
          break;
        case Order::neighbours:
          (void)neighbour_statistics();
          break;
        case Order::end:
          return;
      }
    }
  }
};

Simulation::Simulation(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

Expected<Simulation> Simulation::create(Scene scene, ParticleSet particles, std::unique_ptr<Backend> backend,
                                        const CreateOptions& options) {
  auto impl = std::make_unique<Impl>(options.communicator);
  if (backend == nullptr) return no_backend();
  const FloatingPointGuard guard;
  std::vector<Finding> findings = validate(scene);
  if (findings.empty()) findings = check_particles(scene, particles, false);
  if (findings.empty() && scene.structure) findings = check_ids(*scene.structure, particles);
  if (findings.empty() && !options.allow_unstable_step) {
    std::string unstable = unstable_step(scene, stable_step(scene, particles));
    if (!unstable.empty()) findings.push_back({"time.step", std::move(unstable)});
  }
  if (!findings.empty()) return fail(Error{Error::Kind::bad_input, std::move(findings)});

  impl->scene = std::move(scene);
  impl->backend = std::move(backend);
  impl->run.next_id = particles.empty() ? 1 : particles.id.back() + 1;
  if (auto started = impl->start(particles, true, {}); !started) return fail(started.error());
  particles = ParticleSet{};  // the back end has them now; measuring may need the room
  Simulation simulation(std::move(impl));
  const auto now = simulation.measure();
  if (!now) return fail(now.error());
  const double elastic = now->elastic_energy + now->spring_energy;
  simulation.impl_->initial_elastic = elastic;
  simulation.impl_->initial_energy = now->kinetic_energy + now->potential_energy + elastic + now->attraction_energy;
  simulation.impl_->initial_momentum = now->momentum;
  return simulation;
}

Expected<Simulation> Simulation::resume(Scene scene, SimulationState state, std::unique_ptr<Backend> backend,
                                        std::shared_ptr<Communicator> communicator) {
  auto impl = std::make_unique<Impl>(std::move(communicator));
  if (backend == nullptr) return no_backend();
  const FloatingPointGuard guard;
  std::vector<Finding> findings = validate(scene);
  if (!findings.empty()) return fail(Error{Error::Kind::bad_input, std::move(findings)});
  impl->scene = std::move(scene);
  impl->backend = std::move(backend);
  Simulation simulation(std::move(impl));
  if (auto restored = simulation.restore(std::move(state)); !restored) return fail(restored.error());
  return simulation;
}

void Simulation::follow(Scene scene, std::unique_ptr<Backend> backend, std::shared_ptr<Communicator> communicator) {
  HOOKE_ASSERT(backend != nullptr && communicator != nullptr && communicator->rank() > 0);
  const FloatingPointGuard guard;
  Impl impl(std::move(communicator));
  impl.scene = std::move(scene);
  impl.backend = std::move(backend);
  impl.follow();
}

Expected<void> Simulation::step(std::int64_t count) {
  const FloatingPointGuard guard;
  Impl& s = *impl_;
  if (count < 0) return fail(Error::Kind::bad_input, "step", formatted("{} steps; 0 or more are possible", count));
  const StageTimes before = s.backend->stage_times();
  auto taken = s.take_steps(count);
  s.stage_times += s.backend->stage_times() - before;
  return taken;
}

const Scene& Simulation::scene() const { return impl_->scene; }
std::int64_t Simulation::step_count() const { return impl_->run.step; }
double Simulation::time() const { return static_cast<double>(impl_->run.step) * impl_->scene.time_step; }
std::uint64_t Simulation::particle_count() const { return impl_->particle_count(); }
std::uint64_t Simulation::next_id() const { return impl_->run.next_id; }
BackendInfo Simulation::backend_info() const { return impl_->backend->info(); }
NeighbourStatistics Simulation::neighbour_statistics() const { return impl_->neighbour_statistics(); }
RankCosts Simulation::rank_costs() { return impl_->rank_costs(); }
const StageTimes& Simulation::stage_times() const { return impl_->stage_times; }

std::shared_ptr<const Snapshot> Simulation::snapshot() const { return impl_->snapshot(); }
Expected<void> Simulation::copy_particles(const ParticleColumns<double>& out) const {
  return impl_->copy_particles(out);
}
Expected<void> Simulation::copy_particles(const ParticleColumns<float>& out) const {
  return impl_->copy_particles(out);
}
const ParticleSet& Simulation::particles() const { return impl_->snapshot()->particles; }
std::span<const std::uint64_t> Simulation::ids() const { return particles().id; }
std::span<const Vec3d> Simulation::positions() const { return particles().position; }
std::span<const Vec3d> Simulation::velocities() const { return particles().velocity; }

Expected<std::vector<std::uint64_t>> Simulation::add_particles(std::span<const NewParticle> particles) {
  const FloatingPointGuard guard;
  Impl& s = *impl_;
  if (auto alone = s.check_alone(); !alone) return fail(alone.error());
  std::vector<Finding> findings;
  for (std::size_t i = 0; i < particles.size() && findings.size() < kMostFindings; ++i) {
    const NewParticle& p = particles[i];
    std::string fault = particle_fault(s.scene, p.material, p.position, p.velocity);
    if (!fault.empty()) findings.push_back({formatted("new particle {}", i), std::move(fault)});
  }
  if (!findings.empty()) return fail(Error{Error::Kind::bad_input, std::move(findings)});

  return s.guarded([&]() -> Expected<std::vector<std::uint64_t>> {
    ParticleSet added;
    added.reserve(particles.size());
    for (const NewParticle& p : particles) {
      added.id.push_back(s.run.next_id + added.id.size());
      added.material.push_back(static_cast<std::uint16_t>(p.material));
      added.position.push_back(p.position);
      added.velocity.push_back(p.velocity);
    }
    s.host.reset();
    s.backend->insert(added);
    s.run.next_id += added.size();
    for (const NewParticle& p : particles) s.initial_momentum += s.mass_of(p.material) * p.velocity;
    return std::move(added.id);
  });
}

Expected<void> Simulation::remove_particles(std::span<const std::uint64_t> ids) {
  const FloatingPointGuard guard;
  Impl& s = *impl_;
  if (auto alone = s.check_alone(); !alone) return alone;
  return s.guarded([&]() -> Expected<void> {
    std::vector<std::uint64_t> gone(ids.begin(), ids.end());
    std::sort(gone.begin(), gone.end());
    gone.erase(std::unique(gone.begin(), gone.end()), gone.end());
    for (const std::uint64_t id : gone) {
      if (const auto there = s.find(id); !there) return fail(there.error());
    }
    s.host.reset();
    s.initial_momentum -= s.backend->remove(gone).sums.momentum.value();
    return {};
  });
}

Expected<ParticleAt> Simulation::find(std::uint64_t id) const {
  if (auto alone = impl_->check_alone(); !alone) return fail(alone.error());
  return impl_->guarded([&] { return impl_->find(id); });
}

Expected<void> Simulation::apply_impulse(std::uint64_t id, const Vec3d& impulse) {
  const FloatingPointGuard guard;
  Impl& s = *impl_;
  if (auto alone = s.check_alone(); !alone) return alone;
  return s.guarded([&]() -> Expected<void> {
    const auto before = s.find(id);
    if (!before) return fail(before.error());
    ParticleAt after = *before;
    after.velocity += (1 / s.mass_of(after.material)) * impulse;
    // The position is not checked: a particle that presses into a soft wall may stand outside the domain and can still
    // be pushed.
    if (!is_finite(after.velocity, s.single())) {
      return fail(Error::Kind::bad_input, formatted("particle {}", id),
                  "velocity " + shown(after.velocity) + " is not finite");
    }
    s.edit(*before, after);
    return {};
  });
}

Expected<void> Simulation::set_particle(std::uint64_t id, const Vec3d& position, const Vec3d& velocity) {
  const FloatingPointGuard guard;
  Impl& s = *impl_;
  if (auto alone = s.check_alone(); !alone) return alone;
  return s.guarded([&]() -> Expected<void> {
    const auto before = s.find(id);
    if (!before) return fail(before.error());
    std::string fault = particle_fault(s.scene, before->material, position, velocity);
    if (!fault.empty()) return fail(Error::Kind::bad_input, formatted("particle {}", id), std::move(fault));
    s.edit(*before, {id, before->material, position, velocity});
    return {};
  });
}

Expected<void> Simulation::set_external_forces(std::span<const std::uint64_t> ids, std::span<const Vec3d> forces) {
  const FloatingPointGuard guard;
  Impl& s = *impl_;
  if (auto alone = s.check_alone(); !alone) return alone;
  if (ids.size() != forces.size()) {
    return fail(Error::Kind::bad_input, "forces", formatted("{} forces for {} ids", forces.size(), ids.size()));
  }
  std::vector<Finding> findings;
  const auto add_finding = [&](std::uint64_t id, std::string fault) {
    if (findings.size() < kMostFindings) findings.push_back({formatted("particle {}", id), std::move(fault)});
  };
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (!is_finite(forces[k], s.single())) add_finding(ids[k], "force " + shown(forces[k]) + " is not finite");
  }
  return s.guarded([&]() -> Expected<void> {
    if (!is_ascending(ids)) {
      std::vector<std::uint64_t> sorted(ids.begin(), ids.end());
      std::sort(sorted.begin(), sorted.end());
      const auto twin = std::adjacent_find(sorted.begin(), sorted.end());
      if (twin != sorted.end()) add_finding(*twin, "has more than one force");
    }
    if (!findings.empty()) return fail(Error{Error::Kind::bad_input, std::move(findings)});
    if (const auto unknown = s.backend->set_external_forces(ids, forces)) {
      return fail(Error::Kind::bad_input, formatted("particle {}", *unknown), "there is none of this id");
    }
    return {};
  });
}

Expected<void> Simulation::set_material(const Material& material) {
  const FloatingPointGuard guard;
  Impl& s = *impl_;
  if (auto alone = s.check_alone(); !alone) return alone;
  Scene changed = s.scene;
  for (std::size_t k = 0; k < changed.materials.size(); ++k) {
    Material& m = changed.materials[k];
    if (m.name != material.name) continue;
    const double more_mass = material.mass - m.mass;
    m = material;
    if (std::vector<Finding> findings = validate(changed); !findings.empty()) {
      return fail(Error{Error::Kind::bad_input, std::move(findings)});
    }
    const std::shared_ptr<const Snapshot> all = s.snapshot();
    const ParticleSet& now = all->particles;
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now.material[i] == k) s.initial_momentum += more_mass * now.velocity[i];
    }
    s.scene = std::move(changed);
    // All accelerations anew: those of the last step are of the old material.
    return s.start(now, true, s.backend->broken_springs());
  }
  return fail(Error::Kind::bad_input, "materials" + path_step(material.name), "there is no material of this name");
}

Expected<void> Simulation::cut_springs(std::span<const std::uint64_t> springs) {
  const FloatingPointGuard guard;
  Impl& s = *impl_;
  if (auto alone = s.check_alone(); !alone) return alone;
  const std::size_t count = s.scene.structure ? s.scene.structure->springs.size() : 0;
  std::vector<std::uint64_t> broken = s.backend->broken_springs();
  const std::size_t before = broken.size();
  for (const std::uint64_t spring : springs) {
    if (spring >= count) return fail(Error::Kind::bad_input, "springs", formatted("there is none of index {}", spring));
  }
  broken.insert(broken.end(), springs.begin(), springs.end());
  std::sort(broken.begin(), broken.end());
  broken.erase(std::unique(broken.begin(), broken.end()), broken.end());
  if (broken.size() == before) return fail(Error::Kind::bad_input, "springs", "there is none to cut");
  const auto whole = measure();
  if (!whole) return fail(whole.error());
  const std::shared_ptr<const Snapshot> all = s.snapshot();
  if (auto started = s.start(all->particles, false, broken); !started) return started;
  const auto cut = measure();
  if (!cut) return fail(cut.error());
  s.run.ledger.broken += broken.size() - before;
  s.run.ledger.broken_energy.add(whole->elastic_energy + whole->spring_energy);
  s.run.ledger.broken_energy.add(-(cut->elastic_energy + cut->spring_energy));
  return {};
}

std::span<const ColliderPose> Simulation::collider_poses() const { return impl_->run.poses; }

Expected<void> Simulation::set_collider_motion(const std::string& name, const Motion& motion) {
  const FloatingPointGuard guard;
  Impl& s = *impl_;
  if (auto alone = s.check_alone(); !alone) return alone;
  for (std::size_t k = 0; k < s.scene.colliders.size(); ++k) {
    if (s.scene.colliders[k].name != name) continue;
    const Motion before = std::exchange(s.scene.colliders[k].motion, motion);
    if (std::vector<Finding> findings = check_colliders(s.scene); !findings.empty()) {
      s.scene.colliders[k].motion = before;
      return fail(Error{Error::Kind::bad_input, std::move(findings)});
    }
    place_colliders(s.run, s.scene, s.run.step);
    return {};
  }
  return fail(Error::Kind::bad_input, "colliders", formatted("there is none of the name \"{}\"", name));
}

SimulationState Simulation::state() const {
  const FloatingPointGuard guard;
  Impl& s = *impl_;
  return {particles(),      s.run.step,       s.run.next_id,     s.ledger(),         s.scene.structure,
          broken_springs(), s.initial_energy, s.initial_elastic, s.initial_momentum, s.run.emission.state()};
}

Expected<void> Simulation::restore(SimulationState state) {
  const FloatingPointGuard guard;
  Impl& s = *impl_;
  std::vector<Finding> findings = check_particles(s.scene, state.particles, true);
  if (state.step < 0) findings.push_back({"step", formatted("{} must be 0 or more", state.step)});
  if (!state.particles.empty() && state.particles.id.back() >= state.next_id) {
    findings.push_back(
        {"next_id", formatted("{} is not above the largest id {}", state.next_id, state.particles.id.back())});
  }
  const auto& structure = s.scene.structure ? s.scene.structure : state.structure;
  if (structure && findings.empty()) findings = validate(*structure, s.single());
  const std::size_t springs = structure ? structure->springs.size() : 0;
  if (!is_ascending(state.broken_springs)) {
    findings.push_back({"broken_springs", "indices must be unique and ascending"});
  } else if (!state.broken_springs.empty() && state.broken_springs.back() >= springs) {
    findings.push_back(
        {"broken_springs", formatted("{} is no spring; there are {}", state.broken_springs.back(), springs)});
  }
  for (Finding& finding : check_state(state.emission, s.scene)) findings.push_back(std::move(finding));
  if (!findings.empty()) return fail(Error{Error::Kind::bad_input, std::move(findings)});
  s.scene.structure = structure;
  s.run.emission.restore(std::move(state.emission));
  s.run.step = state.step;
  s.run.next_id = state.next_id;
  s.run.ledger = state.ledger;
  s.initial_energy = state.initial_energy;
  s.initial_elastic = state.initial_elastic;
  s.initial_momentum = state.initial_momentum;
  s.failed = false;
  return s.start(state.particles, false, state.broken_springs);
}

std::uint64_t Simulation::state_hash() const {
  const FloatingPointGuard guard;
  Impl& s = *impl_;
  const auto clock = combine64(mix64(static_cast<std::uint64_t>(s.run.step)), s.run.next_id);
  return s.particles_hash() + clock;
}

Expected<Measurements> Simulation::measure() const {
  const FloatingPointGuard guard;
  return impl_->measure();
}

std::vector<std::uint64_t> Simulation::broken_springs() const { return impl_->broken_springs(); }
Ledger Simulation::ledger() const {
  const FloatingPointGuard guard;
  return impl_->ledger().read();
}

double Simulation::initial_energy() const { return impl_->initial_energy; }
double Simulation::initial_elastic() const { return impl_->initial_elastic; }
const Vec3d& Simulation::initial_momentum() const { return impl_->initial_momentum; }

}  // namespace hooke
