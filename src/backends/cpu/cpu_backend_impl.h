// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hooke/backends/cpu/applied_forces.h"
#include "hooke/backends/cpu/isa.h"
#include "hooke/backends/cpu/particle_state.h"
#include "hooke/backends/cpu/tile_report.h"
#include "hooke/backends/cpu/verlet_list.h"
#include "hooke/base/parallel.h"
#include "hooke/base/threads.h"
#include "hooke/core/backend.h"
#include "hooke/core/placed_colliders.h"
#include "hooke/core/shared_particles.h"
#include "hooke/core/sums.h"
#include "hooke/neighbours/neighbour_list.h"
#include "hooke/passes/contact_scan.h"
#include "hooke/passes/departures.h"
#include "hooke/passes/pass_rules.h"
#include "hooke/passes/placed_sinks.h"

namespace hooke {

/// The step of one precision: which part does what, in which order. The parts are in the files that this one includes.
/// Members are defined by subject: cpu_backend.cpp (scene and particles), cpu_backend_motion.cpp (motion and
/// neighbours), cpu_backend_pass.cpp (forces), cpu_backend_population.cpp (births and removals),
/// cpu_backend_figures.cpp (measurements) and cpu_backend_ranks.cpp (ghosts).
template <class Real>
class CpuBackend final : public Backend, private SharedParticles {
  using Record = ParticleRecord<Real>;
  static constexpr std::size_t kLanes = NeighbourList::kLanes;
  static constexpr std::size_t kSlices = NeighbourList::kSlices;
  static constexpr std::size_t kTile = NeighbourList::kTile;

 public:
  CpuBackend(const Isa& isa, const Loops<Real>& loops, int threads, bool check_list)
      : isa_name_(isa.name),
        loops_(loops),
        threads_(threads),
        check_list_(check_list) {}

  BackendInfo info() const override {
    const auto precision = sizeof(Real) == 4 ? Precision::single_precision : Precision::double_precision;
    return {"cpu", isa_name_, precision, threads_.count()};
  }

  void configure(const Scene& scene) override;
  void break_springs(const std::vector<std::uint64_t>& broken) override { applied_.springs().break_springs(broken); }
  std::vector<std::uint64_t> broken_springs() const override { return applied_.springs().broken(); }

  void assign(const ParticleSet& particles) override {
    is_part_ = false;
    list_.share(false);
    take(particles);
  }
  void download(const ParticleColumns<double>& out) const override {
    threads_.run([&] { particles_.download(out); });
  }
  void download(const ParticleColumns<float>& out) const override {
    threads_.run([&] { particles_.download(out); });
  }
  std::uint64_t particle_count() const override { return particles_.count(); }
  std::optional<ParticleAt> find(std::uint64_t id) const override;
  void edit(std::span<const ParticleAt> edited) override;
  std::optional<std::uint64_t> set_external_forces(std::span<const std::uint64_t> ids,
                                                   std::span<const Vec3d> forces) override;
  RemovalSums insert(const ParticleSet& newborn) override;
  Removal remove(std::span<const std::uint64_t> ids) override;
  RemovalSums remove_sunk() override;

  void half_kick_and_drift() override;
  void follow_motion() override;
  void remove_departed(RemovalSums& left) override;
  bool neighbours_stale() override;
  Condition build_neighbours() override;
  void apply_forces(const Instant& now, StepReport& report) override;
  void evaluate_accelerations(const Instant& now, StepReport& report) override;

  void find_inside(const Box3d& box, std::vector<Occupant>& out) const override;
  std::uint64_t particles_hash() const override;
  Expected<MeasurementSums> measure(const Instant& now) override;
  NeighbourStatistics neighbour_statistics() const override;
  StageTimes stage_times() const override { return times_; }
  SharedParticles* shared() override { return this; }

 private:
  bool verlet() const { return particles_.verlet(); }

  template <class Body>
  void for_ranges(std::size_t count, std::size_t grain, const Body& body) const {
    threads_.run([&] { parallel_ranges(count, grain, body); });
  }

  void take(const ParticleSet& particles, std::size_t births = 0);
  void forget_layout();
  void make_room(std::size_t births);

  // Neighbours -------------------------------------------------------------------------------------------------------

  Condition sort_by_cell();
  void list_neighbours();

  // Springs, fields, attraction and pinned particles
  // -------------------------------------------------------------------

  void lay_out_structure();
  void apply_others(bool may_tear, StepReport& report);
  void finish_tile(std::size_t s, Vec3<Real>* acceleration, AppliedSums& sums);

  // The force pass and what it reports -------------------------------------------------------------------------------

  void place_at(const Instant& now);
  TilePass<Real> make_pass(Vec3<Real>* acceleration);
  ContactScan<Real> contact_scan() const { return {rules_, colliders_.view(), particles_.records.data()}; }
  template <class Look>
  void run_pass(const TilePass<Real>& pass, StepReport& sums, const Look& look);
  void run_tile(const TilePass<Real>& pass, std::size_t s, TileReport& report) const;
  void run_slices(const TilePass<Real>& pass, std::size_t s, std::size_t g, std::size_t end, const std::uint32_t* rows,
                  const std::uint32_t* first_row, TileReport& report) const;

