// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/cpu_backend.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "hooke/backends/cpu/applied_forces.h"
#include "hooke/backends/cpu/boundaries.h"
#include "hooke/backends/cpu/bounding_box.h"
#include "hooke/backends/cpu/collider_rules.h"
#include "hooke/backends/cpu/column_store.h"
#include "hooke/backends/cpu/contact_reports.h"
#include "hooke/backends/cpu/departures.h"
#include "hooke/backends/cpu/id_table.h"
#include "hooke/backends/cpu/isa.h"
#include "hooke/backends/cpu/particle_slots.h"
#include "hooke/backends/cpu/pass_rules.h"
#include "hooke/backends/cpu/segment_report.h"
#include "hooke/backends/cpu/threads.h"
#include "hooke/backends/cpu/verlet_list.h"
#include "hooke/base/huge_pages.h"
#include "hooke/base/parallel.h"
#include "hooke/base/stopwatch.h"
#include "hooke/core/state_hash.h"
#include "hooke/core/sums.h"
#include "hooke/neighbours/neighbour_list.h"
#include "hooke/physics/drag.h"
#include "hooke/physics/enclosure.h"
#include "hooke/physics/integrate.h"

namespace hooke {
namespace {

constexpr std::size_t kLanes = NeighbourList::kLanes;
constexpr std::size_t kGroups = NeighbourList::kGroups;
constexpr std::size_t kSegment = NeighbourList::kSegment;

// The state in one precision. Particles lie in cell order as of the last build; ranks lead back to ids.
template <class Real>
class CpuBackend final : public Backend {
  using Record = ParticleRecord<Real>;

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

  void configure(const Scene& scene) override {
    scene_ = scene;
    rules_.configure(scene);
    pass_ = rules_.pass;
    colliders_.configure(scene, pass_.material_count);
    list_.configure(rules_, loops_.search_group, applied_.springs().apart());
    applied_.configure(scene, rules_.pass, loops_);
    sinks_.clear();
    for (const Sink& sink : scene.sinks) {
      sinks_.push_back({bounds_of(sink.shape), geometry_of(sink.shape, false, {0, 0, 0})});
    }
  }

  void break_springs(const std::vector<std::uint64_t>& broken) override { applied_.springs().break_springs(broken); }
  std::vector<std::uint64_t> broken_springs() const override { return applied_.springs().broken(); }

  Condition upload(const ParticleSet& particles, std::uint64_t first_new_id, const Ledger& ledger) override {
    ledger_ = ledger;
    place(particles);
    const bool any_new = !particles.empty() && particles.id.back() >= first_new_id;
    return verlet() && any_new ? evaluate_accelerations(first_new_id) : Condition{};
  }

  void download(ParticleSet& out) const override {
    constexpr std::uint32_t kGone = ~std::uint32_t{0};
    std::vector<std::uint32_t> at(ids_.size(), kGone);  // by rank, so by id
    for (std::size_t i = 0; i < slots_.end(); ++i) {
      if (!is_nowhere(records_[i])) at[rank_of(records_[i].rank)] = static_cast<std::uint32_t>(i);
    }
    out.clear();
    out.resize(alive_);
    if (verlet()) out.acceleration.resize(alive_);
    std::size_t k = 0;
    for (std::size_t rank = 0; rank < at.size(); ++rank) {
      if (at[rank] == kGone) continue;
      const Record& record = records_[at[rank]];
      out.id[k] = ids_[rank];
      out.material[k] = static_cast<std::uint16_t>(record.material);
      out.position[k] = vec_cast<double>(record.x);
      out.velocity[k] = vec_cast<double>(record.v);
      if (verlet()) out.acceleration[k] = vec_cast<double>(acceleration_[at[rank]]);
      ++k;
    }
  }

  void set_time(double seconds) override { applied_.set_time(seconds); }

  void place_colliders(std::span<const ColliderPose> poses) override {
    colliders_.place(scene_, poses, rules_.largest_radius + rules_.widest_range, pass_);
  }

