// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The members of GpuBackend: a part of gpu_backend.h.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>
#include <unordered_map>

#include "hooke/base/assert.h"
#include "hooke/base/format.h"
#include "hooke/base/parallel.h"
#include "hooke/base/stopwatch.h"
#include "hooke/passes/contact_reports.h"

namespace hooke::gpu {

// The scene and its particles ----------------------------------------------------------------------------------------

template <class Device, class Real>
void GpuBackend<Device, Real>::configure(const Scene& scene) {
  constexpr double kSkin = 0.2;       // of the smallest diameter
  constexpr double kRounding = 1e-3;  // of the skin, and of the smallest radius: what displacements are rounded by
  scene_ = scene;
  rules_ = PassRules<Real>(scene);
  colliders_ = {};
  placed_.clear();
  skin_ = kSkin * 2 * rules_.smallest_touching();
  skin_limit_ = std::max(0.0, (1 - kRounding) * skin_ - 2 * rules_.rounding());
  scene_on_device_.configure(scene_, rules_, skin_ + kRounding * rules_.smallest_touching());
  applied_.configure(scene_, rules_.view());
  windows_ = {};
}

// Replaces all particles by these, with room for at least so many births.
template <class Device, class Real>
void GpuBackend<Device, Real>::take(const ParticleSet& particles, std::size_t births) {
  HOOKE_ASSERT(are_particles_of(particles, scene_), particles.size(), scene_.materials.size());
  const bool gaps = !scene_.emitters.empty();
  ids_ = IdTable(particles.id, gaps);
  count_of_.assign(scene_.materials.size(), 0);
  for (const std::uint16_t m : particles.material) ++count_of_[m];
  recount();
  room_ = 0;  // nothing is kept
  end_ = 0;
  make_room(static_cast<std::uint32_t>(count_ + births));
  std::vector<Record> records;
  std::vector<std::uint64_t> ids;
  records.reserve(count_);
  for (std::size_t k = 0; k < particles.size(); ++k)
    records.push_back(record_of(particles, k, gaps ? ids_.find(particles.id[k]) : k));
  for (std::size_t k = 0; k < ids_.size(); ++k) ids.push_back(ids_[k]);
  records_.upload(records.data(), count_);
  ids_on_device_.reserve(ids.size() + ids.size() / 2 + kWarp);
  ids_on_device_.upload(ids.data(), ids.size());
  slot_of_id_index_.reserve(ids_on_device_.room());
  slot_of_id_index_.fill(0xff, slot_of_id_index_.room());
  device_.each(count_, IndexSlots<Real>{records_.data(), 0, slot_of_id_index_.data()});
  if (verlet()) {
    std::vector<Vec3<Real>> acceleration(count_, {Real(0), Real(0), Real(0)});
    for (std::size_t k = 0; k < particles.acceleration.size(); ++k)
      acceleration[k] = vec_cast<Real>(particles.acceleration[k]);
    acceleration_.upload(acceleration.data(), count_);
  }
  end_ = count_;
  listed_ = 0;
  leaving_ = 0;
  stale_ = true;
  applied_.bind(ids_);
  applied_.mark_pinned(particles_view());  // velocity Verlet moves particles before the next list
}

// Makes room for so many slots; what is in the slots that are in use stays.
template <class Device, class Real>
void GpuBackend<Device, Real>::make_room(std::uint32_t slots) {
  const std::uint32_t room = whole_warps(slots + 1) + kWarp;  // whole warps of particles, and the filler after them
  if (room <= room_) return;
  records_.grow(room, end_);
  next_.grow(room, 0);
  if (verlet()) {
    acceleration_.grow(room, end_);
    next_acceleration_.grow(room, 0);
  }
  key_.reserve(room);
  place_.reserve(room);
  position_at_build_.reserve(room);
  suspects_.reserve(room);
  departed_.reserve(room);
  moves_.reserve(room / kWarp);
  block_.reserve(1);
  room_ = room;
  const Record filler = filler_record<Real>();
  device_.each(room_ - 1 - end_, Vacate<Real>{records_.data(), next_.data(), end_});
  records_.upload(&filler, 1, room_ - 1);
  next_.upload(&filler, 1, room_ - 1);
  listed_ = 0;  // the list's filler is no more
  stale_ = true;
  applied_.invalidate();
}

template <class Device, class Real>
void GpuBackend<Device, Real>::recount() {
  count_ = noninteracting_ = 0;
  mass_ = {};
  for (std::size_t m = 0; m < count_of_.size(); ++m) {
    count_ += count_of_[m];
    if (!scene_.materials[m].interacts) noninteracting_ += count_of_[m];
    mass_.add_product(static_cast<double>(count_of_[m]), scene_.materials[m].mass);
  }
}

template <class Device, class Real>
auto GpuBackend<Device, Real>::record_of(const ParticleSet& particles, std::size_t k, std::size_t id_index) const
    -> Record {
  Record record{vec_cast<Real>(particles.position[k]), static_cast<Real>(particles.material[k]),
                vec_cast<Real>(particles.velocity[k]), sort_key<Real>(static_cast<std::uint32_t>(id_index))};
  wrap_periodic(rules_.view(), record.x);  // a coordinate may have been rounded up to the upper face
  return record;
}

template <class Device, class Real>
template <class Out>
void GpuBackend<Device, Real>::download_all(const ParticleColumns<Out>& out) const {
  const auto id_count = static_cast<std::uint32_t>(ids_.size());
  asked_.reserve(id_count + 1);
  asked_.fill(0, id_count + 1);
  device_.each(id_count, MarkPresent<Real>{records_.data(), slot_of_id_index_.data(), asked_.data()});
  device_.scan(asked_.data(), id_count + 1);
  // A column at a time, so that one more column is all the memory that it takes.
  const CopyColumns<Real, Out> none{records_.data(),
                                    verlet() ? acceleration_.data() : nullptr,
                                    slot_of_id_index_.data(),
                                    asked_.data(),
                                    ids_on_device_.data(),
                                    nullptr,
                                    nullptr,
                                    nullptr,
                                    nullptr,
                                    nullptr};
  const auto copy = [&](auto CopyColumns<Real, Out>::* column, auto* to) {
    if (to == nullptr) return;
    column_.reserve(count_ * sizeof *to);
    CopyColumns<Real, Out> one = none;
    one.*column = reinterpret_cast<decltype(to)>(column_.data());
    device_.each(id_count, one);
    column_.download(reinterpret_cast<std::byte*>(to), count_ * sizeof *to);
  };
  copy(&CopyColumns<Real, Out>::id, out.id);
  copy(&CopyColumns<Real, Out>::material, out.material);
  copy(&CopyColumns<Real, Out>::position, out.position);
  copy(&CopyColumns<Real, Out>::velocity, out.velocity);
  if (verlet()) copy(&CopyColumns<Real, Out>::acceleration, out.acceleration);
}

// Where records that have been downloaded lie; kNoSlot where an id index has no particle.
template <class Device, class Real>
std::vector<std::uint32_t> GpuBackend<Device, Real>::slots_by_id_index(const std::vector<Record>& records) const {
  std::vector<std::uint32_t> slot_of(ids_.size(), kNoSlot);
  for (std::uint32_t i = 0; i < end_; ++i) {
    if (!is_vacant(records[i])) slot_of[id_index_of(records[i].id_index)] = i;
  }
  return slot_of;
}

template <class Device, class Real>
std::optional<std::uint32_t> GpuBackend<Device, Real>::id_index_of_id(std::uint64_t id) const {
  const std::size_t id_index = ids_.find(id);
  if (id_index == ids_.size()) return std::nullopt;
  return static_cast<std::uint32_t>(id_index);
}

template <class Device, class Real>
auto GpuBackend<Device, Real>::look_up(const std::vector<std::uint32_t>& id_indices) const -> std::vector<Found> {
  const std::size_t count = id_indices.size();
  asked_.reserve(count);
  asked_.upload(id_indices.data(), count);
  found_.reserve(count);
  device_.each(static_cast<std::uint32_t>(count),
               FindParticles<Real>{records_.data(), verlet() ? acceleration_.data() : nullptr, slot_of_id_index_.data(),
                                   listed_ > 0 ? first_row_.data() : nullptr, listed_, asked_.data(), found_.data()});
  std::vector<Found> found(count);
  found_.download(found.data(), count);
  return found;
}

template <class Device, class Real>
std::optional<ParticleAt> GpuBackend<Device, Real>::find(std::uint64_t id) const {
  const std::optional<std::uint32_t> id_index = id_index_of_id(id);
  if (!id_index) return std::nullopt;
  const Found p = look_up({*id_index}).front();
  if (p.slot == kNoSlot) return std::nullopt;
  return ParticleAt{id, static_cast<std::size_t>(p.record.material), vec_cast<double>(p.record.x),
                    vec_cast<double>(p.record.v)};
}

template <class Device, class Real>
void GpuBackend<Device, Real>::edit(std::span<const ParticleAt> edited) {
  std::vector<std::uint32_t> id_indices;
  for (const ParticleAt& to : edited) {
    const std::size_t id_index = ids_.find(to.id);
    HOOKE_ASSERT(id_index < ids_.size(), to.id);
    id_indices.push_back(static_cast<std::uint32_t>(id_index));
  }
  const std::vector<Found> found = look_up(id_indices);
  for (std::size_t k = 0; k < edited.size(); ++k) {
    const ParticleAt& to = edited[k];
    HOOKE_ASSERT(found[k].slot != kNoSlot, to.id);
    Record p = found[k].record;
    const Vec3<Real> before = p.x;
    p.x = vec_cast<Real>(to.position);
    p.v = vec_cast<Real>(to.velocity);
    wrap_periodic(rules_.view(), p.x);
    if (p.x != before) stale_ = true;
    records_.upload(&p, 1, found[k].slot);
  }
}

template <class Device, class Real>
std::optional<std::uint64_t> GpuBackend<Device, Real>::set_external_forces(std::span<const std::uint64_t> ids,
                                                                           std::span<const Vec3d> forces) {
  HOOKE_ASSERT(ids.size() == forces.size(), ids.size(), forces.size());
  std::vector<std::uint32_t> id_indices;
  for (const std::uint64_t id : ids) {
    const std::optional<std::uint32_t> id_index = id_index_of_id(id);
    if (!id_index) return id;
    id_indices.push_back(*id_index);
  }
  const std::vector<Found> found = look_up(id_indices);
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (found[k].slot == kNoSlot) return ids[k];
  }
  applied_.external().set(ids_, ids, forces);
  return std::nullopt;
}

