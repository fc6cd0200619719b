// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hooke/backends/gpu/brick_grid.h"
#include "hooke/backends/gpu/device.h"
#include "hooke/backends/gpu/device_forces.h"
#include "hooke/backends/gpu/device_report.h"
#include "hooke/backends/gpu/device_scene.h"
#include "hooke/backends/gpu/fixed_sum.h"
#include "hooke/backends/gpu/list_kernels.h"
#include "hooke/backends/gpu/population_kernels.h"
#include "hooke/backends/gpu/step_kernels.h"
#include "hooke/base/threads.h"
#include "hooke/core/backend.h"
#include "hooke/core/placed_colliders.h"
#include "hooke/passes/contact_scan.h"
#include "hooke/passes/id_table.h"
#include "hooke/passes/pass_rules.h"

namespace hooke::gpu {

/// The back end of a GPU in one precision. All that happens to particles in a step happens on the device, by the same
/// laws and loops as on a processor, so that all bits are the same. The host lays out buffers, places colliders, and
/// looks closely at the few particles that a step has noticed.
///
/// Slots, after a sort: first the particles that touch others, in the order of their cells; then those that touch none.
/// Newborns follow; a particle that is removed leaves a vacant record. All later slots are vacant, and the last one is
/// the filler of rows.
template <class Device, class Real>
class GpuBackend final : public Backend {
  using Record = ParticleRecord<Real>;

 public:
  /// `threads`: of the host, for measurements and downloads.
  GpuBackend(Device device, int threads) : device_(std::move(device)), threads_(threads) {}

  BackendInfo info() const override {
    const auto precision = sizeof(Real) == 4 ? Precision::single_precision : Precision::double_precision;
    return {std::string("cuda: ") + device_.name(), "gpu", precision, 1};
  }

  void configure(const Scene& scene) override;
  void break_springs(const std::vector<std::uint64_t>& broken) override {
    applied_.springs().table().break_springs(broken);
  }
  std::vector<std::uint64_t> broken_springs() const override { return applied_.springs().table().broken_springs(); }

  void assign(const ParticleSet& particles) override { take(particles); }
  void download(const ParticleColumns<double>& out) const override { download_all(out); }
  void download(const ParticleColumns<float>& out) const override { download_all(out); }
  std::uint64_t particle_count() const override { return count_; }
  std::optional<ParticleAt> find(std::uint64_t id) const override;
  void edit(std::span<const ParticleAt> edited) override;
  RemovalSums insert(const ParticleSet& newborn) override;
  std::optional<std::uint64_t> set_external_forces(std::span<const std::uint64_t> ids,
                                                   std::span<const Vec3d> forces) override;
  Removal remove(std::span<const std::uint64_t> ids) override;
  RemovalSums remove_sunk() override;

  void half_kick_and_drift() override;
  void follow_motion() override;
  void remove_departed(RemovalSums& left) override;
  bool neighbours_stale() override { return (listed_count() > 0 && stale_) || applied_.needs_layout(); }
  Condition build_neighbours() override;
  void apply_forces(const Instant& now, StepReport& report) override { apply_forces_in_a_row({&now, 1}, report); }
  std::size_t most_in_a_row() const override;
  std::size_t apply_forces_in_a_row(std::span<const Instant> steps, StepReport& report) override;
  void evaluate_accelerations(const Instant& now, StepReport& report) override;

  void find_inside(const Box3d& box, std::vector<Occupant>& out) const override;
  std::uint64_t particles_hash() const override;
  Expected<MeasurementSums> measure(const Instant& now) override;
  NeighbourStatistics neighbour_statistics() const override;
  StageTimes stage_times() const override { return times_; }

 private:
  template <class T>
  using DeviceBuffer = Buffer<Device, T>;
  using Found = FoundParticle<Real>;

  ParticlesView<Real> particles_view() const {
    return {records_.data(),
            slot_of_id_index_.data(),
            ids_on_device_.data(),
            static_cast<std::uint32_t>(ids_.size()),
            count_,
            end_,
            room_};
  }

  // What a step writes for the host to read, in one piece: the sums' first copies follow the report.
  struct StepBlock {
    DeviceReport report;
    FixedSum<Real> sums[std::size_t{SumCopies<Real>::kCopies} * PassSum::kCount];
  };
  static constexpr std::size_t kReadBytes =
      offsetof(StepBlock, sums) + std::size_t{PassSum::kCount} * sizeof(FixedSum<Real>);

  bool verlet() const { return scene_.integrator == Integrator::velocity_verlet; }
  std::uint32_t listed_count() const { return count_ - noninteracting_; }
  static std::uint32_t whole_warps(std::uint32_t n) { return (n + kWarp - 1) / kWarp * kWarp; }
  static std::uint32_t slices(std::uint32_t n) { return (n + kLanes - 1) / kLanes; }

  // Particles ---------------------------------------------------------------------------------------------------------

