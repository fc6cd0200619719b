// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/simulation.h"

#include <algorithm>
#include <utility>

#include "hooke/base/ascending.h"
#include "hooke/base/assert.h"
#include "hooke/base/floating_point.h"
#include "hooke/base/format.h"
#include "hooke/base/hash.h"
#include "hooke/base/printable.h"
#include "hooke/core/particle_checks.h"
#include "hooke/core/simulation_impl.h"

namespace hooke {
namespace {

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

// The particles of a simulation into the caller's columns.
template <class Real, class Impl>
Expected<void> copy_particles_of(Impl& s, const ParticleColumns<Real>& out) {
  const FloatingPointGuard guard;
  return s.guarded([&]() -> Expected<void> {
    if (s.ranks.is_serial()) {
      s.backend->download(out);
    } else {
      copy_columns(s.snapshot()->particles, out);
    }
    return {};
  });
}

}  // namespace

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
  if (auto started = impl->start(SlicesOfSet(particles), true, {}); !started) return fail(started.error());
  particles = ParticleSet{};  // the back end has them now; measuring may need the room
  return Impl::begin(std::move(impl));
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
std::unique_ptr<const ParticleSlices> Simulation::slices() const { return impl_->slices(); }
Expected<void> Simulation::copy_particles(const ParticleColumns<double>& out) const {
  return copy_particles_of(*impl_, out);
}
Expected<void> Simulation::copy_particles(const ParticleColumns<float>& out) const {
  return copy_particles_of(*impl_, out);
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
    s.forget_copies();
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
    s.forget_copies();
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
    return s.start(SlicesOfSet(now), true, s.backend->broken_springs());
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
  if (auto started = s.start(SlicesOfSet(all->particles), false, broken); !started) return started;
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
  SimulationState state = state_besides_particles();
  state.particles = particles();
  return state;
}

SimulationState Simulation::state_besides_particles() const {
  const FloatingPointGuard guard;
  Impl& s = *impl_;
  return {{},
          s.run.step,
          s.run.next_id,
          s.ledger(),
          s.scene.structure,
          s.broken_springs(),
          s.initial_energy,
          s.initial_elastic,
          s.initial_momentum,
          s.run.emission.state()};
}

Expected<void> Simulation::restore(SimulationState state) {
  const FloatingPointGuard guard;
  const ParticleSet& particles = state.particles;
  return impl_->restore(state, SlicesOfSet(particles), check_particles(impl_->scene, particles, true),
                        particles.empty() ? 0 : particles.id.back());
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