// Motion and neighbours ----------------------------------------------------------------------------------------------

template <class Device, class Real>
void GpuBackend<Device, Real>::clear_report(std::size_t bytes) const {
  device_.fill(block_.data(), 0, bytes);
}

template <class Device, class Real>
void GpuBackend<Device, Real>::read_report(std::size_t bytes) const {
  device_.download(&seen_, block_.data(), bytes);
}

template <class Device, class Real>
void GpuBackend<Device, Real>::half_kick_and_drift() {
  const Stopwatch drifting(times_.drift);
  const std::uint32_t end = whole_warps(end_);
  clear_report();
  moves_.fill(0, end / kWarp);
  device_.each(end, KickAndDrift<Real>{rules_.view(), records_.data(), acceleration_.data(), applied_.pinned(),
                                       list_view(), step_output()});
  judge_motion(step_runner(), end);
  read_report();
}

// Compares how far the particles in the first `end` slots have moved.
template <class Device, class Real>
void GpuBackend<Device, Real>::judge_motion(const StepRunner<Device>& step, std::uint32_t end) {
  if (listed_ == 0) return;
  const std::uint32_t warps = end / kWarp;
  step.each(whole_warps(warps), BoundMoves{moves_.data(), warps, step.report()});
  if (!grid_.hashed) {
    const auto skin2 = static_cast<float>(skin_limit_ * skin_limit_);
    step.each(grid_.places * CompareBricks::kItems,
              CompareBricks{grid_, start_.data(), moves_.data(), skin2, step.report()});
  }
  // Particles of bricks that are not adjacent are four cells apart or more.
  const double limit = grid_.hashed ? skin_limit_ : 3 * grid_.cell;
  // Displacements are kept as floats. Before their rounding is as large as the list's allowance for it, 1e-3 of the
  // skin, a new list begins from 0.
  const double largest_kept = 1e-3 * skin_ * 0x1p22;
  step.each(1, JudgeMoves{static_cast<float>(limit), static_cast<float>(largest_kept), step.report()});
}