  void half_kick_and_drift() override {
    Stopwatch drifting(times_.drift);
    Departures removed;
    for_ranges(slots_.end(), kSegment, [&](std::size_t first, std::size_t last) {
      Departures left;
      for (std::size_t start = first; start < last; start += kLanes) {
        unsigned far = 0;
        for (std::size_t i = start; i < std::min(start + kLanes, last); ++i) {
          Record& p = records_[i];
          if (is_nowhere(p) || applied_.held().holds(i)) continue;
          p.v = kick(p.v, acceleration_[i], Real(0.5) * pass_.dt);
          p.x = drift(p.x, p.v, pass_.dt);
          if (list_.good() && !slots_.is_loose(i) && list_.is_far(p, i))
            far |= 1U << i % kLanes;  // asked of all: a removal must not hide a NaN
          apply_boundaries(p, i, left);
        }
        if (far != 0) list_.note_far(start / kLanes, far);
      }
      collect(removed, left);
    });
    drifting.stop();
    follow_motion();
    let_go(removed, ledger_.removed);
  }

  bool neighbours_stale() const override { return !list_.good(); }

  Condition build_neighbours() override {
    Condition condition;
    threads_.run([&] {
      condition = sort_by_cell();
      if (!condition.good()) return;
      lay_out_structure();
      list_neighbours();
    });
    return condition;
  }

  Condition apply_forces() override {
    Stopwatch forcing(times_.force);
    StepSums sums;
    AppliedSums applied;
    Departures removed;
    Condition condition;
    aim_pass(verlet() ? acceleration_.data() : nullptr);
    const bool released = apply_others(true, applied.springs);
    for_ranges(slots_.segment_count(), 1, [&](std::size_t first, std::size_t last) {
      SegmentReport report;
      StepSums part;
      std::optional<AppliedSums> applied_part;  // large, and of no use to most scenes
      if (!applied_.none()) applied_part.emplace();
      Departures left;
      Condition found;
      for (std::size_t n = first; n < last; ++n) {
        const std::size_t s = slots_.segment(n);
        run_segment(s, report);
        report.add_to(part);
        if (applied_part) settle_segment(s, *applied_part);
        for (std::size_t g = 0; g < kGroups; ++g) {
          if (report.far[g] != 0) list_.note_far(s * kGroups + g, report.far[g]);
          if (report.notes[g] == 0) continue;
          if ((report.notes[g] & kApproachTooFast) != 0) found = Condition::first(found, look_closely(s, g));
          if ((report.notes[g] & kLeftDomain) != 0) apply_boundaries_to_group(s, g, left);
        }
      }
      collect(removed, left);
      const std::lock_guard lock(mutex_);
      sums.add(part);
      if (applied_part) applied.add(*applied_part);
      condition = Condition::first(condition, found);
    });
    book_step(ledger_, sums, applied_.none() ? nullptr : &applied, scene_.gravity, total_mass_, scene_.time_step,
              scene_.integrator);
    records_.swap(next_);
    forcing.stop();
    if (!verlet()) {
      follow_motion();
    } else if (released) {  // nobody has moved; rows are mended before the next forces, but somebody may look
      threads_.run([&] { list_.mend_released(records_.data()); });
    }
    let_go(removed, ledger_.removed);
    return condition;
  }

  void sink_particles() override {
    Departures sunk;
    for_ranges(slots_.end(), kSegment, [&](std::size_t first, std::size_t last) {
      Departures part;
      for (std::size_t i = first; i < last; ++i) {
        if (!is_nowhere(records_[i]) && is_in_a_sink(vec_cast<double>(records_[i].x))) leave_at_end_of_step(i, part);
      }
      collect(sunk, part);
    });
    let_go(sunk, ledger_.population.sunk);
  }

  void expire(std::span<const std::uint64_t> ids, std::vector<std::uint8_t>& was_there) override {
    was_there.assign(ids.size(), 0);
    Departures expired;
    for_ranges(ids.size(), 256, [&](std::size_t first, std::size_t last) {
      Departures part;
      for (std::size_t k = first; k < last; ++k) {
        const std::size_t rank = ids_.find(ids[k]);
        if (rank == ids_.size()) continue;
        const std::size_t slot = applied_.place(rank);
        if (slot == SpringLists<Real>::kNowherePlace || is_nowhere(records_[slot]) ||
            rank_of(records_[slot].rank) != rank)
          continue;
        was_there[k] = 1;
        leave_at_end_of_step(slot, part);
      }
      collect(expired, part);
    });
    let_go(expired, ledger_.population.expired);
  }