  void take(const ParticleSet& particles, std::size_t births = 0);
  void make_room(std::uint32_t slots);
  void recount();
  Record record_of(const ParticleSet& particles, std::size_t k, std::size_t id_index) const;
  template <class Out>
  void download_all(const ParticleColumns<Out>& out) const;
  void measure_springs(const std::vector<Record>& records, MeasurementSums& total) const;
  std::vector<Found> look_up(const std::vector<std::uint32_t>& id_indices) const;
  std::vector<std::uint32_t> slots_by_id_index(const std::vector<Record>& records) const;
  std::optional<std::uint32_t> id_index_of_id(std::uint64_t id) const;

  // Neighbours --------------------------------------------------------------------------------------------------------

  Condition sort_by_cell();
  void list_neighbours();
  void judge_motion(const StepRunner<Device>& step, std::uint32_t end);
  void read_report(std::size_t bytes = sizeof(DeviceReport)) const;
  void clear_report(std::size_t bytes = sizeof(DeviceReport)) const;
  ListView<Real> list_view() const { return {first_row_.data(), entries_.data(), position_at_build_.data(), listed_}; }

  // The pass ----------------------------------------------------------------------------------------------------------

  void place_at(const Instant& now);
  StepRunner<Device> step_runner() { return {device_, &block_.data()->report}; }
  void start_sums(StepReport& report);
  void run_pass(const Instant& now, Vec3<Real>* acceleration, bool may_tear);
  void read_sums();
  void book_torn(AppliedSums& sums);
  void book_sums(StepReport& report);
  Condition check_suspects(bool moved);
  SumCopies<Real> step_sums() { return {block_.data()->sums, static_cast<std::uint32_t>(PassSum::kCount)}; }
  StepOutput<Real> step_output() {
    return {&block_.data()->report, moves_.data(), step_sums(), suspects_.data(), departed_.data()};
  }

  // Births and removals -----------------------------------------------------------------------------------------------

  std::vector<std::uint32_t> read_departed();
  RemovalSums let_go(const std::vector<std::uint32_t>& id_indices, bool at_end_of_step);
  void add_elastic(const std::vector<std::uint32_t>& id_indices, ExactSum& sum);
  void add_spring_energy(const std::vector<std::uint32_t>& id_indices, const std::vector<Found>& found,
                         ExactSum& sum) const;

  // Some particles and their neighbours, copied to the host: the first are the particles.
  struct Surroundings {
    std::vector<Record> records;
    std::vector<std::vector<std::uint32_t>> rows;  // of each particle, as ContactScan reads them
  };
  Surroundings surroundings_of(const std::vector<Found>& particles, const Record* records) const;

  mutable Device device_;  // first: the buffers need it to the end
  mutable Threads threads_;

  Scene scene_;
  PassRules<Real> rules_;
  DeviceScene<Device, Real> scene_on_device_{device_};
  PlacedColliders<Real> colliders_;  // at the last instant
  std::vector<ColliderPose> placed_;  // where they are
  double skin_ = 0, skin_limit_ = 0;  // m; and what of it is left after rounding

  IdTable ids_;
  std::vector<std::uint32_t> count_of_;  // particles by material
  std::uint32_t count_ = 0, noninteracting_ = 0;
  ExactSum mass_;  // of all, kg
  std::uint32_t end_ = 0;  // one past the last slot in use
  std::uint32_t room_ = 0;  // slots; the last is the filler

  DeviceBuffer<Record> records_{device_}, next_{device_};  // the state, and where a pass writes the next
  DeviceBuffer<Vec3<Real>> acceleration_{device_}, next_acceleration_{device_};
  DeviceBuffer<std::uint64_t> ids_on_device_{device_};
  DeviceBuffer<std::uint32_t> slot_of_id_index_{device_};

  DeviceForces<Device, Real> applied_{device_};

  BrickGrid grid_;
  DeviceBuffer<std::uint32_t> key_{device_}, place_{device_}, start_{device_}, first_row_{device_}, entries_{device_};
  DeviceBuffer<Vec3<Real>> position_at_build_{device_};
  std::uint32_t listed_ = 0;  // particles in the list
  std::uint64_t rows_ = 0, builds_ = 0;
  bool stale_ = true;
  std::size_t list_age_ = 0, lifetime_ = 1;  // steps in a row since the list was built; those of the list before

  mutable DeviceBuffer<StepBlock> block_{device_};
  mutable StepBlock seen_{};  // the part of it that the host has read
  DeviceBuffer<WarpMoves> moves_{device_};
  DeviceBuffer<std::uint32_t> suspects_{device_}, departed_{device_};
  SumWindows windows_;
  std::uint32_t leaving_ = 0;  // particles in departed_, until remove_departed()

  // Working memory of rare calls.
  mutable DeviceBuffer<std::uint32_t> asked_{device_}, asked_first_{device_};
  mutable DeviceBuffer<Found> found_{device_};
  mutable DeviceBuffer<RowEntry<Real>> found_rows_{device_};
  mutable DeviceBuffer<Occupant> occupants_{device_};
  mutable DeviceBuffer<std::byte> column_{device_};
  mutable DeviceBuffer<unsigned long long> hash_parts_{device_};
  DeviceBuffer<Record> put_{device_};

  StageTimes times_;
};

}  // namespace hooke::gpu

#include "hooke/backends/gpu/gpu_backend.inl"
