// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "hooke/backends/gpu/applied_kernels.h"
#include "hooke/backends/gpu/device.h"
#include "hooke/base/ascending.h"
#include "hooke/base/assert.h"
#include "hooke/core/attraction.h"
#include "hooke/core/placed_fields.h"
#include "hooke/core/scene.h"
#include "hooke/core/sums.h"
#include "hooke/passes/id_table.h"

namespace hooke::gpu {

/// Where particles lie, for the forces on them.
template <class Real>
struct ParticlesView {
  const ParticleRecord<Real>* records = nullptr;
  const std::uint32_t* slot_of_id_index = nullptr;
  const std::uint64_t* ids = nullptr;  // by id index
  std::uint32_t id_count = 0;          // id indices
  std::uint32_t end = 0;               // one past the last slot in use
  std::uint32_t room = 0;              // slots; the last is the filler

  std::uint32_t whole_end() const { return (end + kWarp - 1) / kWarp * kWarp; }
  std::uint32_t filler() const { return record_offset<Real>(room - 1); }
};

/// A spring that tore, with the id indices of its ends.
struct TornSpring {
  std::uint32_t spring, a, b;
};

/// The forces beside those of the pass, in the device's memory: springs, fields, attraction, the caller's forces, and
/// particles that are held. A scene without any of this pays nothing.
template <class Device, class Real>
class DeviceForces {
  template <class T>
  using DeviceBuffer = Buffer<Device, T>;

 public:
  explicit DeviceForces(Device& device) : device_(&device) {}

  void configure(const Scene& scene) {
    structure_ = scene.structure;
    scene_.materials = scene.materials;
    scene_.fields = scene.fields;
    scene_.structure = scene.structure;
    period_ = vec_cast<Real>(scene.domain.period());
    for (int axis = 0; axis < 3; ++axis)
      periodic_[axis] = scene.domain.boundary[static_cast<std::size_t>(axis)] == Boundary::periodic;
    length_ = vec_cast<Real>(scene.domain.max - scene.domain.min);
    kick_ = scene.integrator == Integrator::velocity_verlet ? scene.time_step / 2 : scene.time_step;
    std::vector<double> mass;
    std::vector<std::uint8_t> fixed;
    any_fixed_ = false;
    for (const Material& m : scene.materials) {
      mass.push_back(m.mass);
      fixed.push_back(m.fixed ? 1 : 0);
      any_fixed_ = any_fixed_ || m.fixed;
    }
    put(mass_, mass);
    put(fixed_, fixed);
    take_springs();
    blows_on_sheets_ = false;
    for (const PlacedField<Real>& field : place_fields<Real>(scene_, 0))
      blows_on_sheets_ = blows_on_sheets_ || field.blows_on_sheets();
    take_attraction(scene);
    external_ids_.clear();
    windows_ = {};
  }

  void break_springs(const std::vector<std::uint64_t>& broken) {
    HOOKE_ASSERT(is_ascending(broken), broken.size());
    HOOKE_ASSERT(broken.empty() || broken.back() < kind_.size(), broken.back(), kind_.size());
    broken_.assign(kind_.size(), 0);
    for (const std::uint64_t s : broken) broken_[s] = 1;
  }
  std::vector<std::uint64_t> broken_springs() const {
    std::vector<std::uint64_t> all;
    for (std::size_t s = 0; s < broken_.size(); ++s) {
      if (broken_[s] != 0) all.push_back(s);
    }
    return all;
  }

  bool none() const { return !has_springs() && !has_fields() && !attracts_ && external_ids_.empty() && !any_held(); }
  bool has_springs() const { return !kind_.empty(); }
  bool any_held() const { return any_fixed_ || held_by_structure_; }

