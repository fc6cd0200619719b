// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/report.h"

#include <fmt/format.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "hooke/base/process_usage.h"
#include "hooke/io/failure.h"
#include "hooke/io/output_file.h"
#include "hooke/io/snapshot.h"

namespace hooke::io {

namespace {

nlohmann::ordered_json to_array(const Vec3d& v) { return {v.x, v.y, v.z}; }

nlohmann::ordered_json stages_of(const RunReport& r) {
  const StageTimes& s = r.stages;
  nlohmann::ordered_json json = {{"sort", s.sort}, {"list", s.list}, {"motion", s.motion}};
  json["force"] = s.force - r.walls.value_or(0);
  json["walls"] = r.walls ? nlohmann::ordered_json(*r.walls) : nlohmann::ordered_json();
  json["drift"] = s.drift;
  json["rest"] = r.rest();
  return json;
}

}  // namespace

double RunReport::contacts_per_particle() const {
  return particles > 0 ? 2 * static_cast<double>(measurements.contacts) / static_cast<double>(particles) : 0;
}

double RunReport::energy_balance() const {
  const double now = measurements.kinetic_energy + measurements.potential_energy + measurements.elastic_energy +
                     measurements.spring_energy + measurements.attraction_energy;
  const double given = ledger.work[Cause::wall] + ledger.work[Cause::collider] + ledger.work[Cause::hold] +
                       ledger.work[Cause::field] + ledger.work[Cause::external] + ledger.population.born_energy;
  const double lost = ledger.dissipated() + ledger.springs.dissipated + ledger.springs.broken_energy +
                      ledger.removed_energy + ledger.removed_elastic;
  return now - initial_energy - (given - lost);
}

double RunReport::bytes_per_particle() const {
  if (particles == 0) return 0;
  return static_cast<double>(peak_bytes - program_bytes) / static_cast<double>(particles);
}

RunReport make_report(const Simulation& simulation, const Measurements& measurements) {
  const BackendInfo backend = simulation.backend_info();
  RunReport report;
  report.scene = simulation.scene().name;
  report.particles = measurements.particles;
  report.step = simulation.step_count();
  report.time = simulation.time();
  report.device = backend.device;
  report.isa = backend.isa;
  report.precision = backend.precision;
  report.threads = backend.threads;
  report.peak_bytes = peak_resident_bytes();
  report.state_hash = simulation.state_hash();
  report.measurements = measurements;
  report.ledger = simulation.ledger();
  for (const Collider& c : simulation.scene().colliders) report.colliders.push_back(c.name);
  report.initial_energy = simulation.initial_energy();
  report.integration = integration_error(measurements, report.ledger, simulation.initial_elastic());
  report.momentum_drift = momentum_drift(measurements, report.ledger, simulation.initial_momentum());
  report.neighbours = simulation.neighbour_statistics();
  report.stages = simulation.stage_times();
  return report;
}

namespace {

nlohmann::ordered_json costs_of(const RankCosts& c, std::int64_t steps) {
  const auto each = [&](const RankFigure& figure, double per) {
    return nlohmann::ordered_json{{"mean", figure.sum / c.ranks / per}, {"most", figure.most / per}};
  };
  const auto per_step = static_cast<double>(std::max<std::int64_t>(steps, 1));
  const auto per_exchange = static_cast<double>(std::max<std::uint64_t>(c.exchanges, 1));
  nlohmann::ordered_json json;
  json["processor_seconds"] = each(c.processor, 1);
  json["waiting_seconds"] = each(c.waiting, 1);
  json["peak_bytes"] = each(c.peak_bytes, 1);
  json["particles"] = each(c.particles, 1);
  json["ghosts"] = each(c.ghosts, per_exchange);
  json["messages_per_step"] = each(c.messages, per_step);
  json["bytes_per_step"] = each(c.bytes, per_step);
  json["exchanges"] = c.exchanges;
  json["cuts"] = c.cuts;
  json["largest_over_mean"] = {{"particles", c.uneven_particles}, {"force_seconds", c.uneven_time}};
  return json;
}

}  // namespace

std::string to_json(const RunReport& r) {
  const Measurements& m = r.measurements;
  nlohmann::ordered_json json;
  json["scene"] = r.scene;
  json["particles"] = r.particles;
  json["steps"] = r.steps;
  json["step"] = r.step;
  json["time"] = r.time;
  json["seconds"] = r.seconds;
  json["stages"] = stages_of(r);
  json["steps_per_second"] = r.steps_per_second();
  json["particle_steps_per_second"] = r.particle_steps_per_second();
  json["contacts"] = m.contacts;
  json["contacts_per_particle"] = r.contacts_per_particle();
  json["wall_contacts"] = m.wall_contacts;
  json["slots_per_particle"] = r.neighbours.slots_per_particle;
  json["neighbour_rebuilds"] = r.neighbours.rebuilds;
  json["ranks"] = r.ranks;
  json["threads"] = r.threads;
  json["device"] = r.device;
  json["isa"] = r.isa;
  json["precision"] = to_string(r.precision);
  json["peak_bytes"] = r.peak_bytes;
  json["program_bytes"] = r.program_bytes;
  json["state_hash"] = fmt::format("{:016x}", r.state_hash);
  json["energy"] = {{"kinetic", m.kinetic_energy},
                    {"potential", m.potential_energy},
                    {"elastic", m.elastic_energy},
                    {"wall_elastic", m.wall_elastic_energy},
                    {"dissipated", r.ledger.dissipated()},
                    {"work_by_walls", r.ledger.work[Cause::wall]},
                    {"collider_elastic", m.collider_elastic_energy},
                    {"work_by_colliders", r.ledger.work[Cause::collider]},
                    {"removed", r.ledger.removed_energy},
                    {"removed_elastic", r.ledger.removed_elastic},
                    {"born", r.ledger.population.born_energy},
                    {"initial", r.initial_energy},
                    {"springs", m.spring_energy},
                    {"dissipated_by_springs", r.ledger.springs.dissipated},
                    {"work_by_springs", r.ledger.work[Cause::springs]},
                    {"broken_springs", r.ledger.springs.broken_energy},
                    {"work_by_hold", r.ledger.work[Cause::hold]},
                    {"work_by_fields", r.ledger.work[Cause::field]},
                    {"attraction", m.attraction_energy},
                    {"work_by_attraction", r.ledger.work[Cause::attraction]},
                    {"integration", r.integration},
                    {"balance", r.energy_balance()}};
  if (const double work = r.ledger.work[Cause::external]; work != 0) json["energy"]["work_by_external_forces"] = work;
  json["momentum"] = to_array(m.momentum);
  json["momentum_drift"] = r.momentum_drift;
  json["centre_of_mass"] = to_array(m.centre_of_mass);
  json["min"] = to_array(m.min);
  json["max"] = to_array(m.max);
  json["max_speed"] = m.max_speed;
  json["max_overlap_ratio"] = m.max_overlap_ratio;
  json["max_pair_overlap_ratio"] = m.max_pair_overlap_ratio;
  json["mean_overlap_ratio"] = m.mean_overlap_ratio;
  json["wall_force"] = to_array(m.wall_force);
  json["colliders"] = nlohmann::ordered_json::object();
  for (std::size_t c = 0; c < r.colliders.size() && c < m.colliders.size(); ++c) {
    const ColliderLoad& load = m.colliders[c];
    json["colliders"][r.colliders[c]] = {
        {"force", to_array(load.force)}, {"torque", to_array(load.torque)}, {"contacts", load.contacts}};
  }
  json["removed"] = r.ledger.removed;
  json["born"] = r.ledger.population.born;
  json["expired"] = r.ledger.population.expired;
  json["sunk"] = r.ledger.population.sunk;
  json["springs"] = m.springs;
  json["broken_springs"] = r.ledger.springs.broken;
  if (r.costs) json["costs"] = costs_of(*r.costs, r.steps);
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

Expected<void> write_text_file(const std::filesystem::path& file, const std::string& text) {
  return guarded(file, [&] {
    OutputFile out(file);
    out.write(text);
    out.finish();
  });
}

std::uint64_t peak_resident_bytes() { return hooke::peak_resident_bytes(); }

}  // namespace hooke::io
