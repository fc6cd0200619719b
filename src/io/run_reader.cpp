// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "hooke/base/assert.h"
#include "hooke/io/failure.h"
#include "hooke/io/output_file.h"
#include "hooke/io/particles_file.h"
#include "hooke/io/run_folder.h"

namespace hooke::io {

namespace fs = std::filesystem;

struct RunReader::Impl {
  fs::path file;
  ParticlesContents contents;
};

RunReader::RunReader(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RunReader::~RunReader() = default;
RunReader::RunReader(RunReader&&) noexcept = default;
RunReader& RunReader::operator=(RunReader&&) noexcept = default;

Expected<RunReader> RunReader::open(const fs::path& run) {
  return guarded(run, [&]() -> RunReader {
    if (!is_there(run)) throw Failure(Error::Kind::bad_input, run, "does not exist");
    const bool folder = fs::is_directory(run);
    const fs::path file = folder ? run / kParticlesFile : run;
    if (folder && !is_there(file)) {
      throw Failure(Error::Kind::bad_input, run, std::string("is no run folder: it has no ") + kParticlesFile);
    }
    const auto held = hdf5::lock();
    return RunReader(std::make_unique<Impl>(Impl{file, read_particles_contents(file)}));
  });
}

const RunInfo& RunReader::info() const { return impl_->contents.info; }
const fs::path& RunReader::file() const { return impl_->file; }
std::size_t RunReader::size() const { return impl_->contents.steps.size(); }
std::span<const std::int64_t> RunReader::steps() const { return impl_->contents.steps; }
std::span<const double> RunReader::times() const { return impl_->contents.times; }
std::span<const std::uint64_t> RunReader::particle_counts() const { return impl_->contents.particles; }

std::optional<std::size_t> RunReader::find_step(std::int64_t step) const {
  const auto& steps = impl_->contents.steps;
  const auto it = std::lower_bound(steps.begin(), steps.end(), step);
  if (it == steps.end() || *it != step) return std::nullopt;
  return static_cast<std::size_t>(it - steps.begin());
}

std::optional<std::size_t> RunReader::find_time(double seconds) const {
  const auto& times = impl_->contents.times;
  if (times.empty()) return std::nullopt;
  const auto nearest = std::min_element(times.begin(), times.end(), [seconds](double a, double b) {
    return std::abs(a - seconds) < std::abs(b - seconds);
  });
  return static_cast<std::size_t>(nearest - times.begin());
}

// Opens the file anew each time, because a run still in progress changes it.
Expected<Snapshot> RunReader::read(std::size_t index) const {
  HOOKE_ASSERT(index < size(), index, size());
  return guarded(impl_->file, [&] {
    const auto held = hdf5::lock();
    return read_particles(impl_->file, index);
  });
}

}  // namespace hooke::io