  /// After a new layout of all particles: finds the ends of springs, cloths, and what the structure holds.
  void bind(const IdTable& ids) {
    bind_springs(ids);
    bind_triangles(ids);
    std::vector<std::uint8_t> held;
    held_by_structure_ = false;
    if (structure_ && !structure_->pinned.empty()) {
      held.assign(ids.size(), 0);
      for (const std::uint64_t id : structure_->pinned) {
        const std::size_t id_index = ids.find(id);
        if (id_index == ids.size()) continue;
        held[id_index] = 1;
        held_by_structure_ = true;
      }
    }
    if (held_by_structure_) put(held_, held);
    bind_external(ids);
    id_count_ = ids.size();
    is_laid_out_ = false;
  }

  /// There are more id indices now; the new ones belong to no spring, no cloth, and are held by their material alone.
  void grow(std::size_t id_indices) {
    if (id_indices == id_count_) return;
    const auto extend = [&](DeviceBuffer<std::uint32_t>& first, std::vector<std::uint32_t>& on_host) {
      if (on_host.empty()) return;
      on_host.resize(id_indices + 1, on_host.back());
      put(first, on_host);
    };
    extend(first_side_, first_side_on_host_);
    extend(first_excluded_, first_excluded_on_host_);
    extend(first_triangle_, first_triangle_on_host_);
    if (held_by_structure_) {
      const std::size_t before = id_count_;
      held_.grow(id_indices + id_indices / 2, before);
      device_->fill(held_.data() + before, 0, held_.room() - before);
    }
    id_count_ = id_indices;
  }

  /// Slots have changed: lay_out() is to follow before the next step.
  void invalidate() { is_laid_out_ = false; }
  bool needs_layout() const { return !is_laid_out_ && (has_springs() || any_held()); }

  /// After a sort of the particles.
  void lay_out(const ParticlesView<Real>& particles) {
    is_laid_out_ = true;
    if (any_held()) mark_held(particles);
    if (!has_springs()) return;
    // Of the whole room: newborns come behind, and have no rows.
    const std::uint32_t slices = particles.room / kLanes;
    first_spring_row_.reserve(slices + 1);
    first_spring_row_.fill(0, slices + 1);
    device_->each(particles.end, CountSpringRows<Real>{particles.records, spring_table(), first_spring_row_.data()});
    device_->scan(first_spring_row_.data(), slices + 1);
    std::uint32_t rows = 0;
    first_spring_row_.download(&rows, 1, slices);
    spring_rows_.reserve(rows);
    device_->each(particles.whole_end(), FillSpringRows<Real>{particles.records, spring_table(),
                                                              first_spring_row_.data(), particles.slot_of_id_index,
                                                              spring_rows_.data(), particles.filler(), particles.end});
  }

  /// Newborns have been added.
  void mark_held(const ParticlesView<Real>& particles) {
    if (!any_held()) return;
    const std::uint32_t slices = particles.whole_end() / kLanes;
    held_bits_.reserve(particles.room / kSliceLanes + 1);
    device_->each(slices, MarkHeld<Real>{particles.records, fixed_.data(), held_by_structure_ ? held_.data() : nullptr,
                                         held_bits_.data()});
  }

  /// A bit for each particle that is held, an entry a slice; null where none is.
  const std::uint16_t* held() const { return any_held() ? held_bits_.data() : nullptr; }

  /// Pairs that springs keep apart.
  ExcludedPairs excluded() const {
    if (first_excluded_on_host_.empty()) return {};
    return {first_excluded_.data(), excluded_.data()};
  }

  /// Backend::set_external_forces().
  void set_external(const IdTable& ids, std::span<const std::uint64_t> of, std::span<const Vec3d> forces) {
    external_ids_.assign(of.begin(), of.end());
    external_on_host_.clear();
    for (const Vec3d& force : forces) external_on_host_.push_back(vec_cast<Real>(force));
    bind_external(ids);
  }