  void give_birth(const ParticleSet& newborn) override {
    std::size_t loose = 0;
    for (const std::uint16_t m : newborn.material) loose += scene_.materials[m].interacts ? 0 : 1;
    // Ids of those that are gone stay in the table until it is mostly theirs.
    const bool many_gone = ids_.size() + newborn.size() > 4 * alive_ + 65536;
    if (many_gone || !slots_.has_room(newborn.size() - loose, loose)) move_into_room(newborn.size());
    RemovalSums born;
    std::vector<std::uint32_t> touching;
    for (std::size_t k = 0; k < newborn.size(); ++k) {
      const Material& m = scene_.materials[newborn.material[k]];
      const std::size_t slot =
          !m.interacts ? slots_.take_loose() : slots_.take_listed(list_.good() ? list_.first_free() : 0);
      ids_.append(newborn.id[k]);
      const std::size_t rank = ids_.size() - 1;
      put(slot, rank, newborn, k);
      applied_.add(slot, ids_.size());
      if (verlet()) acceleration_[slot] = {Real(0), Real(0), Real(0)};
      if (m.interacts) {
        list_.add(slot, static_cast<std::uint32_t>(rank));
        touching.push_back(static_cast<std::uint32_t>(slot));
      }
      ++alive_of_[newborn.material[k]];
      born.add_particle(m.mass, vec_cast<double>(records_[slot].x), vec_cast<double>(records_[slot].v), scene_.gravity);
    }
    if (loose < newborn.size()) threads_.run([&] { list_.mend_released(records_.data()); });
    count_alive();
    // They are born into no overlap, but perhaps to where cohesion reaches.
    if (rules_.widest_range > 0) add_elastic(touching, born.elastic);
    born.book_born(ledger_);
  }

  void find_inside(const ShapeBounds& box, std::vector<Occupant>& out) const override {
    for_ranges(slots_.listed_end(), kSegment, [&](std::size_t first, std::size_t last) {
      std::vector<Occupant> found;
      for (std::size_t i = first; i < last; ++i) {
        const Record& p = records_[i];
        const Vec3d x = vec_cast<double>(p.x);
        if (!is_nowhere(p) && is_inside(box, x)) found.push_back({x, material_of(p).radius});
      }
      const std::lock_guard lock(mutex_);
      out.insert(out.end(), found.begin(), found.end());
    });
  }

  std::uint64_t particle_count() const override { return alive_; }
  const Ledger& ledger() const override { return ledger_; }

  std::uint64_t particles_hash() const override {
    std::atomic<std::uint64_t> hash{0};
    for_ranges(slots_.end(), kSegment, [&](std::size_t first, std::size_t last) {
      std::uint64_t sum = 0;
      for (std::size_t i = first; i < last; ++i) {
        const Record& p = records_[i];
        if (!is_nowhere(p)) sum += particle_hash(ids_[rank_of(p.rank)], p.x, p.v);
      }
      hash += sum;
    });
    return hash;
  }

  Expected<Measurements> measure() override {
    if (!list_.good()) {
      if (const Condition found = build_neighbours(); !found.good()) {
        return fail(Error::Kind::run_failed, fmt::format("particle {}", found.particle), "is at no finite position");
      }
    }
    MeasurementSums total;
    for_ranges(slots_.end(), kSegment, [&](std::size_t first, std::size_t last) {
      const ContactScan<Real> scan(pass_, records_.data());
      MeasurementSums part;
      for (std::size_t i = first; i < last; ++i) {
        if (is_nowhere(records_[i])) continue;
        measure_particle(scan, i, rows_of(i / kSegment, i % kSegment / kLanes), records_[i], scene_, part);
      }
      const std::lock_guard lock(mutex_);
      total.add(part);
    });
    Measurements result = total.result(scene_.colliders.size());
    threads_.run([&] { applied_.measure(records_, slots_.end(), alive_, ids_, result); });
    return result;
  }

  NeighbourStatistics neighbour_statistics() const override {
    const auto n = static_cast<double>(std::max<std::size_t>(slots_.end(), 1));
    return {list_.build_count(), static_cast<double>(list_.entry_count()) / n, missed_contacts_};
  }

  StageTimes stage_times() const override { return times_; }

 private:
  void fill_unused(LargeVector<Record>& records) const {
    const auto fill = [&](std::size_t first, std::size_t last) {
      std::fill(records.begin() + static_cast<std::ptrdiff_t>(first),
                records.begin() + static_cast<std::ptrdiff_t>(last), nowhere_record<Real>(Real(0)));
    };
    fill(slots_.listed_end(), slots_.first_loose());
    fill(slots_.loose_end(), records.size() - 1);
    records.back() = filling_record<Real>();
  }

