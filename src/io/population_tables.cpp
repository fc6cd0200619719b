// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/population_tables.h"

#include "hooke/io/failure.h"

namespace hooke::io {

namespace {

constexpr std::size_t kEmitterNumbers = 4;  // whole numbers per emitter, one row each

template <class T>
void write_column(hid_t file, const char* name, const std::vector<T>& column, std::size_t width = 1) {
  hdf5::write_array(file, name, column.data(), column.size() / width, width);
}

}  // namespace

void write_population(hid_t file, const SimulationState& state) {
  if (state.emission.emitters.empty()) return;
  std::vector<double> due;
  std::vector<std::uint64_t> numbers;
  for (const EmitterState& e : state.emission.emitters) {
    due.push_back(e.due);
    numbers.insert(numbers.end(), {e.births, e.reborn, e.to_respawn, e.attempts});
  }
  write_column(file, "emitter_due", due);
  write_column(file, "emitter_numbers", numbers, kEmitterNumbers);
  std::vector<std::uint64_t> death, id;
  std::vector<std::uint32_t> emitter;
  for (const Mortal& m : state.emission.mortals) {
    death.push_back(static_cast<std::uint64_t>(m.death));
    id.push_back(m.id);
    emitter.push_back(m.emitter);
  }
  write_column(file, "mortal_death", death);
  write_column(file, "mortal_id", id);
  write_column(file, "mortal_emitter", emitter);
}

void read_population(hid_t file, const std::filesystem::path& path, SimulationState& state) {
  if (!hdf5::exists(file, "emitter_due")) return;
  const auto due = hdf5::read_array<double>(file, "emitter_due");
  const auto numbers = hdf5::read_array<std::uint64_t>(file, "emitter_numbers", kEmitterNumbers);
  const auto death = hdf5::read_array<std::uint64_t>(file, "mortal_death");
  const auto id = hdf5::read_array<std::uint64_t>(file, "mortal_id");
  const auto emitter = hdf5::read_array<std::uint32_t>(file, "mortal_emitter");
  if (numbers.size() != kEmitterNumbers * due.size() || id.size() != death.size() || emitter.size() != death.size()) {
    throw Failure(Error::Kind::bad_input, path, "is a damaged checkpoint: its tables of births don't fit together");
  }
  for (std::size_t i = 0; i < due.size(); ++i) {
    const std::uint64_t* n = numbers.data() + kEmitterNumbers * i;
    state.emission.emitters.push_back({due[i], n[0], n[1], n[2], n[3]});
  }
  for (std::size_t i = 0; i < death.size(); ++i) {
    state.emission.mortals.push_back({static_cast<std::int64_t>(death[i]), id[i], emitter[i]});
  }
}

}  // namespace hooke::io