template <class Device, class Real>
void GpuBackend<Device, Real>::follow_motion() {
  leaving_ = seen_.report.departed;
  stale_ = stale_ || seen_.report.stale != 0;
}

template <class Device, class Real>
void GpuBackend<Device, Real>::remove_departed(RemovalSums& left) {
  const Stopwatch following(times_.motion);
  if (leaving_ > 0) left.add(let_go(read_departed(), false));
}

template <class Device, class Real>
Condition GpuBackend<Device, Real>::build_neighbours() {
  if (const Condition found = sort_by_cell(); !found.good()) return found;
  if (applied_.needs_layout()) applied_.lay_out(particles_view());
  list_neighbours();
  return {};
}

// Sorts the particles into the cells of a new grid. The list is stale after, where there is one.
template <class Device, class Real>
Condition GpuBackend<Device, Real>::sort_by_cell() {
  const Stopwatch sorting(times_.sort);
  const RulesView<Real>& rules = rules_.view();
  listed_ = 0;
  stale_ = true;
  applied_.invalidate();
  grid_ = BrickGrid::over(vec_cast<double>(rules.min), vec_cast<double>(rules.max), rules.periodic,
                          2 * rules_.largest_interaction_radius() + scene_on_device_.skin(), count_);
  const std::size_t cells = std::size_t{grid_.key_end()} + 2;
  start_.reserve(cells);
  start_.fill(0, cells);
  clear_report();
  device_.each(end_, NumberCells<Real>{records_.data(), grid_, scene_on_device_.interacts(), key_.data(), place_.data(),
                                       start_.data(), &block_.data()->report});
  read_report();
  if (seen_.report.lost != 0) {
    const std::uint32_t id_index = ~seen_.report.lost;
    const Vec3<Real> x = look_up({id_index}).front().record.x;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(component(x, axis)) < static_cast<Real>(kFurthest)) continue;
      const auto kind =
          std::isfinite(component(x, axis)) ? Condition::Kind::grid_overflow : Condition::Kind::not_finite;
      return {kind, ids_[id_index], 0, 0};
    }
  }
  device_.scan(start_.data(), cells);
  slot_of_id_index_.fill(0xff, ids_.size());
  device_.each(end_, PutInPlace<Real>{records_.data(), verlet() ? acceleration_.data() : nullptr, key_.data(),
                                      place_.data(), start_.data(), next_.data(), next_acceleration_.data(),
                                      position_at_build_.data(), slot_of_id_index_.data()});
  std::swap(records_, next_);
  if (verlet()) std::swap(acceleration_, next_acceleration_);
  const std::uint32_t used = std::max(end_, count_);
  device_.each(used - count_, Vacate<Real>{records_.data(), next_.data(), count_});
  end_ = count_;
  return {};
}

