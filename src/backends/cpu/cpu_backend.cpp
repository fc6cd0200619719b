// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/cpu_backend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <thread>

#include "hooke/backends/cpu/boundaries.h"
#include "hooke/backends/cpu/column_store.h"
#include "hooke/backends/cpu/contact_scan.h"
#include "hooke/backends/cpu/id_table.h"
#include "hooke/backends/cpu/isa.h"
#include "hooke/backends/cpu/pass_rules.h"
#include "hooke/backends/cpu/threads.h"
#include "hooke/base/parallel.h"
#include "hooke/base/stopwatch.h"
#include "hooke/core/state_hash.h"
#include "hooke/core/sums.h"
#include "hooke/neighbours/cell_list.h"
#include "hooke/neighbours/motion_bounds.h"
#include "hooke/neighbours/neighbour_list.h"
#include "hooke/physics/drag.h"
#include "hooke/physics/integrate.h"

namespace hooke {
namespace {

constexpr std::size_t kLanes = NeighbourList::kLanes;
constexpr std::size_t kGroups = NeighbourList::kGroups;
constexpr std::size_t kSegment = NeighbourList::kSegment;

// Positions beyond this are lost; records at kNowhere must stay further away from everything.
constexpr double kFurthest = kNowhere / 16;

// The state in one precision. Particles lie in cell order as of the last build; ranks lead back to ids.
template <class Real>
class CpuBackend final : public Backend {
  using Record = ParticleRecord<Real>;
  using Searcher = GroupSearcher<Real>;

 public:
  CpuBackend(const Isa& isa, const Loops<Real>& loops, int threads)
      : isa_name_(isa.name),
        loops_(loops),
        threads_(threads) {}

  BackendInfo info() const override {
    const auto precision = sizeof(Real) == 4 ? Precision::single_precision : Precision::double_precision;
    return {"cpu", isa_name_, precision, threads_.count()};
  }

  void configure(const Scene& scene) override {
    scene_ = scene;
    rules_.configure(scene);
    pass_ = rules_.pass;
    motion_limits_.diameter = 2 * rules_.largest_radius;
    motion_limits_.skin = rules_.trusted_skin;
    motion_limits_.found = rules_.found_distance;
    std::copy(std::begin(pass_.periodic), std::end(pass_.periodic), motion_limits_.periodic);
    listed_ = false;
  }

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
    std::fill(records_.begin() + static_cast<std::ptrdiff_t>(count_), records_.end(), nowhere_record<Real>(Real(0)));
    listed_ = false;
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

  void half_kick_and_drift() override {
    Stopwatch drifting(times_.drift);
    RemovalSums removed;
    std::atomic<bool> moved_far{false};
    for_ranges(count_, kSegment, [&](std::size_t first, std::size_t last) {
      RemovalSums left;
      bool far = false;
      for (std::size_t i = first; i < last; ++i) {
        Record& p = records_[i];
        if (is_nowhere(p)) continue;
        p.v = kick(p.v, acceleration_[i], Real(0.5) * pass_.dt);
        p.x = drift(p.x, p.v, pass_.dt);
        far = has_moved_far(p, i) || far;  // asked of all: a removal must not hide a NaN
        apply_boundaries(p, left);
      }
      if (far) moved_far = true;
      collect(removed, left);
    });
    drifting.stop();
    if (moved_far && listed_) judge_list();
    book(removed);
  }

  bool neighbours_stale() const override { return !listed_; }

  Condition build_neighbours() override {
    Condition condition;
    threads_.run([&] {
      condition = sort_by_cell();
      if (condition.good()) list_neighbours();
    });
    return condition;
  }