  /// Sums all forces at `time` (s) into one column, N by slot; null where nothing acts. With `may_tear`, springs that
  /// are stretched too far break, and are counted in DeviceReport::torn (take_torn()).
  const Vec3<Real>* apply(const ParticlesView<Real>& particles, double time, bool may_tear, DeviceReport* report) {
    applied_.clear();
    clear(work_sums_, kSums);
    if (any_held()) clear(hold_sums_, HoldSum::count);
    const std::uint32_t end = particles.whole_end();
    if (has_springs()) {
      SpringPass<Real> pass;
      pass.records = particles.records;
      pass.kinds = kinds_.data();
      pass.force = column(spring_force_, particles.room);
      pass.may_tear = may_tear && tearable_;
      pass.length = length_;
      for (int axis = 0; axis < 3; ++axis) {
        pass.periodic[axis] = periodic_[axis];
        pass.any_periodic = pass.any_periodic || periodic_[axis];
      }
      power_.reserve(particles.room);
      torn_.reserve(kind_.size());
      device_->each(end, PullBySprings<Real>{pass, spring_rows_.data(), first_spring_row_.data(), power_.data(),
                                             work_sums(), windows_.dissipation, spring_table(), report, torn_.data()});
      applied_.push_back({Cause::springs, spring_force_.data()});
    }
    if (has_fields()) {
      push_by_fields(particles, time);
      applied_.push_back({Cause::field, field_force_.data()});
    }
    if (attracts_) {
      pull(particles);
      applied_.push_back({Cause::attraction, attraction_force_.data()});
    }
    if (!external_ids_.empty()) {
      put_external(particles);
      applied_.push_back({Cause::external, external_column_.data()});
    }
    if (applied_.empty()) return nullptr;
    if (applied_.size() == 1) return applied_.front().force;
    Vec3<Real>* const total = column(total_, particles.room);
    for (std::size_t k = 0; k < applied_.size(); ++k)
      device_->each(end, AddForces<Real>{applied_[k].force, total, k == 0});
    return total;
  }

  /// After the pass: puts held particles back, and sums the work of each force. `acceleration` (velocity Verlet, else
  /// null) is that of the coming half kick.
  void finish(const ParticlesView<Real>& particles, ParticleRecord<Real>* after, Vec3<Real>* acceleration) {
    const std::uint32_t end = particles.whole_end();
    if (any_held()) {
      device_->each(particles.end, HoldStill<Real>{held_bits_.data(), particles.records, after, acceleration,
                                                   mass_.data(), kick_, hold_sums()});
    }
    for (std::size_t k = 0; k < applied_.size(); ++k) {
      device_->each(end, SumWork<Real>{particles.records, after, applied_[k].force, acceleration,
                                       static_cast<Real>(kick_), applied_[k].cause != Cause::springs, particles.end,
                                       work_sums(), first_sum(k), windows_.applied[k]});
    }
  }

  /// Adds what apply() and finish() have summed.
  void book(AppliedSums& to) {
    const std::vector<FixedSum<Real>> sums = read(work_sums_, work_sums());
    const auto take = [&](std::uint32_t sum, SumWindow& window, ExactSum& into) {
      add_fixed(sums[sum], window, into);
      if (sums[sum].largest != 0) window = SumWindow::around(sums[sum].largest);
    };
    take(0, windows_.dissipation, to.springs.dissipation);
    for (std::size_t k = 0; k < applied_.size(); ++k) {
      AppliedSums::Rates& rates = to[applied_[k].cause];
      SumWindow* const windows = windows_.applied[k].of;
      take(first_sum(k) + AppliedSum::power, windows[AppliedSum::power], rates.power);
      take(first_sum(k) + AppliedSum::next_power, windows[AppliedSum::next_power], rates.next_power);
      for (int axis = 0; axis < 3; ++axis) {
        take(first_sum(k) + AppliedSum::force + static_cast<std::uint32_t>(axis), windows[AppliedSum::force + axis],
             rates.force[axis]);
      }
    }
    if (!any_held()) return;
    const std::vector<FixedSum<double>> held = read(hold_sums_, hold_sums());
    AppliedSums::Rates& hold = to[Cause::hold];
    add_fixed(held[HoldSum::power], {}, hold.power);
    add_fixed(held[HoldSum::power], {}, hold.next_power);
    for (int axis = 0; axis < 3; ++axis)
      add_fixed(held[static_cast<std::size_t>(HoldSum::force + axis)], {}, hold.force[axis]);
  }