template <class Device, class Real>
void GpuBackend<Device, Real>::list_neighbours() {
  const Stopwatch listing(times_.list);
  listed_ = listed_count();
  const std::uint32_t slices = GpuBackend::slices(listed_), filler = record_offset<Real>(room_ - 1);
  const RulesView<Real>& rules = rules_.view();
  const Search<Real> search{records_.data(),
                            grid_,
                            start_.data(),
                            scene_on_device_.reach(),
                            rules.period,
                            rules.periodic_kind == PeriodicKind::images,
                            applied_.springs().excluded()};
  first_row_.reserve(slices + 1);
  first_row_.fill(0, slices + 1);
  device_.each(listed_, CountRows<Real>{search, first_row_.data()});
  device_.scan(first_row_.data(), slices + 1);
  std::uint32_t rows = 0;
  first_row_.download(&rows, 1, slices);
  rows_ = rows;
  // The pass may read, and not use, some rows after the last.
  const std::size_t wanted = (std::size_t{rows} + kRowsAhead + 1) * kSliceLanes;
  if (wanted > entries_.room()) entries_.reserve(wanted + wanted / 8);
  device_.each(slices * kLanes,
               FillRows<Real>{search, first_row_.data(), slot_of_id_index_.data(), entries_.data(), filler, listed_});
  stale_ = false;
  ++builds_;
  lifetime_ = list_age_;
  list_age_ = 0;
}

// The pass -----------------------------------------------------------------------------------------------------------

template <class Device, class Real>
void GpuBackend<Device, Real>::place_at(const Instant& now) {
  if (scene_.colliders.empty()) return;
  if (!placed_.empty() && std::equal(now.poses.begin(), now.poses.end(), placed_.begin(), placed_.end())) return;
  placed_.assign(now.poses.begin(), now.poses.end());
  colliders_ = place_colliders<Real>(scene_, now.poses, rules_.largest_body_distance());
  scene_on_device_.place(colliders_);
}

// Steps that come after one that needs the host are kernels that do nothing, some microseconds each: this is about how
// long the list will still be good for.
template <class Device, class Real>
std::size_t GpuBackend<Device, Real>::most_in_a_row() const {
  constexpr std::size_t kMost = 64, kLeast = 4;
  constexpr std::size_t kTerms = std::size_t{1} << 30U;  // that each digit of an exact sum has room for
  const std::size_t left = list_age_ < lifetime_ ? lifetime_ - list_age_ : list_age_ / 4;
  return std::clamp<std::size_t>(kTerms / std::max(end_, 1U), 1, std::clamp(left, kLeast, kMost));
}

template <class Device, class Real>
std::size_t GpuBackend<Device, Real>::apply_forces_in_a_row(std::span<const Instant> steps, StepReport& report) {
  const Stopwatch forcing(times_.force);
  start_sums(report);
  for (const Instant& now : steps) {
    place_at(now);
    run_pass(now, verlet() ? acceleration_.data() : nullptr, true);
    std::swap(records_, next_);
  }
  read_sums();
  const std::size_t taken = seen_.report.steps;
  if ((steps.size() - taken) % 2 == 0) std::swap(records_, next_);  // the state before the last step that was taken
  if (taken < steps.size()) place_at(steps[taken - 1]);
  book_sums(report);
  if (seen_.report.suspects > 0) report.condition = check_suspects(steps[taken - 1].moved);
  std::swap(records_, next_);
  list_age_ += taken;
  return taken;
}

template <class Device, class Real>
void GpuBackend<Device, Real>::evaluate_accelerations(const Instant& now, StepReport& report) {
  place_at(now);
  start_sums(report);
  run_pass(now, acceleration_.data(), false);
  read_sums();
  book_sums(report);
}

