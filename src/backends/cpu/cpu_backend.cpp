// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/cpu_backend.h"

#include <fmt/format.h>

#include <algorithm>
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
#include "hooke/backends/cpu/isa.h"
#include "hooke/backends/cpu/particle_state.h"
#include "hooke/backends/cpu/pass_rules.h"
#include "hooke/backends/cpu/placed_sinks.h"
#include "hooke/backends/cpu/segment_report.h"
#include "hooke/backends/cpu/threads.h"
#include "hooke/backends/cpu/verlet_list.h"
#include "hooke/base/parallel.h"
#include "hooke/base/stopwatch.h"
#include "hooke/core/sums.h"
#include "hooke/neighbours/neighbour_list.h"
#include "hooke/physics/drag.h"
#include "hooke/physics/integrate.h"

namespace hooke {
namespace {

constexpr std::size_t kLanes = NeighbourList::kLanes;
constexpr std::size_t kGroups = NeighbourList::kGroups;
constexpr std::size_t kSegment = NeighbourList::kSegment;

// The step of one precision: who does what, in which order. What they do it with is in the files that this one
// includes.
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
    particles_.configure(scene_, rules_);
    colliders_.configure(scene, pass_.material_count);
    list_.configure(rules_, loops_.search_window, applied_.springs().apart());
    applied_.configure(scene, rules_.pass, loops_);
    sinks_ = PlacedSinks(scene.sinks);
  }

  void break_springs(const std::vector<std::uint64_t>& broken) override { applied_.springs().break_springs(broken); }
  std::vector<std::uint64_t> broken_springs() const override { return applied_.springs().broken(); }

  Condition upload(const ParticleSet& particles, std::uint64_t first_new_id, const Ledger& ledger) override {
    ledger_ = ledger;
    take(particles);
    const bool any_new = !particles.empty() && particles.id.back() >= first_new_id;
    return verlet() && any_new ? evaluate_accelerations(first_new_id) : Condition{};
  }

  void download(ParticleSet& out) const override { particles_.download(out); }

  void set_time(double seconds) override { applied_.set_time(seconds); }

  void place_colliders(std::span<const ColliderPose> poses) override {
    colliders_.place(scene_, poses, rules_.largest_radius + rules_.widest_range, pass_);
  }

