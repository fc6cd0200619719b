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
#include "hooke/backends/cpu/collider_rules.h"
#include "hooke/backends/cpu/column_store.h"
#include "hooke/backends/cpu/contact_scan.h"
#include "hooke/backends/cpu/id_table.h"
#include "hooke/backends/cpu/isa.h"
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
  }

  void break_springs(const std::vector<std::uint64_t>& broken) override { applied_.springs().break_springs(broken); }
  std::vector<std::uint64_t> broken_springs() const override { return applied_.springs().broken(); }

  Condition upload(const ParticleSet& particles, std::uint64_t first_new_id, const Ledger& ledger) override {
    ledger_ = ledger;
    ids_ = IdTable(particles.id);
    count_ = ids_.size();
    records_.resize(padded(count_) + kLanes);  // a pack more, for searches to read; the last one is the dummy
    next_.resize(records_.size());
    acceleration_.assign(verlet() ? records_.size() : 0, {Real(0), Real(0), Real(0)});
    for (std::size_t i = 0; i < count_; ++i) {
      records_[i] = {vec_cast<Real>(particles.position[i]), static_cast<Real>(particles.material[i]),
                     vec_cast<Real>(particles.velocity[i]), rank_code<Real>(static_cast<std::uint32_t>(i))};
      wrap_periodic(pass_, records_[i]);  // a coordinate may have been rounded up to the upper face
      if (verlet() && !particles.acceleration.empty()) acceleration_[i] = vec_cast<Real>(particles.acceleration[i]);
    }
    fill_unused(records_);
    list_.forget();
    applied_.bind(ids_);
    count_alive();
    const bool any_new = count_ > 0 && ids_[count_ - 1] >= first_new_id;
    return verlet() && any_new ? evaluate_accelerations(first_new_id) : Condition{};
  }

  void download(ParticleSet& out) const override {
    constexpr std::uint32_t kGone = ~std::uint32_t{0};
    std::vector<std::uint32_t> at(ids_.size(), kGone);  // by rank, so by id
    for (std::size_t i = 0; i < count_; ++i) {
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
    RemovalSums removed;
    for_ranges(count_, kSegment, [&](std::size_t first, std::size_t last) {
      RemovalSums left;
      for (std::size_t start = first; start < last; start += kLanes) {
        unsigned far = 0;
        for (std::size_t i = start; i < std::min(start + kLanes, last); ++i) {
          Record& p = records_[i];
          if (is_nowhere(p) || applied_.held().holds(i)) continue;
          p.v = kick(p.v, acceleration_[i], Real(0.5) * pass_.dt);
          p.x = drift(p.x, p.v, pass_.dt);
          if (list_.good() && list_.is_far(p, i))
            far |= 1U << i % kLanes;  // asked of all: a removal must not hide a NaN
          apply_boundaries(p, left);
        }
        if (far != 0) list_.note_far(start / kLanes, far);
      }
      collect(removed, left);
    });
    drifting.stop();
    follow_motion();
    book(removed);
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
    RemovalSums removed;
    Condition condition;
    aim_pass(verlet() ? acceleration_.data() : nullptr);
    const bool released = apply_others(true, applied.springs);
    for_ranges(list_.segment_count(), 1, [&](std::size_t first, std::size_t last) {
      SegmentReport report;
      StepSums part;
      std::optional<AppliedSums> applied_part;  // large, and of no use to most scenes
      if (!applied_.none()) applied_part.emplace();
      RemovalSums left;
      Condition found;
      for (std::size_t s = first; s < last; ++s) {
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
    book(removed);
    return condition;
  }

  std::uint64_t particle_count() const override { return alive_; }
  const Ledger& ledger() const override { return ledger_; }

  std::uint64_t particles_hash() const override {
    std::atomic<std::uint64_t> hash{0};
    for_ranges(count_, kSegment, [&](std::size_t first, std::size_t last) {
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
    for_ranges(count_, kSegment, [&](std::size_t first, std::size_t last) {
      MeasurementSums part;
      for (std::size_t i = first; i < last; ++i) measure_particle(i, part);
      const std::lock_guard lock(mutex_);
      total.add(part);
    });
    Measurements result = total.result(scene_.colliders.size());
    threads_.run([&] { applied_.measure(records_, count_, alive_, ids_, result); });
    return result;
  }

  NeighbourStatistics neighbour_statistics() const override {
    const auto n = static_cast<double>(std::max<std::size_t>(count_, 1));
    return {list_.build_count(), static_cast<double>(list_.entry_count()) / n, missed_contacts_};
  }

  StageTimes stage_times() const override { return times_; }

 private:
  void fill_unused(LargeVector<Record>& records) const {
    std::fill(records.begin() + static_cast<std::ptrdiff_t>(count_), records.end() - 1, nowhere_record<Real>(Real(0)));
    records.back() = filling_record<Real>();
  }

  static std::size_t padded(std::size_t n) { return (n + kLanes - 1) / kLanes * kLanes; }
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

  // Neighbours -------------------------------------------------------------------------------------------------------

  // The box around all particles, or the particle that is at no place.
  Condition bounding_box(Vec3d& min, Vec3d& max) const {
    min = {INFINITY, INFINITY, INFINITY};
    max = {-INFINITY, -INFINITY, -INFINITY};
    Condition condition;
    parallel_ranges(count_, kSegment, [&](std::size_t first, std::size_t last) {
      Vec3<Real> low = vec_cast<Real>(Vec3d{INFINITY, INFINITY, INFINITY}), high = -low;
      Condition found;
      for (std::size_t i = first; i < last; ++i) {
        const Record& p = records_[i];
        if (is_nowhere(p)) continue;
        for (int axis = 0; axis < 3; ++axis) {
          const Real x = component(p.x, axis);
          if (!(std::abs(x) < static_cast<Real>(kFurthest))) {
            const auto kind = std::isfinite(x) ? Condition::Kind::grid_overflow : Condition::Kind::not_finite;
            found = Condition::first(found, {kind, ids_[rank_of(p.rank)], 0, 0});
          }
          component(low, axis) = std::min(component(low, axis), x);
          component(high, axis) = std::max(component(high, axis), x);
        }
      }
      const std::lock_guard lock(mutex_);
      condition = Condition::first(condition, found);
      for (int axis = 0; axis < 3; ++axis) {
        component(min, axis) = std::min<double>(component(min, axis), component(low, axis));
        component(max, axis) = std::max<double>(component(max, axis), component(high, axis));
      }
    });
    return condition;
  }

  Condition sort_by_cell() {
    const Stopwatch sorting(times_.sort);
    Vec3d min, max;
    if (const Condition condition = bounding_box(min, max); !condition.good()) return condition;
    for (int axis = 0; axis < 3; ++axis) {
      if (alive_ > 0 && !pass_.periodic[axis]) continue;
      component(min, axis) = component(pass_.min, axis);
      component(max, axis) = component(pass_.max, axis);
    }
    // The buffer for the next state is free until the records are permuted into it.
    order_ = list_.sort(records_.data(), count_, min, max, std::as_writable_bytes(std::span(next_)));
    count_ = alive_;
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
    parallel_ranges(count_, kSegment, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) scratch[i] = column[order_[i]];
    });
    column.swap(scratch);
  }

  void list_neighbours() {
    const Stopwatch listing(times_.list);
    list_.build(records_.data(), count_, records_.size());
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
    applied_.lay_out(records_, count_, ids_.size());
  }

  // Sums the forces that the pass adds. Returns whether pairs that springs kept apart may touch from the next step on.
  bool apply_others(bool may_tear, SpringSums& sums) {
    bool released = false;
    if (!applied_.none()) {
      threads_.run([&] {
        const auto& pairs = applied_.apply(records_, count_, alive_, ids_, may_tear, sums);
        list_.release(pairs);
        released = !pairs.empty();
      });
    }
    pass_.applied = applied_.forces();
    return released;
  }

  void settle_segment(std::size_t s, AppliedSums& sums) {
    applied_.settle(s * kSegment, std::min((s + 1) * kSegment, count_), records_.data(), next_.data(),
                    pass_.acceleration, sums);
  }

  // The force pass and what it reports -------------------------------------------------------------------------------

  void run_segment(std::size_t s, SegmentReport& report) const {
    const std::size_t groups = std::min(kGroups, (count_ - s * kSegment + kLanes - 1) / kLanes);
    report.clear();
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
    work.rows = rows;
    work.first_row = first_row;
    work.notes = report.notes.data() + g;
    work.far = report.far.data() + g;
    work.sums = report.sums.data();
    loops_.force_pass(pass_, work);
  }

  // The approach that was too fast, if one was: in double precision, each pair by its own limit.
  Condition look_closely(std::size_t s, std::size_t g) const {
    const ContactScan<Real> scan(pass_, records_.data());
    const auto rows = list_.rows(s, g);
    Condition found;
    const std::size_t first = s * kSegment + g * kLanes;
    for (std::size_t i = first; i < std::min(first + kLanes, count_); ++i) {
      if (is_nowhere(records_[i])) continue;
      const Vec3d v = vec_cast<double>(records_[i].v);
      const double radius = material_of(records_[i]).radius;
      const std::uint64_t id = ids_[rank_of(records_[i].rank)];
      scan.for_each_contact(i, rows, [&](std::size_t p, const Vec3d& normal, double overlap) {
        const double approach = dot(vec_cast<double>(records_[p].v) - v, normal);
        if (overlap > 0 && approach > std::min(radius, material_of(records_[p]).radius) / scene_.time_step) {
          found = Condition::first(found,
                                   {Condition::Kind::approach_too_fast, id, ids_[rank_of(records_[p].rank)], approach});
        }
      });
      scan.for_each_wall(i, [&](const Vec3d& normal, double overlap) {
        const double approach = dot(-v, normal);
        if (overlap > 0 && approach > radius / scene_.time_step) {
          found = Condition::first(found, {Condition::Kind::wall_approach_too_fast, id, 0, approach});
        }
      });
      scan.for_each_collider(i, [&](std::size_t c, const ColliderFace<double>& face, double overlap) {
        const double approach = dot(face.velocity - v, face.normal);
        if (overlap > 0 && approach > radius / scene_.time_step) {
          found = Condition::first(found, {Condition::Kind::collider_approach_too_fast, id, c, approach});
        }
      });
    }
    return found;
  }

  void measure_particle(std::size_t i, MeasurementSums& sums) const {
    const Record& p = records_[i];
    if (is_nowhere(p)) return;
    const ContactScan<Real> scan(pass_, records_.data());
    const auto rows = list_.rows(i / kSegment, i % kSegment / kLanes);
    const Vec3d v = vec_cast<double>(p.v);
    sums.add_particle(material_of(p).mass, vec_cast<double>(p.x), v, scene_.gravity);
    scan.for_each_contact(i, rows, [&](std::size_t q, const Vec3d&, double overlap) {
      sums.add_contact_side(law_of(scan.pair(i, q)), overlap, scan.pair(i, q).reach);
    });
    scan.for_each_wall(i, [&](const Vec3d& normal, double overlap) {
      const ContactLaw<double> law = law_of(scan.wall(i));
      sums.add_wall_contact(law, overlap, contact_force(overlap, normal, -v, law));
    });
    scan.for_each_collider(i, [&](std::size_t c, const ColliderFace<double>& face, double overlap) {
      const ContactLaw<double> law = law_of(scan.collider(i, c));
      const Vec3d force = contact_force(overlap, face.normal, face.velocity - v, law);
      sums.add_collider_contact(c, face.point, law, overlap, force);
    });
  }

  // Accelerations a(x, v) of the particles that have none of a last step.
  Condition evaluate_accelerations(std::uint64_t first_new_id) {
    if (const Condition found = build_neighbours(); !found.good()) return found;
    LargeVector<Vec3<Real>> evaluated(acceleration_.size());
    StepSums sums;
    AppliedSums applied;
    aim_pass(evaluated.data());
    (void)apply_others(false, applied.springs);
    for_ranges(list_.segment_count(), 1, [&](std::size_t first, std::size_t last) {
      SegmentReport report;
      StepSums part;
      std::optional<AppliedSums> applied_part;  // large, and of no use to most scenes
      if (!applied_.none()) applied_part.emplace();
      for (std::size_t s = first; s < last; ++s) {
        run_segment(s, report);
        report.add_to(part);
        if (applied_part) settle_segment(s, *applied_part);
      }
      const std::lock_guard lock(mutex_);
      sums.add(part);
      if (applied_part) applied.add(*applied_part);
    });
    ledger_.last = first_rates(sums, applied_.none() ? nullptr : &applied, scene_.gravity, total_mass_);
    for (std::size_t i = 0; i < count_; ++i) {
      if (ids_[rank_of(records_[i].rank)] >= first_new_id) acceleration_[i] = evaluated[i];
    }
    return {};
  }

  // Boundaries -------------------------------------------------------------------------------------------------------

  // Wraps periodic coordinates; a particle outside an open face goes nowhere.
  void apply_boundaries(Record& p, RemovalSums& left) const {
    wrap_periodic(pass_, p);
    if (!is_outside_open_face(pass_, p)) return;
    left.add_particle(material_of(p).mass, vec_cast<double>(p.x), vec_cast<double>(p.v), scene_.gravity);
    const Real material = p.material;
    p = nowhere_record<Real>(p.rank);
    p.material = material;
  }

  void apply_boundaries_to_group(std::size_t s, std::size_t g, RemovalSums& left) {
    const std::size_t first = s * kSegment + g * kLanes;
    for (std::size_t i = first; i < std::min(first + kLanes, count_); ++i) {
      if (!is_nowhere(next_[i])) apply_boundaries(next_[i], left);
    }
  }

  void collect(RemovalSums& total, const RemovalSums& part) const {
    if (part.count == 0) return;
    const std::lock_guard lock(mutex_);
    total.add(part);
  }

  void book(const RemovalSums& removed) {
    if (removed.count == 0) return;
    removed.book(ledger_);
    count_alive();
  }

  void count_alive() {
    std::vector<std::uint64_t> per_material(scene_.materials.size(), 0);
    alive_ = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (is_nowhere(records_[i])) continue;
      ++alive_;
      ++per_material[static_cast<std::size_t>(records_[i].material)];
    }
    total_mass_ = 0;
    for (std::size_t m = 0; m < per_material.size(); ++m) {
      total_mass_ += static_cast<double>(per_material[m]) * scene_.materials[m].mass;
    }
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

  IdTable ids_;  // by rank
  std::size_t count_ = 0;  // records in use, those gone since the last sort included
  std::size_t alive_ = 0;
  double total_mass_ = 0;  // kg, of those alive
  LargeVector<Record> records_, next_;  // the state, and where a pass writes the next; both end with a dummy
  LargeVector<Vec3<Real>> acceleration_;  // velocity Verlet only, m/s^2
  Ledger ledger_;

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