template <class Device, class Real>
void GpuBackend<Device, Real>::start_sums(StepReport& report) {
  clear_report(sizeof(StepBlock));
  if (applied_.none()) return;
  report.applied.emplace();
  applied_.clear_sums();
}

// Adds to the sums of the steps in a row.
template <class Device, class Real>
void GpuBackend<Device, Real>::run_pass(const Instant& now, Vec3<Real>* acceleration, bool may_tear) {
  const StepRunner<Device> step = step_runner();
  const std::uint32_t end = whole_warps(end_);
  const Vec3<Real>* const applied =
      applied_.none() ? nullptr : applied_.apply(particles_view(), now.time, may_tear, step);
  if (acceleration == nullptr) moves_.fill(0, end / kWarp);
  const ForcePass<Real> pass{scene_on_device_.constants(),
                             scene_on_device_.colliders(),
                             {records_.data(), next_.data(), acceleration, applied, applied_.pinned()}};
  choose_loop(scene_on_device_.constants(), [&](auto materials, auto periodic) {
    constexpr Materials kMaterials = decltype(materials)::value;
    constexpr PeriodicKind kPeriodic = decltype(periodic)::value;
    if (scene_.colliders.empty()) {
      step.each(end, StepParticle<Real, kMaterials, kPeriodic, false>{pass, list_view(), step_output(), windows_});
    } else {
      step.each(end, StepParticle<Real, kMaterials, kPeriodic, true>{pass, list_view(), step_output(), windows_});
    }
  });
  if (!applied_.none()) applied_.finish(particles_view(), next_.data(), acceleration, step);
  if (acceleration == nullptr) judge_motion(step, end);
  step.each(1, EndStep{step.report()});
}

template <class Device, class Real>
void GpuBackend<Device, Real>::read_sums() {
  const AddCopies<Real> add_copies{step_sums()};
  device_.each(add_copies.items(), add_copies);
  read_report(kReadBytes);
}

// Books the springs that tore, with the energy that they had before the step.
template <class Device, class Real>
void GpuBackend<Device, Real>::book_torn(AppliedSums& sums) {
  const std::vector<TornSpring> torn = applied_.springs().take_torn(seen_.report.torn, stale_);
  std::vector<std::uint32_t> ends;
  for (const TornSpring& spring : torn) {
    ends.push_back(spring.a);
    ends.push_back(spring.b);
  }
  const std::vector<Found> found = look_up(ends);
  for (std::size_t k = 0; k < torn.size(); ++k) {
    sums.springs.broken_energy.add(
        applied_.springs().table().energy_of(torn[k].spring, found[2 * k].record, found[2 * k + 1].record));
    ++sums.springs.broken;
  }
}

// Adds the device's sums to the report, and places the windows of the next ones. Springs that tore still have the state
// in records_ from before the step.
template <class Device, class Real>
void GpuBackend<Device, Real>::book_sums(StepReport& report) {
  const auto take = [&](int sum, ExactSum& to) {
    const FixedSum<Real>& from = seen_.sums[sum];
    add_fixed(from, windows_.of[sum], to);
    if (from.largest != 0) windows_.of[sum] = SumWindow::around(from.largest);
  };
  for (std::size_t cause = 0; cause < kPassCauses; ++cause) {
    take(static_cast<int>(cause), report.sums.power.of[cause]);
    take(PassSum::kNext + static_cast<int>(cause), report.sums.next_power.of[cause]);
  }
  for (int axis = 0; axis < 3; ++axis) {
    take(PassSum::kWallForce + axis, report.sums.wall_force[axis]);
    take(PassSum::kColliderForce + axis, report.sums.collider_force[axis]);
    take(PassSum::kDragForce + axis, report.sums.drag_force[axis]);
  }
  report.mass.add_scaled(mass_, seen_.report.steps);
  if (!report.applied) return;
  applied_.book(*report.applied);
  if (seen_.report.torn > 0) book_torn(*report.applied);
}

// The first contact that was too fast in the pass from records_ to next_, if there is one.
template <class Device, class Real>
Condition GpuBackend<Device, Real>::check_suspects(bool moved) {
  std::vector<std::uint32_t> id_indices(seen_.report.suspects);
  suspects_.download(id_indices.data(), id_indices.size());
  const std::vector<Found> found = look_up(id_indices);
  const Surroundings near = surroundings_of(found, records_.data());
  const ContactScan<Real> scan(rules_, colliders_.view(), near.records.data());
  Condition first;
  for (std::size_t k = 0; k < found.size(); ++k) {
    first = Condition::first(first, contact_too_fast(scan, k, std::span<const std::uint32_t>(near.rows[k]),
                                                     near.records.data(), scene_, ids_, moved));
  }
  return first;
}