  /// The springs that tore in apply(), of which the device has reported `count`. From now on they are broken, and their
  /// ends may touch; `changed` tells whether that takes a new list.
  std::vector<TornSpring> take_torn(std::uint32_t count, bool& changed) {
    std::vector<std::uint32_t> springs(count);
    torn_.download(springs.data(), count);
    std::vector<TornSpring> torn;
    for (const std::uint32_t s : springs) {
      broken_[s] = 1;
      torn.push_back({s, ends_[2 * std::size_t{s}], ends_[2 * std::size_t{s} + 1]});
      if (structure_->springs.contact[s] == 0) {
        release(ends_[2 * std::size_t{s}], ends_[2 * std::size_t{s} + 1]);
        changed = true;
      }
    }
    if (changed) put(excluded_, excluded_on_host_);
    return torn;
  }

  /// The energy of a spring between two records, J.
  double energy_of(std::uint32_t spring, const ParticleRecord<Real>& i, const ParticleRecord<Real>& p) const {
    const SpringKind<Real>& kind = kinds_on_host_[kind_[spring]];
    const Vec3<Real> x_ip = nearest_displacement(i.x, p.x, period_);
    const Real extension = hooke::sqrt_of(dot(x_ip, x_ip)) - rest_length_[spring];
    return spring_acts(extension, kind.side) ? static_cast<double>(spring_energy(extension, kind.stiffness)) : 0.0;
  }
  /// visit(spring, partner) for each spring of an id index that holds; the partner's id index.
  template <class Visit>
  void for_each_side(std::uint32_t id_index, const Visit& visit) const {
    if (!has_springs()) return;
    for (std::uint32_t k = first_side_on_host_[id_index]; k < first_side_on_host_[id_index + 1]; ++k) {
      const SpringSide& side = sides_on_host_[k];
      if (broken_[side.spring] == 0) visit(side.spring, side.partner);
    }
  }

  /// The energy of all particles in the attraction of the others, J.
  std::optional<double> attraction_energy(const ParticlesView<Real>& particles,
                                          const std::vector<ParticleRecord<Real>>& records) {
    if (!attracts_) return std::nullopt;
    const std::uint32_t count = gather_sources(particles);
    power_.reserve(particles.room);
    device_->each(particles.end,
                  PotentialDirectly<Real>{particles.records, sources_.data(), source_block_.data(), count,
                                          inverse_length(), static_cast<Real>(softening2_), power_.data()});
    std::vector<Real> potential(particles.end);
    power_.download(potential.data(), particles.end);
    const double per_unit = units_.mass / units_.length;
    ExactSum energy;
    for (std::size_t i = 0; i < particles.end; ++i) {
      if (is_vacant(records[i])) continue;
      const double weight = weight_[static_cast<std::size_t>(records[i].material)];
      energy.add(0.5 * (weight * per_unit) * static_cast<double>(potential[i]));
    }
    return energy.value();
  }

 private:
  struct Applied {
    Cause cause;
    const Vec3<Real>* force;  // N
  };
  static constexpr std::size_t kMostApplied = 4;
  // The dissipation of springs, and what each applied force does; what holding takes.
  static constexpr std::uint32_t kSums = 1 + kMostApplied * AppliedSum::count;
  static constexpr std::uint32_t first_sum(std::size_t applied) {
    return 1 + static_cast<std::uint32_t>(applied) * AppliedSum::count;
  }
  SumCopies<Real> work_sums() { return {work_sums_.data(), kSums}; }
  SumCopies<double> hold_sums() { return {hold_sums_.data(), HoldSum::count}; }
  struct Windows {
    SumWindow dissipation;
    AppliedWindows applied[kMostApplied];
  };

