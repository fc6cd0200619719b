// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/structure_tables.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "hooke/base/ascending.h"
#include "hooke/io/failure.h"

namespace hooke::io {

namespace {

/// The springs' columns with the names of their tables.
template <class Springs, class Visit>
void for_each_column(Springs& springs, Visit&& visit) {
  visit("spring_a", springs.a);
  visit("spring_b", springs.b);
  visit("spring_rest_length", springs.rest_length);
  visit("spring_stiffness", springs.stiffness);
  visit("spring_damping", springs.damping);
  visit("spring_break_strain", springs.break_strain);
  visit("spring_contact", springs.contact);
}

template <class T>
void write_column(hid_t file, const char* name, const std::vector<T>& column) {
  hdf5::write_array(file, name, column.data(), column.size());
}

/// Throws Failure where columns differ in length or an index is out of range: nothing that reads a structure looks
/// again.
void check(const SimulationState& state, const std::filesystem::path& path) {
  const auto refuse = [&](const Finding& finding) {
    throw Failure(Error::Kind::bad_input, path, "is a damaged checkpoint: " + finding.where + ": " + finding.message);
  };
  const Structure& s = *state.structure;
  if (const auto findings = validate(s, /*single=*/false); !findings.empty()) refuse(findings.front());
  const auto& broken = state.broken_springs;
  if (!is_ascending(broken) || (!broken.empty() && broken.back() >= s.springs.size())) {
    refuse({"broken_springs", "must be unique, ascending and below the number of springs"});
  }
  const auto is_unknown = [&](std::uint64_t id) { return id >= state.next_id; };
  const auto check_ids = [&](const std::vector<std::uint64_t>& ids, const char* where) {
    if (std::any_of(ids.begin(), ids.end(), is_unknown)) refuse({where, "names a particle that never was"});
  };
  check_ids(s.springs.a, "springs");
  check_ids(s.springs.b, "springs");
  check_ids(s.pinned, "held");
  for (const Surface& surface : s.surfaces) check_ids(surface.particles, "surfaces");
}

}  // namespace

void write_structure(hid_t file, const SimulationState& state) {
  if (!state.structure) return;
  const Structure& s = *state.structure;
  for_each_column(s.springs, [&](const char* name, const auto& column) { write_column(file, name, column); });
  std::vector<std::uint8_t> mode(s.springs.size());
  for (std::size_t i = 0; i < mode.size(); ++i) mode[i] = static_cast<std::uint8_t>(s.springs.mode[i]);
  write_column(file, "spring_mode", mode);
  write_column(file, "broken_springs", state.broken_springs);
  write_column(file, "held", s.pinned);
  nlohmann::json surfaces = nlohmann::json::array();
  std::vector<std::uint64_t> particles;
  std::vector<std::uint32_t> triangles;
  for (const Surface& surface : s.surfaces) {
    surfaces.push_back(
        {{"name", surface.name}, {"particles", surface.particles.size()}, {"triangles", surface.triangles.size()}});
    particles.insert(particles.end(), surface.particles.begin(), surface.particles.end());
    triangles.insert(triangles.end(), surface.triangles.begin(), surface.triangles.end());
  }
  hdf5::write_text(file, "surfaces", surfaces.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  write_column(file, "surface_particles", particles);
  write_column(file, "surface_triangles", triangles);
}

void read_structure(hid_t file, const std::filesystem::path& path, SimulationState& state) {
  if (!hdf5::exists(file, "spring_a")) return;
  const auto refuse = [&] {
    return Failure(Error::Kind::bad_input, path, "is a damaged checkpoint: its tables of springs don't fit together");
  };
  const auto structure = std::make_shared<Structure>();
  Structure& s = *structure;
  for_each_column(s.springs, [&](const char* name, auto& column) {
    using Number = typename std::remove_reference_t<decltype(column)>::value_type;
    column = hdf5::read_array<Number>(file, name);
  });
  for (const std::uint8_t mode : hdf5::read_array<std::uint8_t>(file, "spring_mode")) {
    if (mode > static_cast<std::uint8_t>(SpringMode::extension)) throw refuse();
    s.springs.mode.push_back(static_cast<SpringMode>(mode));
  }
  state.broken_springs = hdf5::read_array<std::uint64_t>(file, "broken_springs");
  s.pinned = hdf5::read_array<std::uint64_t>(file, "held");

  const auto particles = hdf5::read_array<std::uint64_t>(file, "surface_particles");
  const auto triangles = hdf5::read_array<std::uint32_t>(file, "surface_triangles");
  try {
    std::size_t p = 0, t = 0;
    for (const auto& entry : nlohmann::json::parse(hdf5::read_text(file, "surfaces"))) {
      const auto particle_count = entry.at("particles").get<std::size_t>();
      const auto corner_count = entry.at("triangles").get<std::size_t>();
      if (particle_count > particles.size() - p || corner_count > triangles.size() - t) throw refuse();
      Surface& surface = s.surfaces.emplace_back();
      surface.name = entry.at("name").get<std::string>();
      surface.particles.assign(particles.begin() + static_cast<std::ptrdiff_t>(p),
                               particles.begin() + static_cast<std::ptrdiff_t>(p + particle_count));
      surface.triangles.assign(triangles.begin() + static_cast<std::ptrdiff_t>(t),
                               triangles.begin() + static_cast<std::ptrdiff_t>(t + corner_count));
      p += particle_count;
      t += corner_count;
    }
    if (p != particles.size() || t != triangles.size()) throw refuse();
  } catch (const nlohmann::json::exception&) {
    throw refuse();
  }
  state.structure = structure;
  check(state, path);
}

}  // namespace hooke::io