  bool verlet() const { return scene_.integrator == Integrator::velocity_verlet; }
  const Material& material_of(const Record& p) const { return scene_.materials[static_cast<std::size_t>(p.material)]; }

  template <class Body>
  void for_ranges(std::size_t count, std::size_t grain, const Body& body) const {
    threads_.run([&] { parallel_ranges(count, grain, body); });
  }

  void aim_pass(Vec3<Real>* acceleration) {
    pass_.in = records_.data();
    pass_.out = next_.data();
    pass_.acceleration = acceleration;
    pass_.held = applied_.held().lanes();
    pass_.listed_at = list_.listed_at();
    pass_.anchors = list_.anchors();
    pass_.next_step = list_.next_step();
  }

  // Where particles lie ----------------------------------------------------------------------------------------------

  void put(std::size_t slot, std::size_t rank, const ParticleSet& particles, std::size_t k) {
    records_[slot] = {vec_cast<Real>(particles.position[k]), static_cast<Real>(particles.material[k]),
                      vec_cast<Real>(particles.velocity[k]), rank_code<Real>(static_cast<std::uint32_t>(rank))};
    wrap_periodic(pass_, records_[slot]);  // a coordinate may have been rounded up to the upper face
  }

  // Lays all particles out anew, in order of their ids, with room for those that may be born, so many at least.
  void place(const ParticleSet& particles, std::size_t births = 0) {
    ids_ = IdTable(particles.id, !scene_.emitters.empty());
    alive_of_.assign(scene_.materials.size(), 0);
    for (const std::uint16_t m : particles.material) ++alive_of_[m];
    count_alive();
    const std::size_t listed = alive_ - alive_loose_;
    const bool tied = scene_.structure != nullptr;  // to slots, until all are laid out again
    slots_.lay_out(listed, room_for_births(true) + births, alive_loose_, room_for_births(false) + births, tied);
    records_.resize(slots_.room() + kLanes);  // a pack more, for searches to read; the last one is the dummy
    next_.resize(records_.size());
    acceleration_.assign(verlet() ? records_.size() : 0, {Real(0), Real(0), Real(0)});
    std::size_t next_listed = 0, next_loose = slots_.first_loose();
    for (std::size_t k = 0; k < particles.size(); ++k) {
      const std::size_t slot = scene_.materials[particles.material[k]].interacts ? next_listed++ : next_loose++;
      const std::size_t rank = scene_.emitters.empty() ? k : ids_.find(particles.id[k]);
      put(slot, rank, particles, k);
      if (verlet() && !particles.acceleration.empty()) acceleration_[slot] = vec_cast<Real>(particles.acceleration[k]);
    }
    fill_unused(records_);
    fill_unused(next_);
    list_.forget();
    applied_.bind(ids_, records_, slots_.room());
  }

  // For particles of a kind that may be born: what is expected, and half as many as there are more, so that it is
  // seldom that all are laid out anew.
  std::size_t room_for_births(bool listed) const {
    constexpr double kMost = 1U << 21U;  // ahead: more takes a while to fill
    double expected = 0;
    bool any = false;
    for (const Emitter& e : scene_.emitters) {
      if (scene_.materials[e.material].interacts != listed) continue;
      any = true;
      expected += expected_population(e, static_cast<double>(scene_.steps) * scene_.time_step);
    }
    if (!any) return 0;
    const std::size_t there = listed ? alive_ - alive_loose_ : alive_loose_;
    const auto wanted = static_cast<std::size_t>(std::min(kMost, 1.1 * expected)) + kSegment;
    return std::max(there / 2, wanted - std::min(wanted, there)) + kSegment;
  }

  void move_into_room(std::size_t births) {
    ParticleSet all;
    download(all);
    place(all, births);
  }

  // Neighbours -------------------------------------------------------------------------------------------------------