template <class Device, class Real>
auto GpuBackend<Device, Real>::surroundings_of(const std::vector<Found>& particles, const Record* records) const
    -> Surroundings {
  const auto count = static_cast<std::uint32_t>(particles.size());
  std::vector<std::uint32_t> slots, first{0};
  for (const Found& p : particles) {
    slots.push_back(p.slot);
    first.push_back(first.back() + p.rows);
  }
  asked_.reserve(count);
  asked_.upload(slots.data(), count);
  asked_first_.reserve(count + 1);
  asked_first_.upload(first.data(), count + 1);
  found_rows_.reserve(first.back());
  std::vector<RowEntry<Real>> entries(first.back());
  if (first.back() > 0) {
    device_.each(count, CopyRows<Real>{records, first_row_.data(), entries_.data(), asked_.data(), asked_first_.data(),
                                       found_rows_.data()});
    found_rows_.download(entries.data(), entries.size());
  }
  Surroundings near;
  std::unordered_map<std::uint32_t, std::uint32_t> index_of;  // by slot
  for (std::uint32_t k = 0; k < count; ++k) {
    index_of.emplace(slots[k], k);
    near.records.push_back(particles[k].record);
  }
  for (std::uint32_t k = 0; k < count; ++k) {
    std::vector<std::uint32_t>& row = near.rows.emplace_back(std::size_t{particles[k].rows} * kSliceLanes, 0);
    for (std::uint32_t at = first[k]; at < first[k + 1]; ++at) {
      const auto [found, is_new] = index_of.emplace(entries[at].slot, static_cast<std::uint32_t>(near.records.size()));
      if (is_new) near.records.push_back(entries[at].record);
      row[std::size_t{at - first[k]} * kSliceLanes + k % kSliceLanes] = record_offset<Real>(found->second);
    }
  }
  return near;
}

// Births and removals ------------------------------------------------------------------------------------------------

template <class Device, class Real>
RemovalSums GpuBackend<Device, Real>::insert(const ParticleSet& newborn) {
  RemovalSums born;
  if (newborn.empty()) return born;
  const auto births = static_cast<std::uint32_t>(newborn.size());
  // Ids of removed particles stay in the table until it is mostly theirs.
  constexpr std::size_t kMostIdIndices = std::size_t{1} << 30U;  // sort_key()
  if (ids_.size() + births > std::min(4 * std::size_t{count_} + 65536, kMostIdIndices)) {
    ParticleSet all;
    hooke::download(*this, scene_.integrator, all);
    take(all, births);
  }
  if (end_ + births + kWarp >= room_) {
    if (end_ - count_ > end_ / 4) sort_by_cell();  // vacant slots drop out
    if (end_ + births + kWarp >= room_) make_room(end_ + births + (end_ + births) / 2);
  }
  std::vector<Record> records;
  std::vector<std::uint64_t> ids;
  std::vector<std::uint32_t> touching;
  const std::size_t first_id_index = ids_.size();
  for (std::size_t k = 0; k < births; ++k) {
    ids_.append(newborn.id[k]);
    const std::size_t id_index = ids_.size() - 1;
    records.push_back(record_of(newborn, k, id_index));
    const Material& m = scene_.materials[newborn.material[k]];
    ++count_of_[newborn.material[k]];
    if (m.interacts) touching.push_back(static_cast<std::uint32_t>(id_index));
    born.add_particle(m.mass, vec_cast<double>(records[k].x), vec_cast<double>(records[k].v), scene_.gravity);
  }
  for (std::size_t id_index = first_id_index; id_index < ids_.size(); ++id_index) ids.push_back(ids_[id_index]);
  ids_on_device_.grow(ids_.size() + (ids_.size() > ids_on_device_.room() ? ids_.size() / 2 : 0), first_id_index);
  ids_on_device_.upload(ids.data(), ids.size(), first_id_index);
  if (slot_of_id_index_.room() < ids_on_device_.room()) {
    const std::size_t before = slot_of_id_index_.room();
    slot_of_id_index_.grow(ids_on_device_.room(), before);
    device_.fill(slot_of_id_index_.data() + before, 0xff, (slot_of_id_index_.room() - before) * sizeof(std::uint32_t));
  }
  records_.upload(records.data(), births, end_);
  device_.each(births, IndexSlots<Real>{records_.data(), end_, slot_of_id_index_.data()});
  if (verlet()) device_.fill(acceleration_.data() + end_, 0, births * sizeof(Vec3<Real>));
  end_ += births;
  applied_.grow(ids_.size());
  applied_.mark_pinned(particles_view());
  recount();
  if (touching.empty()) return born;
  stale_ = true;
  // Newborn particles overlap no other, but cohesion may reach them.
  if (rules_.widest_range() > 0) add_elastic(touching, born.elastic);
  return born;
}