  Condition apply_forces() override {
    Stopwatch forcing(times_.force);
    StepSums sums;
    RemovalSums removed;
    Condition condition;
    std::atomic<bool> moved_far{false};
    aim_pass(verlet() ? acceleration_.data() : nullptr);
    const NeighbourRule<Real> touching = touching_rule();
    for_ranges(list_.segments.size(), 1, [&](std::size_t first, std::size_t last) {
      Searcher searcher(cells_, listed_at_.columns(), touching, loops_.search_group, rules_.found_distance);
      SegmentReport report;
      StepSums part;
      RemovalSums left;
      Condition found;
      bool far = false;
      for (std::size_t s = first; s < last; ++s) {
        run_segment(s, searcher, report);
        add_up(s, report, part);
        for (std::size_t g = 0; g < kGroups; ++g) {
          if (report.notes[g] == 0) continue;
          if ((report.notes[g] & kApproachTooFast) != 0) {
            found = Condition::first(found, look_closely(s, g, searcher));
          }
          if ((report.notes[g] & kLeftDomain) != 0) apply_boundaries_to_group(s, g, left);
          far = far || (report.notes[g] & kMovedFar) != 0;
        }
      }
      if (far) moved_far = true;
      collect(removed, left);
      const std::lock_guard lock(mutex_);
      sums.add(part);
      condition = Condition::first(condition, found);
    });
    book_step(ledger_, sums.rates(scene_.gravity, total_mass_), scene_.time_step, scene_.integrator);
    forcing.stop();
    records_.swap(next_);
    if (moved_far) judge_list();
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
    if (!listed_ || !restless_.empty()) {
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
    return total.result();
  }

  NeighbourStatistics neighbour_statistics() const override {
    const auto n = static_cast<double>(std::max<std::size_t>(count_, 1));
    return {rebuilds_, static_cast<double>(list_.entry_count()) / n};
  }

  StageTimes stage_times() const override { return times_; }

 private:
  // Where the groups of one segment report.
  struct SegmentReport {
    std::array<unsigned char, kGroups> notes;
    std::array<Real, kSegment> dissipated, wall_power;
    std::array<std::array<Real, kSegment>, 3> wall_force;
  };

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
    pass_.listed_at = listed_at_.columns();
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
    motion_limits_.min = min;
    motion_limits_.max = max;
    cells_.lay_out(min, max, pass_.periodic, rules_.levels, count_);
    const auto key_of = [&](std::size_t i) {
      return is_nowhere(records_[i]) ? cells_.key_end() : cells_.key_of(vec_cast<double>(records_[i].x), 0);
    };
    // The buffer for the next state is free until the records are permuted into it.
    cells_.sort(count_, key_of, order_, std::as_writable_bytes(std::span(next_)));
    count_ = alive_;
    permute(records_, next_);
    std::fill(records_.begin() + static_cast<std::ptrdiff_t>(count_), records_.end(), nowhere_record<Real>(Real(0)));
    std::fill(next_.begin() + static_cast<std::ptrdiff_t>(count_), next_.end(), nowhere_record<Real>(Real(0)));
    if (verlet()) {
      std::vector<Vec3<Real>> sorted(acceleration_.size());
      permute(acceleration_, sorted);
    }
    return {};
  }

  template <class T>
  void permute(std::vector<T>& column, std::vector<T>& scratch) const {
    parallel_ranges(count_, kSegment, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) scratch[i] = column[order_[i]];
    });
    column.swap(scratch);
  }