  template <class R>
  static void clear(DeviceBuffer<FixedSum<R>>& sums, std::uint32_t count) {
    sums.reserve(SumCopies<R>::kCopies * count);
    sums.fill(0, SumCopies<R>::kCopies * count);
  }
  // Sums up the copies.
  template <class R>
  std::vector<FixedSum<R>> read(DeviceBuffer<FixedSum<R>>& buffer, const SumCopies<R>& copies) {
    const AddCopies<R> add{copies};
    device_->each(add.items(), add);
    std::vector<FixedSum<R>> sums(copies.count);
    buffer.download(sums.data(), sums.size());
    return sums;
  }

  bool has_fields() const { return !scene_.fields.empty(); }

  template <class T>
  void put(DeviceBuffer<T>& to, const std::vector<T>& from) {
    to.reserve(from.size());
    to.upload(from.data(), from.size());
  }
  Vec3<Real>* column(DeviceBuffer<Vec3<Real>>& of, std::uint32_t room) {
    of.reserve(room);
    return of.data();
  }

  SpringTable<Real> spring_table() {
    return {first_side_.data(), sides_.data(), kind_on_device_.data(), rest_length_on_device_.data(),
            broken_on_device_.data()};
  }

  void take_springs() {
    constexpr Real kInfinite = std::numeric_limits<Real>::infinity(), kNever = std::numeric_limits<Real>::quiet_NaN();
    kinds_on_host_.assign(kFirstSpringKind, {Real(0), Real(0), kInfinite, kNever});
    kind_.clear();
    rest_length_.clear();
    tearable_ = false;
    if (structure_) {
      const SpringSet& springs = structure_->springs;
      std::map<std::tuple<double, double, double, SpringMode>, std::uint32_t> known;
      for (std::size_t s = 0; s < springs.size(); ++s) {
        const auto [kind, is_new] =
            known.try_emplace({springs.stiffness[s], springs.damping[s], springs.break_strain[s], springs.mode[s]},
                              static_cast<std::uint32_t>(kinds_on_host_.size()));
        if (is_new) {
          const SpringMode mode = springs.mode[s];
          kinds_on_host_.push_back({static_cast<Real>(springs.stiffness[s]), static_cast<Real>(springs.damping[s]),
                                    static_cast<Real>(springs.break_strain[s]),
                                    Real(mode == SpringMode::compression ? -1
                                         : mode == SpringMode::extension ? 1
                                                                         : 0)});
          tearable_ = tearable_ || kinds_on_host_.back().break_strain < kInfinite;
        }
        kind_.push_back(kind->second);
        rest_length_.push_back(static_cast<Real>(springs.rest_length[s]));
      }
    }
    broken_.assign(kind_.size(), 0);
  }

