// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/checkpoint.h"

#include <fmt/format.h>

#include <numeric>

#include "hooke/base/floating_point.h"
#include "hooke/io/checkpoint_parts.h"
#include "hooke/io/failure.h"
#include "hooke/io/hdf5.h"
#include "hooke/io/population_tables.h"
#include "hooke/io/run_folder.h"
#include "hooke/io/run_info_json.h"
#include "hooke/io/seal.h"
#include "hooke/io/slices.h"
#include "hooke/io/structure_tables.h"

namespace hooke::io {

namespace {

constexpr std::int64_t kFormat = 5;
constexpr const char* kType = "hooke checkpoint";

/// The numbers of a state besides its particles and step, in the order of the file; `visit` may read or set them.
template <class State, class Visit>
void for_each_integer(State& s, Visit&& visit) {
  visit(s.next_id);
  LedgerSums::for_each_count(visit, s.ledger);
}

template <class State, class Visit>
void for_each_real(State& s, Visit&& visit) {
  const auto vector = [&](auto& v) {
    visit(v.x);
    visit(v.y);
    visit(v.z);
  };
  visit(s.ledger.kick);
  vector(s.initial_momentum);
  visit(s.initial_energy);
  visit(s.initial_elastic);
}

struct Numbers {
  std::vector<std::uint64_t> integers;
  std::vector<double> reals;
  std::vector<double> parts;             // of the ledger's exact sums, one sum after the other
  std::vector<std::uint16_t> part_count;  // of each sum
};

Numbers numbers_of(const SimulationState& state) {
  Numbers numbers;
  numbers.integers.push_back(static_cast<std::uint64_t>(state.step));
  for_each_integer(state, [&](std::uint64_t value) { numbers.integers.push_back(value); });
  for_each_real(state, [&](double value) { numbers.reals.push_back(value); });
  LedgerSums::for_each_sum(
      [&](const ExactSum& sum) {
        const std::vector<double> parts = sum.parts();
        numbers.part_count.push_back(static_cast<std::uint16_t>(parts.size()));
        numbers.parts.insert(numbers.parts.end(), parts.begin(), parts.end());
      },
      state.ledger);
  return numbers;
}

std::vector<Vec3d> read_vectors(hid_t file, const char* name) {
  const std::vector<double> values = hdf5::read_array<double>(file, name, 3);
  std::vector<Vec3d> vectors(values.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return vectors;
}

void write_particles(hid_t root, const ParticleSlices& particles) {
  const std::uint64_t n = particles.size(), accelerated = particles.has_accelerations() ? n : 0;
  hdf5::Array id = hdf5::Array::create<std::uint64_t>(root, "id", n);
  hdf5::Array material = hdf5::Array::create<std::uint16_t>(root, "material", n);
  hdf5::Array position = hdf5::Array::create<double>(root, "position", n, 3);
  hdf5::Array velocity = hdf5::Array::create<double>(root, "velocity", n, 3);
  hdf5::Array acceleration = hdf5::Array::create<double>(root, "acceleration", accelerated, 3);
  visit_slices(particles, kSliceRows, [&](const ParticleSlice& p) {
    id.append(p.id.data(), p.size());
    material.append(p.material.data(), p.size());
    position.append(components(p.position), p.size());
    velocity.append(components(p.velocity), p.size());
    acceleration.append(components(p.acceleration), p.acceleration.size());
  });
}

void write_content(hdf5::File& file, const SimulationState& state, const ParticleSlices& particles,
                   const RunInfo& info) {
  const Numbers numbers = numbers_of(state);
  const hid_t root = file.id();
  hdf5::write_text_attribute(root, "type", kType);
  hdf5::write_integer_attribute(root, "format", {kFormat}, true);
  hdf5::write_text(root, "run", to_json(info));
  hdf5::write_array(root, "integers", numbers.integers.data(), numbers.integers.size());
  hdf5::write_array(root, "reals", numbers.reals.data(), numbers.reals.size());
  hdf5::write_array(root, "sums", numbers.parts.data(), numbers.parts.size());
  hdf5::write_array(root, "sum_parts", numbers.part_count.data(), numbers.part_count.size());
  write_particles(root, particles);
  write_structure(root, state);
  write_population(root, state);
}

/// Reads step, ids, ledger and initial sums of a state.
void read_numbers(hid_t root, const std::filesystem::path& path, SimulationState& state) {
  const Numbers numbers{hdf5::read_array<std::uint64_t>(root, "integers"), hdf5::read_array<double>(root, "reals"),
                        hdf5::read_array<double>(root, "sums"), hdf5::read_array<std::uint16_t>(root, "sum_parts")};
  const Numbers expected = numbers_of(state);
  if (numbers.integers.size() != expected.integers.size() || numbers.reals.size() != expected.reals.size() ||
      numbers.part_count.size() != expected.part_count.size() ||
      std::accumulate(numbers.part_count.begin(), numbers.part_count.end(), std::size_t{0}) != numbers.parts.size()) {
    throw Failure(Error::Kind::bad_input, path, kTablesDiffer);
  }
  state.step = static_cast<std::int64_t>(numbers.integers[0]);
  auto integer = numbers.integers.begin() + 1;
  for_each_integer(state, [&](std::uint64_t& value) { value = *integer++; });
  auto real = numbers.reals.begin();
  for_each_real(state, [&](double& value) { value = *real++; });
  auto part = numbers.parts.begin();
  auto count = numbers.part_count.begin();
  LedgerSums::for_each_sum(
      [&](ExactSum& sum) {
        for (std::uint16_t k = *count++; k > 0; --k) sum.add(*part++);
      },
      state.ledger);
}

void read_particles(hid_t root, const std::filesystem::path& path, ParticleSet& p) {
  p.id = hdf5::read_array<std::uint64_t>(root, "id");
  p.material = hdf5::read_array<std::uint16_t>(root, "material");
  p.position = read_vectors(root, "position");
  p.velocity = read_vectors(root, "velocity");
  p.acceleration = read_vectors(root, "acceleration");
  const std::size_t n = p.size();
  if (p.material.size() != n || p.position.size() != n || p.velocity.size() != n ||
      (p.acceleration.size() != n && !p.acceleration.empty())) {
    throw Failure(Error::Kind::bad_input, path, kTablesDiffer);
  }
}

Checkpoint read_content(const std::filesystem::path& path) {
  check_seal(path);
  const auto held = hdf5::lock();
  const hdf5::File file(path, JournaledFile::Mode::read);
  Checkpoint checkpoint = read_all_but_particles(file, path);
  read_particles(file.id(), path, checkpoint.state.particles);
  file.check_reads();
  return checkpoint;
}

}  // namespace

Checkpoint read_all_but_particles(const hdf5::File& file, const std::filesystem::path& path) {
  const hid_t root = file.id();
  if (const std::int64_t format = hdf5::read_integer_attribute(root, "format"); format != kFormat) {
    throw Failure(Error::Kind::bad_input, path,
                  fmt::format("is a checkpoint of format {}; this program reads format {}", format, kFormat));
  }
  Checkpoint checkpoint;
  read_numbers(root, path, checkpoint.state);
  read_structure(root, path, checkpoint.state);
  read_population(root, path, checkpoint.state);
  checkpoint.info = parse_run_info(hdf5::read_text(root, "run"), path);
  return checkpoint;
}

Expected<void> write_checkpoint(const std::filesystem::path& path, const SimulationState& state, const RunInfo& info) {
  return write_checkpoint(path, state, SlicesOfSet(state.particles), info);
}

Expected<void> write_checkpoint(const std::filesystem::path& path, const SimulationState& state,
                                const ParticleSlices& particles, const RunInfo& info) {
  const FloatingPointGuard floating_point;  // exact sums need rounding to nearest
  return guarded(path, [&] {
    const std::filesystem::path target = output_file_of(path);
    const std::filesystem::path unfinished = unfinished_name(target);
    try {
      const auto held = hdf5::lock();
      hdf5::File file(unfinished, JournaledFile::Mode::create);
      write_content(file, state, particles, info);
      file.close();
      append_seal(unfinished);
    } catch (const std::exception& any) {
      std::error_code ignored;
      std::filesystem::remove(unfinished, ignored);
      // The caller knows only the file's final name.
      const auto* failure = dynamic_cast<const Failure*>(&any);
      if (failure == nullptr || failure->error().findings.front().where != unfinished.string()) throw;
      throw Failure(Error::Kind::io, path, failure->error().findings.front().message);
    }
    publish(target);
  });
}

Expected<bool> is_checkpoint(const std::filesystem::path& path) {
  return guarded(path, [&] { return has_seal(path); });
}

Expected<Checkpoint> read_checkpoint(const std::filesystem::path& path) {
  const FloatingPointGuard floating_point;
  return guarded(path, [&] {
    std::error_code ignored;
    return read_content(std::filesystem::is_directory(path, ignored) ? path / kCheckpointFile : path);
  });
}

Expected<std::shared_ptr<const Structure>> read_structure_of_run(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kCheckpointFile;
  return guarded(path, [&]() -> std::shared_ptr<const Structure> {
    if (!is_there(path)) return nullptr;
    check_seal(path);
    const auto held = hdf5::lock();
    const hdf5::File file(path, JournaledFile::Mode::read);
    SimulationState state;
    read_numbers(file.id(), path, state);
    read_structure(file.id(), path, state);
    file.check_reads();
    return state.structure;
  });
}

}  // namespace hooke::io