  Condition sort_by_cell() {
    const Stopwatch sorting(times_.sort);
    Vec3d min, max;
    const Condition condition = bounding_box(records_.data(), slots_.listed_end(), ids_, min, max);
    if (!condition.good()) return condition;
    for (int axis = 0; axis < 3; ++axis) {
      if (alive_ > alive_loose_ && !pass_.periodic[axis]) continue;
      component(min, axis) = component(pass_.min, axis);
      component(max, axis) = component(pass_.max, axis);
    }
    // The buffer for the next state is free until the records are permuted into it.
    order_ = list_.sort(records_.data(), slots_.listed_end(), min, max, std::as_writable_bytes(std::span(next_)));
    slots_.set_listed(alive_ - alive_loose_);
    permute(records_, next_);
    fill_unused(records_);
    fill_unused(next_);
    if (verlet()) {
      LargeVector<Vec3<Real>> sorted(acceleration_.size());
      permute(acceleration_, sorted);
    }
    return {};
  }

  template <class T>
  void permute(LargeVector<T>& column, LargeVector<T>& scratch) const {
    parallel_ranges(slots_.listed_end(), kSegment, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) scratch[i] = column[order_[i]];
    });
    parallel_ranges(slots_.loose_end() - slots_.first_loose(), kSegment, [&](std::size_t first, std::size_t last) {
      const auto at = [&](auto& of, std::size_t i) {
        return of.begin() + static_cast<std::ptrdiff_t>(slots_.first_loose() + i);
      };
      std::copy(at(column, first), at(column, last), at(scratch, first));
    });
    column.swap(scratch);
  }

  void list_neighbours() {
    const Stopwatch listing(times_.list);
    const std::size_t count = slots_.listed_end();
    const bool births = room_for_births(true) > 0;
    const std::size_t end = births ? std::min(slots_.first_loose(), count + count / 16 + 256) : count;
    list_.build(records_.data(), count, end / kLanes * kLanes, records_.size());
  }

  void follow_motion() {
    const Stopwatch following(times_.motion);
    threads_.run([&] { list_.moved(records_.data()); });
    if (check_list_ && list_.good()) missed_contacts_ += list_.count_missed(records_.data());
  }

  // Springs, fields, attraction, and what is held
  // -----------------------------------------------------------------------------

  void lay_out_structure() {
    if (!applied_.needs_layout()) return;
    const Stopwatch sorting(times_.sort);
    applied_.lay_out(records_, slots_.room(), ids_.size());
    slots_.recycle();
  }

  // Sums the forces that the pass adds. Returns whether pairs that springs kept apart may touch from the next step on.
  bool apply_others(bool may_tear, SpringSums& sums) {
    bool released = false;
    if (!applied_.none()) {
      threads_.run([&] {
        const auto& pairs = applied_.apply(records_, slots_.end(), alive_, ids_, may_tear, sums);
        list_.release(pairs);
        released = !pairs.empty();
      });
    }
    pass_.applied = applied_.forces();
    return released;
  }

  void settle_segment(std::size_t s, AppliedSums& sums) {
    applied_.settle(s * kSegment, slots_.end_of(s), records_.data(), next_.data(), pass_.acceleration, sums);
  }

  // The force pass and what it reports -------------------------------------------------------------------------------

  void run_segment(std::size_t s, SegmentReport& report) const {
    const std::size_t groups = (slots_.end_of(s) - s * kSegment + kLanes - 1) / kLanes;
    report.clear();
    if (slots_.is_loose(s * kSegment)) return run_groups(s, 0, groups, nullptr, nullptr, report);
    for (std::size_t g = 0; g < groups;) {
      std::size_t end = g + 1;
      if (list_.is_mended(s, g)) {
        const auto rows = list_.rows(s, g);
        const std::uint32_t first_row[2] = {0, static_cast<std::uint32_t>(rows.size() / kLanes)};
        run_groups(s, g, end, rows.data(), first_row, report);
      } else {
        while (end < groups && !list_.is_mended(s, end)) ++end;
        run_groups(s, g, end, list_.segment(s).entries, list_.segment(s).first_row.data() + g, report);
      }
      g = end;
    }
  }

  void run_groups(std::size_t s, std::size_t g, std::size_t end, const std::uint32_t* rows,
                  const std::uint32_t* first_row, SegmentReport& report) const {
    SegmentWork<Real> work;
    work.first = s * kSegment + g * kLanes;
    work.group_count = end - g;
    work.alone = rows == nullptr;
    work.rows = rows;
    work.first_row = first_row;
    work.notes = report.notes.data() + g;
    work.far = report.far.data() + g;
    work.sums = report.sums.data();
    loops_.force_pass(pass_, work);
  }

  // Of a group in the neighbour list; loose ones have none.
  std::span<const std::uint32_t> rows_of(std::size_t s, std::size_t g) const {
    if (slots_.is_loose(s * kSegment)) return {};
    return list_.rows(s, g);
  }