  void bind_springs(const IdTable& ids) {
    first_side_on_host_.clear();
    first_excluded_on_host_.clear();
    if (!has_springs()) return;
    const SpringSet& springs = structure_->springs;
    ends_.assign(2 * kind_.size(), kNoSlot);
    std::vector<std::uint32_t> next, next_excluded;
    first_side_on_host_.assign(ids.size() + 1, 0);
    first_excluded_on_host_.assign(ids.size() + 1, 0);
    const auto each = [&](const auto& visit) {
      for (std::uint32_t s = 0; s < kind_.size(); ++s) {
        const std::size_t a = ids.find(springs.a[s]), b = ids.find(springs.b[s]);
        if (a < ids.size() && b < ids.size())
          visit(s, static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                springs.contact[s] == 0 && broken_[s] == 0);
      }
    };
    each([&](std::uint32_t s, std::uint32_t a, std::uint32_t b, bool apart) {
      ends_[2 * std::size_t{s}] = a;
      ends_[2 * std::size_t{s} + 1] = b;
      for (const std::uint32_t end : {a, b}) {
        ++first_side_on_host_[end + 1];
        first_excluded_on_host_[end + 1] += apart ? 1 : 0;
      }
    });
    for (std::size_t k = 0; k < ids.size(); ++k) {
      first_side_on_host_[k + 1] += first_side_on_host_[k];
      first_excluded_on_host_[k + 1] += first_excluded_on_host_[k];
    }
    next.assign(first_side_on_host_.begin(), first_side_on_host_.end() - 1);
    next_excluded.assign(first_excluded_on_host_.begin(), first_excluded_on_host_.end() - 1);
    sides_on_host_.resize(first_side_on_host_.back());
    excluded_on_host_.resize(first_excluded_on_host_.back());
    each([&](std::uint32_t s, std::uint32_t a, std::uint32_t b, bool apart) {
      sides_on_host_[next[a]++] = {s, b};
      sides_on_host_[next[b]++] = {s, a};
      if (!apart) return;
      excluded_on_host_[next_excluded[a]++] = b;
      excluded_on_host_[next_excluded[b]++] = a;
    });
    if (excluded_on_host_.empty()) first_excluded_on_host_.clear();
    put(kinds_, kinds_on_host_);
    put(kind_on_device_, kind_);
    put(rest_length_on_device_, rest_length_);
    put(broken_on_device_, broken_);
    put(first_side_, first_side_on_host_);
    put(sides_, sides_on_host_);
    put(first_excluded_, first_excluded_on_host_);
    put(excluded_, excluded_on_host_);
  }

  void release(std::uint32_t a, std::uint32_t b) {
    const auto strike = [&](std::uint32_t from, std::uint32_t partner) {
      const auto first = excluded_on_host_.begin() + first_excluded_on_host_[from];
      const auto last = excluded_on_host_.begin() + first_excluded_on_host_[from + 1];
      const auto found = std::find(first, last, partner);
      HOOKE_ASSERT(found != last, from, partner);
      *found = kNoSlot;
    };
    strike(a, b);
    strike(b, a);
  }

  void bind_triangles(const IdTable& ids) {
    first_triangle_on_host_.clear();
    triangle_count_ = 0;
    if (!blows_on_sheets_ || !structure_) return;
    std::vector<std::uint32_t> corners;
    for (const Surface& surface : structure_->surfaces) {
      for (std::size_t t = 0; t < surface.triangles.size(); t += 3) {
        std::array<std::uint32_t, 3> id_indices;
        for (std::size_t k = 0; k < 3; ++k)
          id_indices[k] = static_cast<std::uint32_t>(ids.find(surface.particles[surface.triangles[t + k]]));
        if (std::max({id_indices[0], id_indices[1], id_indices[2]}) < ids.size())
          corners.insert(corners.end(), id_indices.begin(), id_indices.end());
      }
    }
    triangle_count_ = static_cast<std::uint32_t>(corners.size() / 3);
    if (triangle_count_ == 0) return;
    first_triangle_on_host_.assign(ids.size() + 1, 0);
    for (const std::uint32_t id_index : corners) ++first_triangle_on_host_[id_index + 1];
    for (std::size_t k = 0; k < ids.size(); ++k) first_triangle_on_host_[k + 1] += first_triangle_on_host_[k];
    std::vector<std::uint32_t> own(corners.size());
    std::vector<std::uint32_t> next(first_triangle_on_host_.begin(), first_triangle_on_host_.end() - 1);
    for (std::size_t k = 0; k < corners.size(); ++k) own[next[corners[k]]++] = static_cast<std::uint32_t>(k / 3);
    put(corners_, corners);
    put(first_triangle_, first_triangle_on_host_);
    put(own_triangles_, own);
    on_triangle_.reserve(triangle_count_);
  }

