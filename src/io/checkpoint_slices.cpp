// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/checkpoint_slices.h"

#include <algorithm>
#include <utility>

#include "hooke/base/floating_point.h"
#include "hooke/io/checkpoint_parts.h"
#include "hooke/io/failure.h"
#include "hooke/io/hdf5.h"
#include "hooke/io/run_folder.h"
#include "hooke/io/seal.h"

namespace hooke::io {
namespace {

static_assert(sizeof(Vec3d) == 3 * sizeof(double));

// The columns of an open file.
struct Columns {
  Columns(hdf5::File of, const std::filesystem::path& path)
      : file(std::move(of)),
        id(file.id(), "id"),
        material(file.id(), "material"),
        position(file.id(), "position", 3),
        velocity(file.id(), "velocity", 3),
        acceleration(file.id(), "acceleration", 3),
        bytes(file.bytes().size()) {
    const hsize_t n = id.rows();
    if (material.rows() != n || position.rows() != n || velocity.rows() != n ||
        (acceleration.rows() != n && acceleration.rows() != 0)) {
      throw Failure(Error::Kind::bad_input, path, kTablesDiffer);
    }
  }

  bool has_accelerations() const { return acceleration.rows() > 0; }

  // `count` particles from `first` on.
  void read(hsize_t first, std::size_t count, ParticleSet& slice, const std::filesystem::path& path) const {
    slice.resize(count);
    slice.acceleration.resize(has_accelerations() ? count : 0);
    id.read(first, count, slice.id.data());
    material.read(first, count, slice.material.data());
    read_vectors(position, first, slice.position);
    read_vectors(velocity, first, slice.velocity);
    read_vectors(acceleration, first, slice.acceleration);
    check(path);
  }

  // A file that has been cut short reads as if it went on with zeros.
  void check(const std::filesystem::path& path) const {
    file.check_reads();
    if (file.bytes().size() != bytes) throw Failure(Error::Kind::io, path, "has changed while it was read");
  }

  hdf5::File file;
  hdf5::ArrayRows<std::uint64_t> id;
  hdf5::ArrayRows<std::uint16_t> material;
  hdf5::ArrayRows<double> position, velocity, acceleration;
  std::uint64_t bytes;

 private:
  static void read_vectors(const hdf5::ArrayRows<double>& from, hsize_t first, std::vector<Vec3d>& to) {
    if (!to.empty()) from.read(first, to.size(), &to.front().x);
  }
};

class SlicesOfCheckpoint final : public ParticleSlices {
 public:
  SlicesOfCheckpoint(hdf5::File file, const std::filesystem::path& path)
      : path_(path),
        columns_(std::make_unique<Columns>(std::move(file), path)),
        size_(columns_->id.rows()),
        has_accelerations_(columns_->has_accelerations()) {
    constexpr std::size_t kRows = std::size_t{1} << 16U;
    ParticleSet slice;
    for (std::uint64_t first = 0; first < size_; first += kRows) {
      slice.id.resize(std::min<std::uint64_t>(kRows, size_ - first));
      slice.material.resize(slice.size());
      columns_->id.read(first, slice.size(), slice.id.data());
      columns_->material.read(first, slice.size(), slice.material.data());
      ParticleSlice named;
      named.id = slice.id;
      named.material = slice.material;
      identity_ += named.identity();
    }
    columns_->check(path_);
  }
  ~SlicesOfCheckpoint() override {
    const auto held = hdf5::lock();
    columns_.reset();
  }
  SlicesOfCheckpoint(const SlicesOfCheckpoint&) = delete;
  SlicesOfCheckpoint& operator=(const SlicesOfCheckpoint&) = delete;

  std::uint64_t size() const override { return size_; }
  std::uint64_t identity() const override { return identity_; }
  bool has_accelerations() const override { return has_accelerations_; }
  Expected<void> visit(std::size_t rows, const Take& take) const override {
    return guarded(path_, [&] {
      ParticleSet slice;
      for (std::uint64_t first = 0; first < size_; first += rows) {
        {
          const auto held = hdf5::lock();
          columns_->read(first, static_cast<std::size_t>(std::min<std::uint64_t>(rows, size_ - first)), slice, path_);
        }
        take(ParticleSlice(slice, 0, slice.size()));
      }
    });
  }

 private:
  std::filesystem::path path_;
  std::unique_ptr<Columns> columns_;
  std::uint64_t size_;
  bool has_accelerations_;
  std::uint64_t identity_ = 0;
};

}  // namespace

Expected<CheckpointInSlices> read_checkpoint_in_slices(const std::filesystem::path& file) {
  const FloatingPointGuard floating_point;
  return guarded(file, [&] {
    std::error_code ignored;
    const std::filesystem::path path = std::filesystem::is_directory(file, ignored) ? file / kCheckpointFile : file;
    check_seal(path);
    const auto held = hdf5::lock();
    hdf5::File opened(path, JournaledFile::Mode::read);
    CheckpointInSlices checkpoint;
    checkpoint.rest = read_all_but_particles(opened, path);
    checkpoint.particles = std::make_shared<SlicesOfCheckpoint>(std::move(opened), path);
    return checkpoint;
  });
}

}  // namespace hooke::io