template <class Device, class Real>
Removal GpuBackend<Device, Real>::remove(std::span<const std::uint64_t> ids) {
  Removal removal;
  removal.was_there.assign(ids.size(), 0);
  std::vector<std::uint32_t> id_indices;
  std::vector<std::size_t> asked;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const std::optional<std::uint32_t> id_index = id_index_of_id(ids[k]);
    if (!id_index) continue;
    id_indices.push_back(*id_index);
    asked.push_back(k);
  }
  if (id_indices.empty()) return removal;
  const std::vector<Found> found = look_up(id_indices);
  std::vector<std::uint32_t> there;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (found[k].slot == kNoSlot) continue;
    removal.was_there[asked[k]] = 1;
    there.push_back(id_indices[k]);
  }
  removal.sums = let_go(there, true);
  return removal;
}

template <class Device, class Real>
RemovalSums GpuBackend<Device, Real>::remove_sunk() {
  clear_report();
  device_.each(end_, FindSunk<Real>{records_.data(), scene_on_device_.sinks(), scene_on_device_.sink_count(),
                                    departed_.data(), &block_.data()->report});
  read_report();
  leaving_ = seen_.report.departed;
  return let_go(read_departed(), true);
}

template <class Device, class Real>
std::vector<std::uint32_t> GpuBackend<Device, Real>::read_departed() {
  std::vector<std::uint32_t> id_indices(leaving_);
  departed_.download(id_indices.data(), leaving_);
  leaving_ = 0;
  std::sort(id_indices.begin(), id_indices.end());
  return id_indices;
}

// Removes particles, and returns what they carry: at the end of a step under velocity Verlet, with the velocity after
// the coming half kick.
template <class Device, class Real>
RemovalSums GpuBackend<Device, Real>::let_go(const std::vector<std::uint32_t>& id_indices, bool at_end_of_step) {
  RemovalSums sums;
  if (id_indices.empty()) return sums;
  for (const Found& p : look_up(id_indices)) {
    const Material& m = scene_.materials[static_cast<std::size_t>(p.record.material)];
    const Vec3<Real> v =
        at_end_of_step && verlet() ? kick(p.record.v, p.acceleration, Real(0.5) * rules_.view().dt) : p.record.v;
    sums.add_particle(m.mass, vec_cast<double>(p.record.x), vec_cast<double>(v), scene_.gravity);
    --count_of_[static_cast<std::size_t>(p.record.material)];
  }
  add_elastic(id_indices, sums.elastic);
  std::vector<std::uint32_t> slots;
  std::vector<Record> vacant;
  for (const Found& p : look_up(id_indices)) {  // a new list has moved them
    slots.push_back(p.slot);
    vacant.push_back(vacant_record<Real>(p.record.id_index));
  }
  put_.reserve(vacant.size());
  put_.upload(vacant.data(), vacant.size());
  asked_.upload(slots.data(), slots.size());
  device_.each(static_cast<std::uint32_t>(slots.size()), PutRecords<Real>{records_.data(), asked_.data(), put_.data()});
  recount();
  return sums;
}

// Adds the energy of the contacts and springs that end at one of these particles.
template <class Device, class Real>
void GpuBackend<Device, Real>::add_elastic(const std::vector<std::uint32_t>& id_indices, ExactSum& sum) {
  std::vector<Found> found = look_up(id_indices);
  const auto touches = [&](const Found& p) { return rules_.interacts(static_cast<std::size_t>(p.record.material)); };
  if (applied_.springs().empty() && std::none_of(found.begin(), found.end(), touches)) return;
  if (neighbours_stale()) {
    if (!build_neighbours().good()) return;
    found = look_up(id_indices);
  }
  const Surroundings near = surroundings_of(found, records_.data());
  const ContactScan<Real> scan(rules_, colliders_.view(), near.records.data());
  std::vector<std::uint32_t> among(found.size());
  for (std::uint32_t k = 0; k < among.size(); ++k) among[k] = k;
  for (std::size_t k = 0; k < found.size(); ++k)
    add_contact_energy(scan, k, std::span<const std::uint32_t>(near.rows[k]), std::span<const std::uint32_t>(among),
                       sum);
  add_spring_energy(id_indices, found, sum);
}

// A spring between two of these particles counts half at each.
template <class Device, class Real>
void GpuBackend<Device, Real>::add_spring_energy(const std::vector<std::uint32_t>& id_indices,
                                                 const std::vector<Found>& found, ExactSum& sum) const {
  struct Side {
    std::size_t own;
    std::uint32_t spring;
  };
  std::vector<Side> sides;
  std::vector<std::uint32_t> partners;
  for (std::size_t k = 0; k < id_indices.size(); ++k) {
    applied_.springs().table().for_each_side(id_indices[k], [&](const SpringSide& side) {
      sides.push_back({k, side.spring});
      partners.push_back(side.partner);
    });
  }
  if (sides.empty()) return;
  std::vector<std::uint32_t> among = id_indices;
  std::sort(among.begin(), among.end());
  const std::vector<Found> there = look_up(partners);
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (there[k].slot == kNoSlot) continue;
    const bool both = std::binary_search(among.begin(), among.end(), partners[k]);
    sum.add((both ? 0.5 : 1.0) *
            applied_.springs().table().energy_of(sides[k].spring, found[sides[k].own].record, there[k].record));
  }
}

