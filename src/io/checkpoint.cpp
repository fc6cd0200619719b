// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/checkpoint.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <numeric>

#include "hooke/base/floating_point.h"
#include "hooke/base/hash.h"
#include "hooke/io/failure.h"
#include "hooke/io/hdf5.h"
#include "hooke/io/population_tables.h"
#include "hooke/io/run_folder.h"
#include "hooke/io/run_info_json.h"
#include "hooke/io/structure_tables.h"

namespace hooke::io {

namespace {

constexpr std::int64_t kFormat = 4;
constexpr const char* kType = "hooke checkpoint";
constexpr const char* kTablesDiffer = "is a damaged checkpoint: its tables don't fit together";

static_assert(sizeof(Vec3d) == 3 * sizeof(double));

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

/// The last bytes of a checkpoint; HDF5 reads nothing behind its own end. The seal shows, before HDF5 reads the file,
/// whether it was cut short or changed; HDF5 would not notice a changed bit in an array.
struct Seal {
  std::uint64_t magic = 0x314b4843454b4f48;  // "HOKECHK1", little endian
  std::uint64_t checksum = 0;                // of all bytes before the seal

  friend bool operator==(const Seal&, const Seal&) = default;
};

/// Makes the seal for the first `size` bytes of a file. Throws Failure.
Seal make_seal(int fd, std::uint64_t size, const std::filesystem::path& path) {
  constexpr std::size_t kBlockBytes = std::size_t{1} << 20U;
  std::vector<std::uint64_t> words(kBlockBytes / sizeof(std::uint64_t) + 1);
  Seal seal;
  seal.checksum = size;
  for (std::uint64_t at = 0; at < size; at += kBlockBytes) {
    const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(size - at, kBlockBytes));
    words[n / sizeof words[0]] = 0;  // zero padding of the last word
    if (const int error = read_at(fd, words.data(), n, at)) {
      throw Failure(Error::Kind::io, path, "can't be read: " + system_message(error));
    }
    const std::size_t count = (n + sizeof words[0] - 1) / sizeof words[0];
    for (std::size_t i = 0; i < count; ++i) seal.checksum = combine64(seal.checksum, words[i]);
  }
  return seal;
}

void append_seal(const std::filesystem::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDWR | O_CLOEXEC));
  const std::uint64_t size = size_of(file.get(), path);
  const Seal seal = make_seal(file.get(), size, path);
  if (const int error = write_at(file.get(), &seal, sizeof seal, size)) {
    throw Failure(Error::Kind::io, path, "can't be written: " + system_message(error));
  }
}

/// The seal at the end of a file; its magic is wrong where there is no seal.
Seal read_seal(int fd, std::uint64_t size, const std::filesystem::path& path) {
  Seal seal{0, 0};
  if (size <= sizeof seal) return seal;
  if (const int error = read_at(fd, &seal, sizeof seal, size - sizeof seal)) {
    throw Failure(Error::Kind::io, path, "can't be read: " + system_message(error));
  }
  return seal;
}

void check_seal(const std::filesystem::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file) throw Failure(Error::Kind::bad_input, path, "can't be opened: " + system_message(errno));
  const std::uint64_t size = size_of(file.get(), path);
  if (size == 0) throw Failure(Error::Kind::bad_input, path, "is empty");
  const Seal seal = read_seal(file.get(), size, path);
  if (seal.magic != Seal{}.magic) {
    throw Failure(Error::Kind::bad_input, path, "is no checkpoint of Hooke's, or is cut short");
  }
  if (seal != make_seal(file.get(), size - sizeof seal, path)) {
    throw Failure(Error::Kind::bad_input, path, "is a damaged checkpoint: its checksum is wrong");
  }
}

void write_vectors(hid_t file, const char* name, const std::vector<Vec3d>& values) {
  hdf5::write_array(file, name, values.empty() ? nullptr : &values.front().x, values.size(), 3);
}

std::vector<Vec3d> read_vectors(hid_t file, const char* name) {
  const std::vector<double> values = hdf5::read_array<double>(file, name, 3);
  std::vector<Vec3d> vectors(values.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return vectors;
}

void write_content(hdf5::File& file, const SimulationState& state, const RunInfo& info) {
  const Numbers numbers = numbers_of(state);
  const ParticleSet& p = state.particles;
  const hid_t root = file.id();
  hdf5::write_text_attribute(root, "type", kType);
  hdf5::write_integer_attribute(root, "format", {kFormat}, true);
  hdf5::write_text(root, "run", to_json(info));
  hdf5::write_array(root, "integers", numbers.integers.data(), numbers.integers.size());
  hdf5::write_array(root, "reals", numbers.reals.data(), numbers.reals.size());
  hdf5::write_array(root, "sums", numbers.parts.data(), numbers.parts.size());
  hdf5::write_array(root, "sum_parts", numbers.part_count.data(), numbers.part_count.size());
  hdf5::write_array(root, "id", p.id.data(), p.size());
  hdf5::write_array(root, "material", p.material.data(), p.size());
  write_vectors(root, "position", p.position);
  write_vectors(root, "velocity", p.velocity);
  write_vectors(root, "acceleration", p.acceleration);
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
  const hid_t root = file.id();
  if (const std::int64_t format = hdf5::read_integer_attribute(root, "format"); format != kFormat) {
    throw Failure(Error::Kind::bad_input, path,
                  fmt::format("is a checkpoint of format {}; this program reads format {}", format, kFormat));
  }
  Checkpoint checkpoint;
  read_numbers(root, path, checkpoint.state);
  read_particles(root, path, checkpoint.state.particles);
  read_structure(root, path, checkpoint.state);
  read_population(root, path, checkpoint.state);
  checkpoint.info = parse_run_info(hdf5::read_text(root, "run"), path);
  file.check_reads();
  return checkpoint;
}

}  // namespace

Expected<void> write_checkpoint(const std::filesystem::path& path, const SimulationState& state, const RunInfo& info) {
  const FloatingPointGuard floating_point;  // exact sums need rounding to nearest
  return guarded(path, [&] {
    const std::filesystem::path target = output_file_of(path);
    const std::filesystem::path unfinished = unfinished_name(target);
    try {
      const auto held = hdf5::lock();
      hdf5::File file(unfinished, JournaledFile::Mode::create);
      write_content(file, state, info);
      file.close();
      append_seal(unfinished);
    } catch (const Failure& failure) {
      std::error_code ignored;
      std::filesystem::remove(unfinished, ignored);
      // The caller knows only the file's final name.
      throw Failure(Error::Kind::io, path, failure.error().findings.front().message);
    }
    publish(target);
  });
}

Expected<bool> is_checkpoint(const std::filesystem::path& path) {
  return guarded(path, [&] {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file) throw Failure(Error::Kind::io, path, "can't be read: " + system_message(errno));
    return read_seal(file.get(), size_of(file.get(), path), path).magic == Seal{}.magic;
  });
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