  void push_by_fields(const ParticlesView<Real>& particles, double time) {
    Vec3<Real>* const force = column(field_force_, particles.room);
    using Feeling = typename FieldView<Real>::Feeling;
    const std::vector<PlacedField<Real>> fields = place_fields<Real>(scene_, time);
    std::vector<Feeling> feels;
    for (const PlacedField<Real>& field : fields)
      feels.insert(feels.end(), field.feels, field.feels + scene_.materials.size());
    put(feels_, feels);
    for (std::size_t k = 0; k < fields.size(); ++k) {
      FieldView<Real> view = fields[k];
      view.feels = feels_.data() + k * scene_.materials.size();
      const bool on_sheets = view.blows_on_sheets() && triangle_count_ > 0;
      if (on_sheets) {
        device_->each(triangle_count_, BlowOnTriangles<Real>{view, particles.records, particles.slot_of_id_index,
                                                             corners_.data(), period_, on_triangle_.data()});
      }
      device_->each(particles.whole_end(),
                    PushByField<Real>{view, particles.records, k == 0, on_sheets ? first_triangle_.data() : nullptr,
                                      own_triangles_.data(), on_triangle_.data(), force});
    }
  }

  void take_attraction(const Scene& scene) {
    attracts_ = scene.attraction.has_value();
    if (!attracts_) return;
    exact_ = scene.attraction->exact;
    units_ = attraction_units(scene);
    softening2_ = softening_squared(scene) / (units_.length * units_.length);
    const double per_unit = units_.mass / (units_.length * units_.length);
    std::vector<Real> mass, force_of;
    weight_.clear();
    for (const Material& m : scene.materials) {
      mass.push_back(static_cast<Real>(m.mass / units_.mass));
      weight_.push_back(m.mass * scene.attraction->constant);
      force_of.push_back(static_cast<Real>(weight_.back() * per_unit));
    }
    put(source_mass_, mass);
    put(force_of_, force_of);
  }

  Real inverse_length() const { return static_cast<Real>(1 / units_.length); }

  // Puts all particles in order of their ids; returns how many.
  std::uint32_t gather_sources(const ParticlesView<Real>& particles) {
    source_rank_.reserve(particles.id_count + 1);
    source_rank_.fill(0, particles.id_count + 1);
    device_->each(particles.id_count,
                  MarkPresent<Real>{particles.records, particles.slot_of_id_index, source_rank_.data()});
    device_->scan(source_rank_.data(), particles.id_count + 1);
    std::uint32_t count = 0;
    source_rank_.download(&count, 1, particles.id_count);
    sources_.reserve(count);
    source_block_.reserve(count);
    device_->each(particles.id_count,
                  GatherSources<Real>{particles.records, particles.slot_of_id_index, source_rank_.data(), particles.ids,
                                      source_mass_.data(), inverse_length(), sources_.data(), source_block_.data()});
    return count;
  }

  void pull(const ParticlesView<Real>& particles) {
    const std::uint32_t count = gather_sources(particles);
    Vec3<Real>* const force = column(attraction_force_, particles.room);
    const auto run = [&](auto math) {
      device_->each(particles.whole_end(),
                    PullDirectly<Real, decltype(math)>{particles.records, sources_.data(), source_block_.data(), count,
                                                       force_of_.data(), inverse_length(),
                                                       static_cast<Real>(softening2_), force});
    };
    exact_ ? run(ExactMath{}) : run(FastMath{});
  }

  // Those whose particles the table still knows.
  void bind_external(const IdTable& ids) {
    std::vector<std::uint32_t> id_indices;
    std::vector<Vec3<Real>> forces;
    for (std::size_t k = 0; k < external_ids_.size(); ++k) {
      const std::size_t id_index = ids.find(external_ids_[k]);
      if (id_index == ids.size()) continue;
      id_indices.push_back(static_cast<std::uint32_t>(id_index));
      forces.push_back(external_on_host_[k]);
    }
    put(external_asked_, id_indices);
    put(external_force_, forces);
    external_count_ = static_cast<std::uint32_t>(id_indices.size());
  }

  void put_external(const ParticlesView<Real>& particles) {
    Vec3<Real>* const force = column(external_column_, particles.room);
    external_column_.fill(0, particles.room);
    const std::uint32_t count = external_count_;
    external_found_.reserve(count);
    device_->each(count, FindSlots<Real>{particles.records, particles.slot_of_id_index, external_asked_.data(),
                                         external_found_.data()});
    device_->each(count, PutForces<Real>{external_found_.data(), external_force_.data(), force});
  }

