// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// What the ranks that compute a simulation do together: rank 0 orders, the others follow.

#include "hooke/base/assert.h"
#include "hooke/core/simulation_impl.h"
#include "hooke/core/step.h"
#include "hooke/core/structure_message.h"

namespace hooke {
// Of a simulation that several ranks compute.
class Simulation::Impl::SlicesOfRanks final : public ParticleSlices {
 public:
  explicit SlicesOfRanks(Impl& simulation) : simulation_(simulation), header_(simulation.begin_slices()) {}

  std::uint64_t size() const override { return header_.count; }
  std::uint64_t identity() const override { return header_.identity; }
  bool has_accelerations() const override { return header_.accelerated; }
  Expected<void> visit(std::size_t rows, const Take& take) const override {
    return simulation_.guarded([&]() -> Expected<void> {
      if (!simulation_.own_part) return fail(Error::Kind::bad_input, "slices", "the simulation has changed since");
      simulation_.visit(rows, take);
      return {};
    });
  }

 private:
  Impl& simulation_;
  SlicesHeader header_;
};

// Of the snapshot of one rank.
class Simulation::Impl::SlicesOfSnapshot final : public ParticleSlices {
 public:
  explicit SlicesOfSnapshot(std::shared_ptr<const Snapshot> snapshot)
      : snapshot_(std::move(snapshot)),
        slices_(snapshot_->particles) {}

  std::uint64_t size() const override { return slices_.size(); }
  std::uint64_t identity() const override { return slices_.identity(); }
  bool has_accelerations() const override { return slices_.has_accelerations(); }
  Expected<void> visit(std::size_t rows, const Take& take) const override { return slices_.visit(rows, take); }

 private:
  std::shared_ptr<const Snapshot> snapshot_;
  SlicesOfSet slices_;
};

std::unique_ptr<const ParticleSlices> Simulation::Impl::slices() {
  if (ranks.is_serial() || host) return std::make_unique<SlicesOfSnapshot>(snapshot());
  return std::make_unique<SlicesOfRanks>(*this);
}

Expected<void> Simulation::Impl::check_ranks() const {
  if (ranks.is_serial() || backend->shared() != nullptr) return {};
  return fail(Error::Kind::bad_input, backend->info().device, "this device can't compute on several ranks yet");
}

Expected<void> Simulation::Impl::check_alone() const {
  if (ranks.is_serial()) return {};
  return fail(Error::Kind::bad_input, "simulation", "can't be changed while several ranks compute it");
}

void Simulation::Impl::lead_start(bool take_accelerations, const std::vector<std::uint64_t>& broken_springs) {
  if (ranks.is_serial() || !ranks.leads()) return;
  const EmissionState emission = run.emission.state();
  std::vector<std::byte> details;
  append_column(details, emission.emitters);
  append_column(details, emission.mortals);
  append_column(details, broken_springs);
  if (scene.structure) append_structure(details, *scene.structure);
  lead(Order::start, StartOrder{run.step, run.next_id, run.ledger.kick, take_accelerations}, details);
}

void Simulation::Impl::follow_start(std::span<const std::byte> from) {
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
  (void)start_here(SlicesOfSet({}), start.take_accelerations, broken_springs);
}

void Simulation::Impl::gather(ParticleSet& particles) {
  lead(Order::gather);
  download(*backend, scene.integrator, particles);
  ranks.gather(particles);
}

// Each rank keeps its own particles until they change.
SlicesHeader Simulation::Impl::begin_slices() {
  lead(Order::slices);
  if (!own_part) {
    const auto copied = guarded([&]() -> Expected<void> {
      auto own = std::make_shared<ParticleSet>();
      download(*backend, scene.integrator, *own);
      own_part = std::move(own);
      return {};
    });
    if (!copied) own_part = std::make_shared<ParticleSet>();  // the simulation has failed: a visit will say so
  }
  SlicesHeader header{own_part->size(), SlicesOfSet(*own_part).identity(), !own_part->acceleration.empty()};
  ranks.sum(header);
  return header;
}

void Simulation::Impl::visit(std::size_t rows, const ParticleSlices::Take& take) {
  lead(Order::visit, rows);
  ranks.visit(*own_part, rows, take);
}

std::uint64_t Simulation::Impl::particle_count() {
  lead(Order::count);
  std::uint64_t count = backend->particle_count();
  ranks.sum(count);
  return count;
}

std::vector<std::uint64_t> Simulation::Impl::broken_springs() {
  lead(Order::broken);
  std::vector<std::uint64_t> broken = backend->broken_springs();
  ranks.unite(broken);
  return broken;
}

RankCosts Simulation::Impl::rank_costs() {
  lead(Order::costs);
  return ranks.costs(backend->particle_count());
}

NeighbourStatistics Simulation::Impl::neighbour_statistics() {
  lead(Order::neighbours);
  NeighbourStatistics statistics = backend->neighbour_statistics();
  ranks.sum(statistics.missed_contacts);
  return statistics;
}

std::uint64_t Simulation::Impl::particles_hash() {
  lead(Order::hash);
  std::uint64_t hash = backend->particles_hash();
  ranks.sum(hash);
  return hash;
}

LedgerSums Simulation::Impl::ledger() {
  lead(Order::ledger);
  LedgerSums sums = run.ledger;
  ranks.sum(sums);
  return sums;
}

Expected<Measurements> Simulation::Impl::measure() {
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

void Simulation::Impl::follow() {
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
      case Order::slices:
        (void)begin_slices();
        break;
      case Order::visit: {
        std::size_t rows = 0;
        take_bytes(from, rows);
        visit(rows, {});
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

}  // namespace hooke