  // The rows of a slice in the neighbour list; noninteracting slices have none.
  std::span<const std::uint32_t> rows_of(std::size_t s, std::size_t g) const {
    if (particles_.slots.is_noninteracting(s * kTile)) return {};
    return list_.rows(s, g);
  }

  Condition check_contacts(std::size_t s, std::size_t g, bool moved) const;
  // Births and removals ---------------------------------------------------------------------------------------------

  // Wraps periodic coordinates; a particle outside an open face leaves.
  void apply_boundaries(Record& p, std::size_t slot, Departures& left) const {
    wrap_periodic(rules_.view(), p.x);
    if (is_outside_open_face(rules_.view(), p.x)) leave(p, slot, p.v, left);
  }

  void apply_boundaries_to_slice(std::size_t s, std::size_t g, Departures& left);

  // Notes that particle p leaves, with velocity v; it stays until let_go().
  void leave(const Record& p, std::size_t slot, const Vec3<Real>& v, Departures& left) const {
    left.add(slot, particles_.material_of(p).mass, vec_cast<double>(p.x), vec_cast<double>(v), scene_.gravity);
  }

  void leave_at_end_of_step(std::size_t slot, Departures& left) const;
  void collect(Departures& total, const Departures& part) const;
  RemovalSums let_go(Departures& leaving);
  void add_elastic(std::vector<std::uint32_t>& slots, ExactSum& sum);
  bool rebuild_under(std::vector<std::uint32_t>& slots);

  // One of several ranks
  // -----------------------------------------------------------------------------------------------

  using Traveller = typename ParticleState<Real>::Traveller;

  void assign_part(const ParticleSet& own, std::span<const IdRun> all) override;
  void sample(std::vector<WeightedPoint>& points) const override;
  void move_out(const Decomposition& space, int here, std::vector<Parcel>& out) override;
  void move_in(std::span<const Parcel> in) override;
  double largest_radius() const override;
  GhostWidth next_width() override;
  std::vector<std::uint32_t> wanted() const override;
  bool wants_all() const override { return scene_.attraction.has_value(); }
  void copy_out(const GhostZones& zones, std::span<const WantedParticles> wanted, std::vector<Parcel>& out) override;
  bool has_springs() const override { return scene_.structure != nullptr; }
  std::vector<std::uint32_t> take_torn() override { return applied_.springs().take_torn(); }
  void tear(std::span<const std::uint32_t> springs) override {
    for (const std::uint32_t spring : springs) applied_.springs().tear(spring);
  }
  void take_ghosts(std::span<const Parcel> in) override;
  std::uint64_t own_count() const override { return particles_.count(); }
  std::size_t copy_bytes() const override;
  std::size_t packed_bytes() const override;
  std::size_t copied_count() const override { return copied_.size(); }
  std::size_t ghost_count() const override { return ghost_slots_.size(); }
  void pack(std::span<std::byte> out) const override;
  void unpack(std::span<const std::byte> in) override;
  FrameDisplacements displacements() const override;
  std::int64_t list_excess() const override { return list_.excess(); }
  bool has_lost_outlier(const GhostZones& zones, const Vec3d& common) const override;
  bool has_departures() const override;

  RemovalSums insert_part(const ParticleSet& newborn, const Decomposition& space, int here) override;
  bool has_cohesion() const override { return rules_.widest_range() > 0; }
  void add_elastic_of(std::span<const std::uint64_t> ids, ExactSum& sum) override;
  std::size_t id_count() const override { return particles_.ids.size(); }

  std::vector<std::uint32_t> ghosts_of(std::span<const std::uint64_t> ids) const;
  Box3d own_box_of(const GhostZones& zones) const;
  void follow_ghosts();
  void find_departures() override;
  bool has_open_face() const;
  static void renumber(std::vector<std::uint32_t>& slots, std::size_t first, std::span<const std::uint32_t> order);
  void sort_ghosts_by_cell();

  std::string isa_name_;
  Loops<Real> loops_;
  mutable Threads threads_;
  bool check_list_;
  mutable std::mutex mutex_;  // guards the totals of a pass

  Scene scene_;
  PassRules<Real> rules_;
  PlacedColliders<Real> colliders_;  // at the last instant

  ParticleState<Real> particles_;
  Departures leaving_;  // through open faces, until remove_departed()

  PlacedSinks sinks_;
  AppliedForces<Real> applied_;
  VerletList<Real> list_;
  bool is_part_ = false;  // this is one of several ranks
  bool is_built_ = false;  // its list is of the particles that it has now
  std::vector<std::uint32_t> copied_, ghost_slots_;  // slots, in the order of messages
  std::vector<std::uint32_t> leaving_ghosts_;  // slots, ascending: whose particles leave now
  std::uint64_t missed_contacts_ = 0;
  StageTimes times_;
};

}  // namespace hooke