  Device* device_;
  std::shared_ptr<const Structure> structure_;
  Scene scene_;  // the parts that fields need
  Vec3<Real> period_{}, length_{};  // m
  bool periodic_[3]{};
  double kick_ = 0;  // s
  std::size_t id_count_ = 0;
  bool is_laid_out_ = false;
  DeviceBuffer<double> mass_{*device_};  // by material, kg
  DeviceBuffer<std::uint8_t> fixed_{*device_};  // likewise

  // Springs, on the host and on the device.
  std::vector<SpringKind<Real>> kinds_on_host_;
  std::vector<std::uint32_t> kind_;  // by spring
  std::vector<Real> rest_length_;  // likewise, m
  std::vector<std::uint8_t> broken_;
  std::vector<std::uint32_t> ends_;  // two id indices a spring
  std::vector<std::uint32_t> first_side_on_host_, first_excluded_on_host_, excluded_on_host_;
  std::vector<SpringSide> sides_on_host_;
  bool tearable_ = false;
  DeviceBuffer<SpringKind<Real>> kinds_{*device_};
  DeviceBuffer<std::uint32_t> kind_on_device_{*device_}, first_side_{*device_}, first_excluded_{*device_},
      excluded_{*device_}, first_spring_row_{*device_}, torn_{*device_};
  DeviceBuffer<Real> rest_length_on_device_{*device_}, power_{*device_};
  DeviceBuffer<std::uint8_t> broken_on_device_{*device_};
  DeviceBuffer<SpringSide> sides_{*device_};
  DeviceBuffer<SpringRow<Real>> spring_rows_{*device_};
  DeviceBuffer<Vec3<Real>> spring_force_{*device_};

  // Fields.
  bool blows_on_sheets_ = false;
  std::uint32_t triangle_count_ = 0;
  std::vector<std::uint32_t> first_triangle_on_host_;
  DeviceBuffer<std::uint32_t> corners_{*device_}, first_triangle_{*device_}, own_triangles_{*device_};
  DeviceBuffer<typename FieldView<Real>::Feeling> feels_{*device_};
  DeviceBuffer<Vec3<Real>> on_triangle_{*device_}, field_force_{*device_};

  // Attraction.
  bool attracts_ = false, exact_ = true;
  AttractionUnits units_;
  double softening2_ = 0;  // in units
  std::vector<double> weight_;  // by material: mass times G
  DeviceBuffer<Real> source_mass_{*device_}, force_of_{*device_};
  DeviceBuffer<std::uint32_t> source_rank_{*device_};
  DeviceBuffer<PullSource<Real>> sources_{*device_};
  DeviceBuffer<std::uint64_t> source_block_{*device_};
  DeviceBuffer<Vec3<Real>> attraction_force_{*device_};

  // The caller's forces.
  std::vector<std::uint64_t> external_ids_;
  std::vector<Vec3<Real>> external_on_host_;  // N, of each
  std::uint32_t external_count_ = 0;  // on the device
  DeviceBuffer<std::uint32_t> external_asked_{*device_}, external_found_{*device_};
  DeviceBuffer<Vec3<Real>> external_force_{*device_}, external_column_{*device_};

  // Held particles.
  bool any_fixed_ = false, held_by_structure_ = false;
  DeviceBuffer<std::uint8_t> held_{*device_};  // by id index
  DeviceBuffer<std::uint16_t> held_bits_{*device_};

  std::vector<Applied> applied_;  // in the order of their sum
  DeviceBuffer<Vec3<Real>> total_{*device_};
  DeviceBuffer<FixedSum<Real>> work_sums_{*device_};
  DeviceBuffer<FixedSum<double>> hold_sums_{*device_};
  Windows windows_;
};

}  // namespace hooke::gpu