  void list_neighbours() {
    const Stopwatch listing(times_.list);
    // A pack more than there are particles, for searches to read.
    listed_at_.resize(padded(count_) + kLanes);
    std::vector<std::uint32_t>& ranks = order_;  // of no use any more as the order of the sort
    ranks.reserve(padded(count_) + kLanes);  // a growing vector would take twice that
    ranks.resize(padded(count_) + kLanes);
    radii_.resize(rules_.largest_radius > rules_.smallest_radius ? padded(count_) + kLanes : 0);
    parallel_ranges(count_, kSegment, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        listed_at_.put(i, records_[i].x);
        ranks[i] = rank_of(records_[i].rank);
        if (!radii_.empty()) radii_[i] = rules_.materials[static_cast<std::size_t>(records_[i].material)].radius;
      }
    });

    NeighbourRule<Real> rule = touching_rule();
    rule.at = listed_at_.columns();
    rule.reach += static_cast<Real>(rules_.skin);
    build_neighbour_list(cells_, rule, loops_.search_group, list_);

    listed_ = true;
    restless_.clear();
    motion_laid_out_ = false;
    ++rebuilds_;
  }

  // Finds who touches where the records are now.
  NeighbourRule<Real> touching_rule() const {
    constexpr double kRounding = 1e-3;
    NeighbourRule<Real> rule;
    rule.records = &records_.data()->x.x;
    rule.radius = radii_.empty() ? nullptr : radii_.data();
    rule.rank = order_.data();
    rule.reach =
        static_cast<Real>(kRounding * rules_.smallest_radius + (radii_.empty() ? 2 * rules_.largest_radius : 0));
    std::copy(std::begin(pass_.periodic), std::end(pass_.periodic), rule.periodic);
    rule.length = pass_.length;
    rule.list_self = pass_.periodic_kind == PeriodicKind::images;
    rule.stride = record_offset<Real>(1);
    rule.dummy = static_cast<std::uint32_t>(records_.size() - 1);
    return rule;
  }

  bool is_restless(std::size_t s, std::size_t g) const {
    const std::size_t group = s * kGroups + g;
    return group < restless_.size() && restless_[group] != 0;
  }

  // The rows of group g of segment s: the list's, or where that may miss a contact those of whoever touches now.
  std::span<const std::uint32_t> rows_of(std::size_t s, std::size_t g, Searcher& searcher) const {
    if (!is_restless(s, g)) return list_.rows(s, g);
    const std::size_t first = s * kSegment + g * kLanes;
    return searcher.rows(first, std::min(first + kLanes, count_));
  }

  // How far a record has moved since its neighbours were listed, m.
  Vec3<Real> displacement(const Record& p, std::size_t i) const {
    const Vec3<Real> from = listed_at_[i];
    Vec3<Real> moved = p.x - from;
    if (pass_.periodic_kind == PeriodicKind::none) return moved;
    for (int axis = 0; axis < 3; ++axis) {
      if (!pass_.periodic[axis]) continue;
      const Real now = component(p.x, axis), then = component(from, axis);
      const Real length = component(pass_.length, axis);
      component(moved, axis) = image_displacement(now, then, nearest_image(now, then, length), length);
    }
    return moved;
  }

  bool has_moved_far(const Record& p, std::size_t i) const {
    if (!listed_) return false;
    const Vec3<Real> moved = displacement(p, i);
    return !(dot(moved, moved) <= pass_.stale_distance2);
  }

  // How much of the list can be trusted, now that some particle has moved by more than half a skin: all of it where its
  // surroundings have moved along.
  void judge_list() {
    const Stopwatch judging(times_.motion);
    threads_.run([&] {
      if (!motion_laid_out_) {
        motion_.lay_out(listed_at_.columns(), count_, motion_limits_);
        motion_laid_out_ = true;
      }
      const Trust trust = motion_.judge(
          [&](std::size_t i, Vec3<Real>& u) {
            if (is_nowhere(records_[i])) return false;
            u = displacement(records_[i], i);
            return true;
          },
          kLanes, restless_, std::as_writable_bytes(std::span(next_).first(count_)));
      if (trust != Trust::some) restless_.clear();
      // A search of its own takes a group some three times as long as its share of a new list.
      constexpr std::size_t kFewOf = 8;
      const auto restless = static_cast<std::size_t>(std::count(restless_.begin(), restless_.end(), 1));
      listed_ = trust != Trust::none && restless * kFewOf < padded(count_) / kLanes;
    });
  }

  // The force pass and what it reports -------------------------------------------------------------------------------

  void run_segment(std::size_t s, Searcher& searcher, SegmentReport& report) const {
    const std::size_t groups = std::min(kGroups, (count_ - s * kSegment + kLanes - 1) / kLanes);
    report.notes.fill(0);
    for (std::size_t g = 0; g < groups;) {
      std::size_t end = g + 1;
      if (is_restless(s, g)) {
        const auto rows = rows_of(s, g, searcher);
        const std::uint32_t first_row[2] = {0, static_cast<std::uint32_t>(rows.size() / kLanes)};
        run_groups(s, g, end, rows.data(), first_row, report);
      } else {
        while (end < groups && !is_restless(s, end)) ++end;
        run_groups(s, g, end, list_.segments[s].entries, list_.segments[s].first_row.data() + g, report);
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
    work.dissipated = report.dissipated.data() + g * kLanes;
    work.wall_power = report.wall_power.data() + g * kLanes;
    for (std::size_t axis = 0; axis < 3; ++axis) work.wall_force[axis] = report.wall_force[axis].data() + g * kLanes;
    loops_.force_pass(pass_, work);
  }

  void add_up(std::size_t s, const SegmentReport& report, StepSums& sums) const {
    const std::size_t first = s * kSegment;
    const std::size_t n = std::min(kSegment, count_ - first);
    for (std::size_t k = 0; k < n; ++k) {
      sums.dissipated_power.add(report.dissipated[k]);
      if ((report.notes[k / kLanes] & kTouchesWall) != 0) {
        sums.wall_power.add(report.wall_power[k]);
        sums.wall_force.add({report.wall_force[0][k], report.wall_force[1][k], report.wall_force[2][k]});
      }
      if (rules_.has_drag) {
        const Record& p = records_[first + k];
        const Real drag = rules_.materials[static_cast<std::size_t>(p.material)].drag;
        sums.drag_force.add(vec_cast<double>(drag_force(p.v, drag)));
      }
    }
  }

  // The approach that was too fast, if one was: in double precision, each pair by its own limit.
  Condition look_closely(std::size_t s, std::size_t g, Searcher& searcher) const {
    const ContactScan<Real> scan(pass_, records_.data());
    const auto rows = rows_of(s, g, searcher);
    Condition found;
    const std::size_t first = s * kSegment + g * kLanes;
    for (std::size_t i = first; i < std::min(first + kLanes, count_); ++i) {
      if (is_nowhere(records_[i])) continue;
      const Vec3d v = vec_cast<double>(records_[i].v);
      const double radius = material_of(records_[i]).radius;
      const std::uint64_t id = ids_[rank_of(records_[i].rank)];
      scan.for_each_contact(i, rows, [&](std::size_t p, const Vec3d& normal, double) {
        const double approach = dot(vec_cast<double>(records_[p].v) - v, normal);
        if (approach > std::min(radius, material_of(records_[p]).radius) / scene_.time_step) {
          found = Condition::first(found,
                                   {Condition::Kind::approach_too_fast, id, ids_[rank_of(records_[p].rank)], approach});
        }
      });
      scan.for_each_wall(i, [&](const Vec3d& normal, double) {
        const double approach = dot(-v, normal);
        if (approach > radius / scene_.time_step) {
          found = Condition::first(found, {Condition::Kind::wall_approach_too_fast, id, 0, approach});
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
      sums.add_contact_side(scan.pair(i, q).stiffness, overlap, scan.pair(i, q).reach);
    });
    scan.for_each_wall(i, [&](const Vec3d& normal, double overlap) {
      const MaterialRow<Real>& m = rules_.materials[scan.material_of(i)];
      const ContactCoefficients<double> c{m.wall_stiffness, m.wall_shear, m.wall_damping};
      sums.add_wall_contact(c.stiffness, overlap, contact_force(overlap, normal, -v, c).force);
    });
  }

  // Accelerations a(x, v) of the particles that have none of a last step.
  Condition evaluate_accelerations(std::uint64_t first_new_id) {
    if (const Condition found = build_neighbours(); !found.good()) return found;
    std::vector<Vec3<Real>> evaluated(acceleration_.size());
    StepSums sums;
    aim_pass(evaluated.data());
    const NeighbourRule<Real> touching = touching_rule();
    for_ranges(list_.segments.size(), 1, [&](std::size_t first, std::size_t last) {
      Searcher searcher(cells_, listed_at_.columns(), touching, loops_.search_group, rules_.found_distance);
      SegmentReport report;
      StepSums part;
      for (std::size_t s = first; s < last; ++s) {
        run_segment(s, searcher, report);
        add_up(s, report, part);
      }
      const std::lock_guard lock(mutex_);
      sums.add(part);
    });
    ledger_.last = sums.rates(scene_.gravity, total_mass_);
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
  mutable std::mutex mutex_;  // around the totals of a pass

  Scene scene_;
  PassRules<Real> rules_;
  ForcePass<Real> pass_;  // the rules', aimed at the buffers of the moment

  IdTable ids_;  // by rank
  std::size_t count_ = 0;  // records in use, those gone since the last sort included
  std::size_t alive_ = 0;
  double total_mass_ = 0;  // kg, of those alive
  std::vector<Record> records_, next_;  // the state, and where a pass writes the next; both end with a dummy
  std::vector<Vec3<Real>> acceleration_;  // velocity Verlet only, m/s^2
  Ledger ledger_;

  CellList cells_;
  std::vector<std::uint32_t> order_;  // while sorting: where each was before; then: ranks
  NeighbourList list_;
  std::vector<Real> radii_;  // m, likewise; empty where all are the same
  ColumnStore<Real> listed_at_;  // positions, m
  bool listed_ = false;
  std::vector<unsigned char> restless_;  // by group: 1 where the list may miss a contact; empty where it misses none
  MotionBounds<Real> motion_;  // since the list was built
  typename MotionBounds<Real>::Limits motion_limits_;
  bool motion_laid_out_ = false;
  std::uint64_t rebuilds_ = 0;
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
    return std::make_unique<CpuBackend<float>>(*isa, isa->single_loops, threads);
  }
  return std::make_unique<CpuBackend<double>>(*isa, isa->double_loops, threads);
}

}  // namespace hooke