  void half_kick_and_drift() override {
    Stopwatch drifting(times_.drift);
    Departures removed;
    for_ranges(particles_.slots.end(), kSegment, [&](std::size_t first, std::size_t last) {
      Departures left;
      for (std::size_t start = first; start < last; start += kLanes) {
        unsigned far = 0;
        for (std::size_t i = start; i < std::min(start + kLanes, last); ++i) {
          Record& p = particles_.records[i];
          if (is_nowhere(p)) continue;
          const bool held = applied_.held().holds(i);
          if (!held) {
            p.v = kick(p.v, particles_.acceleration[i], Real(0.5) * pass_.dt);
            p.x = drift(p.x, p.v, pass_.dt);
          }
          if (list_.good() && !particles_.slots.is_loose(i) && list_.is_far(p, i))
            far |= 1U << i % kLanes;  // asked of all: a removal must not hide a NaN
          if (!held) apply_boundaries(p, i, left);
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
    aim_pass(verlet() ? particles_.acceleration.data() : nullptr);
    const bool released = apply_others(true, applied.springs);
    run_pass(sums, applied, [&](std::size_t s, const SegmentReport& report) {
      std::optional<Departures> left;  // large, and seldom of use
      Condition found;
      for (std::size_t g = 0; g < kGroups; ++g) {
        if (report.far[g] != 0) list_.note_far(s * kGroups + g, report.far[g]);
        if (report.notes[g] == 0) continue;
        if ((report.notes[g] & kApproachTooFast) != 0) found = Condition::first(found, look_closely(s, g));
        if ((report.notes[g] & kLeftDomain) != 0) {
          if (!left) left.emplace();
          apply_boundaries_to_group(s, g, *left);
        }
      }
      if (left) collect(removed, *left);
      if (found.good()) return;
      const std::lock_guard lock(mutex_);
      condition = Condition::first(condition, found);
    });
    book_step(ledger_, sums, applied_.none() ? nullptr : &applied, scene_.gravity, particles_.mass(), scene_.time_step,
              scene_.integrator);
    particles_.records.swap(particles_.next);
    forcing.stop();
    if (!verlet()) {
      follow_motion();
    } else if (released) {  // nobody has moved; rows are mended before the next forces, but somebody may look
      threads_.run([&] { list_.mend_released(particles_.records.data()); });
    }
    let_go(removed, ledger_.removed);
    return condition;
  }

  void sink_particles() override {
    Departures sunk;
    for_ranges(particles_.slots.end(), kSegment, [&](std::size_t first, std::size_t last) {
      Departures part;
      for (std::size_t i = first; i < last; ++i) {
        if (!is_nowhere(particles_.records[i]) && sinks_.take(vec_cast<double>(particles_.records[i].x)))
          leave_at_end_of_step(i, part);
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
        const std::size_t rank = particles_.ids.find(ids[k]);
        if (rank == particles_.ids.size()) continue;
        const std::size_t slot = applied_.place(rank);
        if (slot == SpringLists<Real>::kNowherePlace || is_nowhere(particles_.records[slot]) ||
            rank_of(particles_.records[slot].rank) != rank)
          continue;
        was_there[k] = 1;
        leave_at_end_of_step(slot, part);
      }
      collect(expired, part);
    });
    let_go(expired, ledger_.population.expired);
  }

  void give_birth(const ParticleSet& newborn) override {
    if (!particles_.has_room_for(newborn)) make_room(newborn.size());
    RemovalSums born;
    std::vector<std::uint32_t> touching;
    for (std::size_t k = 0; k < newborn.size(); ++k) {
      const Material& m = scene_.materials[newborn.material[k]];
      const std::size_t slot = !m.interacts ? particles_.slots.take_loose()
                                            : particles_.slots.take_listed(list_.good() ? list_.first_free() : 0);
      const std::size_t rank = particles_.add(slot, newborn, k);
      applied_.add(slot, particles_.ids.size());
      if (m.interacts) {
        list_.add(slot, static_cast<std::uint32_t>(rank));
        touching.push_back(static_cast<std::uint32_t>(slot));
      }
      born.add_particle(m.mass, vec_cast<double>(particles_.records[slot].x),
                        vec_cast<double>(particles_.records[slot].v), scene_.gravity);
    }
    if (!touching.empty()) threads_.run([&] { list_.mend_released(particles_.records.data()); });
    particles_.recount();
    // They are born into no overlap, but perhaps to where cohesion reaches.
    if (rules_.widest_range > 0) add_elastic(touching, born.elastic);
    born.book_born(ledger_);
  }

  void find_inside(const ShapeBounds& box, std::vector<Occupant>& out) const override {
    for_ranges(particles_.slots.listed_end(), kSegment, [&](std::size_t first, std::size_t last) {
      std::vector<Occupant> found;
      for (std::size_t i = first; i < last; ++i) {
        const Record& p = particles_.records[i];
        const Vec3d x = vec_cast<double>(p.x);
        if (!is_nowhere(p) && is_inside(box, x)) found.push_back({x, particles_.material_of(p).radius});
      }
      const std::lock_guard lock(mutex_);
      out.insert(out.end(), found.begin(), found.end());
    });
  }

  std::uint64_t particle_count() const override { return particles_.count(); }
  const Ledger& ledger() const override { return ledger_; }

  std::uint64_t particles_hash() const override {
    std::uint64_t hash = 0;
    threads_.run([&] { hash = particles_.hash(); });
    return hash;
  }

  Expected<Measurements> measure() override {
    if (!list_.good()) {
      if (const Condition found = build_neighbours(); !found.good()) {
        return fail(Error::Kind::run_failed, fmt::format("particle {}", found.particle), "is at no finite position");
      }
    }
    MeasurementSums total;
    for_ranges(particles_.slots.end(), kSegment, [&](std::size_t first, std::size_t last) {
      const ContactScan<Real> scan(pass_, particles_.records.data());
      MeasurementSums part;
      for (std::size_t i = first; i < last; ++i) {
        if (is_nowhere(particles_.records[i])) continue;
        measure_particle(scan, i, rows_of(i / kSegment, i % kSegment / kLanes), particles_.records[i], scene_, part);
      }
      const std::lock_guard lock(mutex_);
      total.add(part);
    });
    Measurements result = total.result(scene_.colliders.size());
    threads_.run([&] {
      applied_.measure(particles_.records, particles_.slots.end(), particles_.count(), particles_.ids, result);
    });
    return result;
  }

  NeighbourStatistics neighbour_statistics() const override {
    const auto n = static_cast<double>(std::max<std::size_t>(particles_.slots.end(), 1));
    return {list_.build_count(), static_cast<double>(list_.entry_count()) / n, missed_contacts_};
  }

  StageTimes stage_times() const override { return times_; }

 private:
  bool verlet() const { return particles_.verlet(); }

  template <class Body>
  void for_ranges(std::size_t count, std::size_t grain, const Body& body) const {
    threads_.run([&] { parallel_ranges(count, grain, body); });
  }

  void aim_pass(Vec3<Real>* acceleration) {
    pass_.in = particles_.records.data();
    pass_.out = particles_.next.data();
    pass_.acceleration = acceleration;
    pass_.held = applied_.held().lanes();
    pass_.listed_at = list_.listed_at();
    pass_.anchors = list_.anchors();
    pass_.next_step = list_.next_step();
  }

  // Takes these particles and no others, with room for so many births at least.
  void take(const ParticleSet& particles, std::size_t births = 0) {
    particles_.place(particles, births);
    list_.forget();
    applied_.bind(particles_.ids, particles_.records, particles_.slots.room());
  }

  void make_room(std::size_t births) {
    ParticleSet all;
    particles_.download(all);
    take(all, births);
  }

  // Neighbours -------------------------------------------------------------------------------------------------------

  Condition sort_by_cell() {
    const Stopwatch sorting(times_.sort);
    Vec3d min, max;
    const Condition condition =
        bounding_box(particles_.records.data(), particles_.slots.listed_end(), particles_.ids, min, max);
    if (!condition.good()) return condition;
    for (int axis = 0; axis < 3; ++axis) {
      if (particles_.count() > particles_.loose_count() && !pass_.periodic[axis]) continue;
      component(min, axis) = component(pass_.min, axis);
      component(max, axis) = component(pass_.max, axis);
    }
    particles_.reorder(
        list_.sort(particles_.records.data(), particles_.slots.listed_end(), min, max, particles_.scratch()));
    return {};
  }

  void list_neighbours() {
    const Stopwatch listing(times_.list);
    const std::size_t count = particles_.slots.listed_end();
    const bool births = particles_.room_for_births(true) > 0;
    const std::size_t end = births ? std::min(particles_.slots.first_loose(), count + count / 16 + 256) : count;
    list_.build(particles_.records.data(), count, end / kLanes * kLanes, particles_.records.size(),
                particles_.scratch());
    particles_.end_scratch();
  }

  void follow_motion() {
    const Stopwatch following(times_.motion);
    threads_.run([&] { list_.moved(particles_.records.data()); });
    if (check_list_ && list_.good()) missed_contacts_ += list_.count_missed(particles_.records.data());
  }

  // Springs, fields, attraction, and what is held --------------------------------------------------------------------

  void lay_out_structure() {
    if (!applied_.needs_layout()) return;
    const Stopwatch sorting(times_.sort);
    applied_.lay_out(particles_.records, particles_.slots.room(), particles_.ids.size());
    particles_.slots.recycle();
  }

  // Sums the forces that the pass adds. Returns whether pairs that springs kept apart may touch from the next step on.
  bool apply_others(bool may_tear, SpringSums& sums) {
    bool released = false;
    if (!applied_.none()) {
      threads_.run([&] {
        const auto& pairs = applied_.apply(particles_.records, particles_.slots.end(), particles_.count(),
                                           particles_.ids, may_tear, sums);
        list_.release(pairs);
        released = !pairs.empty();
      });
    }
    pass_.applied = applied_.forces();
    return released;
  }

  void settle_segment(std::size_t s, AppliedSums& sums) {
    applied_.settle(s * kSegment, particles_.slots.end_of(s), particles_.records.data(), particles_.next.data(),
                    pass_.acceleration, sums);
  }

  // The force pass and what it reports -------------------------------------------------------------------------------

  // All segments, and their sums; then look(s, report of segment s).
  template <class Look>
  void run_pass(StepSums& sums, AppliedSums& applied, const Look& look) {
    for_ranges(particles_.slots.segment_count(), 1, [&](std::size_t first, std::size_t last) {
      SegmentReport report;
      StepSums part;
      std::optional<AppliedSums> applied_part;  // large, and of no use to most scenes
      if (!applied_.none()) applied_part.emplace();
      for (std::size_t n = first; n < last; ++n) {
        const std::size_t s = particles_.slots.segment(n);
        run_segment(s, report);
        report.add_to(part);
        if (applied_part) settle_segment(s, *applied_part);
        look(s, report);
      }
      const std::lock_guard lock(mutex_);
      sums.add(part);
      if (applied_part) applied.add(*applied_part);
    });
  }

  void run_segment(std::size_t s, SegmentReport& report) const {
    const std::size_t groups = (particles_.slots.end_of(s) - s * kSegment + kLanes - 1) / kLanes;
    report.clear();
    if (particles_.slots.is_loose(s * kSegment)) return run_groups(s, 0, groups, nullptr, nullptr, report);
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
    if (particles_.slots.is_loose(s * kSegment)) return {};
    return list_.rows(s, g);
  }

  // The approach that was too fast, if one was.
  Condition look_closely(std::size_t s, std::size_t g) const {
    const ContactScan<Real> scan(pass_, particles_.records.data());
    const auto rows = rows_of(s, g);
    Condition found;
    const std::size_t first = s * kSegment + g * kLanes;
    for (std::size_t i = first; i < std::min(first + kLanes, particles_.slots.end_of(s)); ++i) {
      if (!is_nowhere(particles_.records[i])) {
        found = Condition::first(found,
                                 approach_too_fast(scan, i, rows, particles_.records.data(), scene_, particles_.ids));
      }
    }
    return found;
  }

  // Accelerations a(x, v) of the particles that have none of a last step.
  Condition evaluate_accelerations(std::uint64_t first_new_id) {
    if (const Condition found = build_neighbours(); !found.good()) return found;
    LargeVector<Vec3<Real>> evaluated(particles_.acceleration.size());
    StepSums sums;
    AppliedSums applied;
    aim_pass(evaluated.data());
    (void)apply_others(false, applied.springs);
    run_pass(sums, applied, [](std::size_t, const SegmentReport&) {});
    ledger_.last = first_rates(sums, applied_.none() ? nullptr : &applied, scene_.gravity, particles_.mass());
    for (std::size_t i = 0; i < particles_.slots.end(); ++i) {
      if (!is_nowhere(particles_.records[i]) && particles_.ids[rank_of(particles_.records[i].rank)] >= first_new_id)
        particles_.acceleration[i] = evaluated[i];
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
    for (std::size_t i = first; i < std::min(first + kLanes, particles_.slots.end_of(s)); ++i) {
      if (!is_nowhere(particles_.next[i])) apply_boundaries(particles_.next[i], i, left);
    }
  }

  // Particle p is to leave, with a velocity v; it is there until let_go().
  void leave(const Record& p, std::size_t slot, const Vec3<Real>& v, Departures& left) const {
    left.add(slot, particles_.material_of(p).mass, vec_cast<double>(p.x), vec_cast<double>(v), scene_.gravity);
  }

  // Under velocity Verlet with what the half kick to come would have given it.
  void leave_at_end_of_step(std::size_t slot, Departures& left) const {
    const Record& p = particles_.records[slot];
    leave(p, slot, verlet() ? kick(p.v, particles_.acceleration[slot], Real(0.5) * pass_.dt) : p.v, left);
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
    for (const std::uint32_t slot : leaving.slots) particles_.remove(slot);
    particles_.recount();
  }

  // Energy of the contacts between particles and of the springs that end at one of some particles. It takes a list that
  // is good: where a new one is built for it, `slots` are where they lie then.
  void add_elastic(std::vector<std::uint32_t>& slots, ExactSum& sum) {
    const auto is_listed = [&](std::uint32_t slot) { return !particles_.slots.is_loose(slot); };
    if (applied_.springs().empty() && std::none_of(slots.begin(), slots.end(), is_listed)) return;
    if (!list_.good() && !rebuild_under(slots)) return;
    std::sort(slots.begin(), slots.end());
    const auto among = [&](std::size_t slot) { return std::binary_search(slots.begin(), slots.end(), slot); };
    for_ranges(slots.size(), 64, [&](std::size_t first, std::size_t last) {
      const ContactScan<Real> scan(pass_, particles_.records.data());
      ExactSum part;
      for (std::size_t k = first; k < last; ++k) {
        const std::size_t i = slots[k];
        add_contact_energy(scan, i, rows_of(i / kSegment, i % kSegment / kLanes), among, part);
        applied_.add_spring_energy(particles_.records, i, among, part);
      }
      const std::lock_guard lock(mutex_);
      sum.add(part);
    });
  }

  // Builds a list, and puts those of `slots` to where it has put their particles. Returns whether there is one.
  bool rebuild_under(std::vector<std::uint32_t>& slots) {
    std::vector<std::uint32_t> ranks;
    for (const std::uint32_t slot : slots) ranks.push_back(rank_of(particles_.records[slot].rank));
    std::sort(ranks.begin(), ranks.end());
    if (!build_neighbours().good()) return false;
    slots.clear();
    for (std::size_t i = 0; i < particles_.slots.end(); ++i) {
      if (!is_nowhere(particles_.records[i]) &&
          std::binary_search(ranks.begin(), ranks.end(), rank_of(particles_.records[i].rank))) {
        slots.push_back(static_cast<std::uint32_t>(i));
      }
    }
    return true;
  }

  std::string isa_name_;
  Loops<Real> loops_;
  mutable Threads threads_;
  bool check_list_;
  mutable std::mutex mutex_;  // around the totals of a pass

  Scene scene_;
  PassRules<Real> rules_;
  ColliderRules<Real> colliders_;
  ForcePass<Real> pass_;  // the rules', aimed at the buffers of the moment

  ParticleState<Real> particles_;
  Ledger ledger_;

  PlacedSinks sinks_;
  AppliedForces<Real> applied_;
  VerletList<Real> list_;
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