// What is asked of the state ------------------------------------------------------------------------------------------

template <class Device, class Real>
void GpuBackend<Device, Real>::find_inside(const Box3d& box, std::vector<Occupant>& out) const {
  for (;;) {
    const auto room = static_cast<std::uint32_t>(occupants_.room());
    clear_report();
    device_.each(end_, FindInside<Real>{records_.data(), scene_on_device_.interacts(), scene_on_device_.radius(), box,
                                        occupants_.data(), room, &block_.data()->report});
    read_report();
    const std::uint32_t found = seen_.report.found;
    if (found > room) {
      occupants_.reserve(found + found / 2);
      continue;
    }
    const std::size_t first = out.size();
    out.resize(first + found);
    occupants_.download(out.data() + first, found);
    return;
  }
}

template <class Device, class Real>
std::uint64_t GpuBackend<Device, Real>::particles_hash() const {
  constexpr std::uint32_t kParts = HashParticles<Real>::kParts;
  hash_parts_.reserve(kParts);
  hash_parts_.fill(0, kParts);
  device_.each(end_, HashParticles<Real>{records_.data(), ids_on_device_.data(), hash_parts_.data()});
  std::vector<unsigned long long> all(kParts);
  hash_parts_.download(all.data(), kParts);
  std::uint64_t hash = 0;
  for (const unsigned long long part : all) hash += part;
  return hash;
}

template <class Device, class Real>
Expected<MeasurementSums> GpuBackend<Device, Real>::measure(const Instant& now) {
  place_at(now);
  if (neighbours_stale()) {
    if (const Condition found = build_neighbours(); !found.good()) {
      return fail(Error::Kind::run_failed, formatted("particle {}", found.particle), "is at no finite position");
    }
  }
  std::vector<Record> records(room_);
  records_.download(records.data(), room_);
  const std::uint32_t slices = GpuBackend::slices(listed_);
  std::vector<std::uint32_t> first_row(slices + 1, 0), entries(rows_ * kSliceLanes);
  if (listed_ > 0) {
    first_row_.download(first_row.data(), first_row.size());
    entries_.download(entries.data(), entries.size());
  }
  const ContactScan<Real> scan(rules_, colliders_.view(), records.data());
  MeasurementSums total;
  std::mutex mutex;
  threads_.run([&] {
    parallel_ranges(end_, 1024, [&](std::size_t first, std::size_t last) {
      MeasurementSums part;
      for (std::size_t i = first; i < last; ++i) {
        if (is_vacant(records[i])) continue;
        std::span<const std::uint32_t> rows;
        if (i < listed_) {
          const std::size_t g = i / kSliceLanes;
          rows = std::span<const std::uint32_t>(entries).subspan(first_row[g] * kSliceLanes,
                                                                 (first_row[g + 1] - first_row[g]) * kSliceLanes);
        }
        measure_particle(scan, i, rows, records[i], scene_, part);
      }
      const std::lock_guard lock(mutex);
      total.add(part);
    });
  });
  if (!applied_.springs().empty()) measure_springs(records, total);
  if (!applied_.attraction().empty()) total.add_attraction(applied_.attraction().energy(particles_view(), records));
  return total;
}

template <class Device, class Real>
void GpuBackend<Device, Real>::measure_springs(const std::vector<Record>& records, MeasurementSums& total) const {
  const std::vector<std::uint32_t> slot_of = slots_by_id_index(records);
  const SpringTable<Real>& table = applied_.springs().table();
  ExactSum energy;
  std::uint64_t holding = 0;
  for (std::uint32_t id_index = 0; id_index < slot_of.size(); ++id_index) {
    if (slot_of[id_index] == kNoSlot) continue;
    table.for_each_side(id_index, [&](const SpringSide& side) {
      if (side.partner < id_index || slot_of[side.partner] == kNoSlot) return;
      ++holding;
      energy.add(table.energy_of(side.spring, records[slot_of[id_index]], records[slot_of[side.partner]]));
    });
  }
  total.add_springs(holding, energy);
}

template <class Device, class Real>
NeighbourStatistics GpuBackend<Device, Real>::neighbour_statistics() const {
  const double n = std::max(end_, 1U);
  return {builds_, static_cast<double>(rows_ * kSliceLanes) / n, 0};
}

}  // namespace hooke::gpu
