// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Replaces everything that needs HDF5 in a build without it: checkpoints, and the snapshots of runs.
#include <memory>
#include <mutex>

#include "hooke/io/checkpoint.h"
#include "hooke/io/checkpoint_slices.h"
#include "hooke/io/failure.h"
#include "hooke/io/hdf5_library.h"
#include "hooke/io/particles_file.h"

namespace hooke::io {

namespace {

Error needs_hdf5(const std::filesystem::path& file) {
  return {Error::Kind::bad_input, {{file.string(), "needs HDF5, which is not in this build (HOOKE_WITH_HDF5)"}}};
}

}  // namespace

Expected<void> write_checkpoint(const std::filesystem::path& file, const SimulationState&, const RunInfo&) {
  return fail(needs_hdf5(file));
}
Expected<void> write_checkpoint(const std::filesystem::path& file, const SimulationState&, const ParticleSlices&,
                                const RunInfo&) {
  return fail(needs_hdf5(file));
}
Expected<Checkpoint> read_checkpoint(const std::filesystem::path& file) { return fail(needs_hdf5(file)); }
Expected<CheckpointInSlices> read_checkpoint_in_slices(const std::filesystem::path& file) {
  return fail(needs_hdf5(file));
}
Expected<std::shared_ptr<const Structure>> read_structure_of_run(const std::filesystem::path& folder) {
  return fail(needs_hdf5(folder));
}
Expected<bool> is_checkpoint(const std::filesystem::path& file) { return fail(needs_hdf5(file)); }

void hdf5::require(const std::filesystem::path& file) { throw Failure(needs_hdf5(file)); }
std::unique_lock<std::recursive_mutex> hdf5::lock() { return {}; }

// No file is ever open, so no object of these classes exists.
class hdf5::File {};
struct ParticlesFile::Columns {};
ParticlesFile::~ParticlesFile() = default;
ParticlesFile::ParticlesFile(ParticlesFile&&) noexcept = default;
ParticlesFile& ParticlesFile::operator=(ParticlesFile&&) noexcept = default;
ParticlesFile ParticlesFile::create(const std::filesystem::path& path, const RunInfo&) {
  throw Failure(needs_hdf5(path));
}
ParticlesFile ParticlesFile::update(const std::filesystem::path& path, const RunInfo&, std::int64_t) {
  throw Failure(needs_hdf5(path));
}
void ParticlesFile::append(std::int64_t, double, const ParticleSlices&) {}
void ParticlesFile::sync() const {}

ParticlesContents read_particles_contents(const std::filesystem::path& path) { throw Failure(needs_hdf5(path)); }
Snapshot read_particles(const std::filesystem::path& path, std::size_t) { throw Failure(needs_hdf5(path)); }

}  // namespace hooke::io