  // The approach that was too fast, if one was.
  Condition look_closely(std::size_t s, std::size_t g) const {
    const ContactScan<Real> scan(pass_, records_.data());
    const auto rows = rows_of(s, g);
    Condition found;
    const std::size_t first = s * kSegment + g * kLanes;
    for (std::size_t i = first; i < std::min(first + kLanes, slots_.end_of(s)); ++i) {
      if (!is_nowhere(records_[i])) {
        found = Condition::first(found, approach_too_fast(scan, i, rows, records_.data(), scene_, ids_));
      }
    }
    return found;
  }

  // Accelerations a(x, v) of the particles that have none of a last step.
  Condition evaluate_accelerations(std::uint64_t first_new_id) {
    if (const Condition found = build_neighbours(); !found.good()) return found;
    LargeVector<Vec3<Real>> evaluated(acceleration_.size());
    StepSums sums;
    AppliedSums applied;
    aim_pass(evaluated.data());
    (void)apply_others(false, applied.springs);
    for_ranges(slots_.segment_count(), 1, [&](std::size_t first, std::size_t last) {
      SegmentReport report;
      StepSums part;
      std::optional<AppliedSums> applied_part;  // large, and of no use to most scenes
      if (!applied_.none()) applied_part.emplace();
      for (std::size_t n = first; n < last; ++n) {
        const std::size_t s = slots_.segment(n);
        run_segment(s, report);
        report.add_to(part);
        if (applied_part) settle_segment(s, *applied_part);
      }
      const std::lock_guard lock(mutex_);
      sums.add(part);
      if (applied_part) applied.add(*applied_part);
    });
    ledger_.last = first_rates(sums, applied_.none() ? nullptr : &applied, scene_.gravity, total_mass_);
    for (std::size_t i = 0; i < slots_.end(); ++i) {
      if (!is_nowhere(records_[i]) && ids_[rank_of(records_[i].rank)] >= first_new_id) acceleration_[i] = evaluated[i];
    }
    return {};
  }

  // Boundaries -------------------------------------------------------------------------------------------------------

  // Wraps periodic coordinates; a particle outside an open face leaves.
  void apply_boundaries(Record& p, std::size_t slot, Departures& left) const {
    wrap_periodic(pass_, p);
    if (is_outside_open_face(pass_, p)) leave(p, slot, p.v, left);
  }

  void apply_boundaries_to_group(std::size_t s, std::size_t g, Departures& left) {
    const std::size_t first = s * kSegment + g * kLanes;
    for (std::size_t i = first; i < std::min(first + kLanes, slots_.end_of(s)); ++i) {
      if (!is_nowhere(next_[i])) apply_boundaries(next_[i], i, left);
    }
  }

  // Particle p is to leave, with a velocity v; it is there until let_go().
  void leave(const Record& p, std::size_t slot, const Vec3<Real>& v, Departures& left) const {
    left.add(slot, material_of(p).mass, vec_cast<double>(p.x), vec_cast<double>(v), scene_.gravity);
  }

  // Under velocity Verlet with what the half kick to come would have given it.
  void leave_at_end_of_step(std::size_t slot, Departures& left) const {
    const Record& p = records_[slot];
    leave(p, slot, verlet() ? kick(p.v, acceleration_[slot], Real(0.5) * pass_.dt) : p.v, left);
  }

  bool is_in_a_sink(const Vec3d& x) const {
    return std::any_of(sinks_.begin(), sinks_.end(),
                       [&](const PlacedSink& sink) { return is_inside(sink.box, x) && encloses(sink.shape, x); });
  }

  void collect(Departures& total, const Departures& part) const {
    if (part.slots.empty()) return;
    const std::lock_guard lock(mutex_);
    total.add(part);
  }

  // Those that leave go nowhere. `tally` is the ledger's count of those that go that way.
  void let_go(Departures& leaving, std::uint64_t& tally) {
    if (leaving.slots.empty()) return;
    add_elastic(leaving.slots, leaving.sums.elastic);
    leaving.sums.book_gone(ledger_, tally);
    for (const std::uint32_t slot : leaving.slots) {
      Record& p = records_[slot];
      --alive_of_[static_cast<std::size_t>(p.material)];
      p = nowhere_record<Real>(p.rank);
      slots_.leave(slot);
    }
    count_alive();
  }

  // Energy of the contacts between particles and of the springs that end at one of some particles. It takes a list that
  // is good: where a new one is built for it, `slots` are where they lie then.
  void add_elastic(std::vector<std::uint32_t>& slots, ExactSum& sum) {
    const auto is_listed = [&](std::uint32_t slot) { return !slots_.is_loose(slot); };
    if (applied_.springs().empty() && std::none_of(slots.begin(), slots.end(), is_listed)) return;
    if (!list_.good() && !rebuild_under(slots)) return;
    std::sort(slots.begin(), slots.end());
    const auto among = [&](std::size_t slot) { return std::binary_search(slots.begin(), slots.end(), slot); };
    for_ranges(slots.size(), 64, [&](std::size_t first, std::size_t last) {
      const ContactScan<Real> scan(pass_, records_.data());
      ExactSum part;
      for (std::size_t k = first; k < last; ++k) {
        const std::size_t i = slots[k];
        add_contact_energy(scan, i, rows_of(i / kSegment, i % kSegment / kLanes), among, part);
        applied_.add_spring_energy(records_, i, among, part);
      }
      const std::lock_guard lock(mutex_);
      sum.add(part);
    });
  }

  // Builds a list, and puts those of `slots` to where it has put their particles. Returns whether there is one.
  bool rebuild_under(std::vector<std::uint32_t>& slots) {
    std::vector<std::uint32_t> ranks;
    for (const std::uint32_t slot : slots) ranks.push_back(rank_of(records_[slot].rank));
    std::sort(ranks.begin(), ranks.end());
    if (!build_neighbours().good()) return false;
    slots.clear();
    for (std::size_t i = 0; i < slots_.end(); ++i) {
      if (!is_nowhere(records_[i]) && std::binary_search(ranks.begin(), ranks.end(), rank_of(records_[i].rank))) {
        slots.push_back(static_cast<std::uint32_t>(i));
      }
    }
    return true;
  }

  void count_alive() {
    alive_ = alive_loose_ = 0;
    total_mass_ = 0;
    for (std::size_t m = 0; m < alive_of_.size(); ++m) {
      alive_ += alive_of_[m];
      if (!scene_.materials[m].interacts) alive_loose_ += alive_of_[m];
      total_mass_ += static_cast<double>(alive_of_[m]) * scene_.materials[m].mass;
    }
  }

  struct PlacedSink {
    ShapeBounds box;
    ShapeGeometry<double> shape;
  };

  std::string isa_name_;
  Loops<Real> loops_;
  mutable Threads threads_;
  bool check_list_;
  mutable std::mutex mutex_;  // around the totals of a pass

  Scene scene_;
  PassRules<Real> rules_;
  ColliderRules<Real> colliders_;
  ForcePass<Real> pass_;  // the rules', aimed at the buffers of the moment

  IdTable ids_;  // by rank
  ParticleSlots slots_;
  std::vector<std::uint64_t> alive_of_;  // by material
  std::size_t alive_ = 0, alive_loose_ = 0;  // of all, of those that touch none
  double total_mass_ = 0;  // kg, of those alive
  LargeVector<Record> records_, next_;  // the state, and where a pass writes the next; both end with a dummy
  LargeVector<Vec3<Real>> acceleration_;  // velocity Verlet only, m/s^2
  Ledger ledger_;

  std::vector<PlacedSink> sinks_;
  AppliedForces<Real> applied_;
  VerletList<Real> list_;
  std::span<const std::uint32_t> order_;  // of the last sort, while it is in use
  std::uint64_t missed_contacts_ = 0;
  StageTimes times_;
};

}  // namespace

Expected<std::unique_ptr<Backend>> make_cpu_backend(const CpuOptions& options) {
  constexpr int kMostThreads = 1024;
  if (options.threads < 0 || options.threads > kMostThreads) {
    return fail(Error::Kind::bad_input, "threads", fmt::format("{} is not between 1 and 1024", options.threads));
  }
  const auto isa = choose_isa(options.isa);
  if (!isa) return fail(isa.error());
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int threads = options.threads > 0 ? options.threads : cores;
  if (options.precision == Precision::single_precision) {
    return std::make_unique<CpuBackend<float>>(*isa, isa->single_loops, threads, options.check_list);
  }
  return std::make_unique<CpuBackend<double>>(*isa, isa->double_loops, threads, options.check_list);
}

}  // namespace hooke
