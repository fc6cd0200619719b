// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/backend.h"
#include "hooke/core/simulation.h"

namespace hooke::io {

/// The results of a run: the object in report.json, --report and `bench --json`.
struct RunReport {
  std::string scene;              ///< its name
  std::uint64_t particles = 0;    ///< at the end
  std::int64_t steps = 0;         ///< taken by this program; resumed steps are not counted
  std::int64_t step = 0;          ///< reached, from the start of the simulation
  double time = 0;                ///< reached, s
  double seconds = 0;             ///< wall time of those steps
  std::string device, isa;
  Precision precision = Precision::double_precision;
  int ranks = 1;    ///< that computed it together
  int threads = 1;  ///< of all ranks
  std::uint64_t peak_bytes = 0;   ///< largest resident memory so far
  std::uint64_t program_bytes = 0;  ///< the part in use before the scene was read: program and libraries; 0 if unknown
  std::uint64_t state_hash = 0;
  Measurements measurements;
  Ledger ledger;
  std::vector<std::string> colliders;  ///< names, in the order of Measurements::colliders
  double initial_energy = 0;  ///< kinetic, potential, elastic and springs' at step 0, J
  double integration = 0;  ///< integration_error(), J
  double momentum_drift = 0;  ///< not explained by gravity, walls, colliders, drag and departures, relative
  NeighbourStatistics neighbours;
  StageTimes stages;  ///< of those steps
  std::optional<RankCosts> costs;  ///< of the ranks, in those steps, where that is told
  std::optional<double> walls;  ///< s, the walls' part of stages.force, where it was measured

  double steps_per_second() const { return seconds > 0 ? static_cast<double>(steps) / seconds : 0; }
  double particle_steps_per_second() const { return steps_per_second() * static_cast<double>(particles); }
  double bytes_per_particle() const;  ///< of peak_bytes without program_bytes; 0 without particles
  double rest() const { return seconds - stages.total(); }  ///< the part of `seconds` outside all stages
  double contacts_per_particle() const;  ///< 2 contacts / particles
  double energy_balance() const;  ///< change of energy that the ledger does not explain, J
};

/// Fills all fields but `walls`, `steps` and `seconds`, which the caller has timed. Ranks and threads are one rank's.
/// `stages` are those of all steps of `simulation`.
RunReport make_report(const Simulation& simulation, const Measurements& measurements);

/// One JSON object, indented, with a line feed at the end. Numbers that are not finite become null. "stages" holds
/// seconds that add up to "seconds": if walls were measured, "force" excludes them; otherwise "walls" is null and
/// "force" is the whole pass.
std::string to_json(const RunReport& report);

/// Writes text beside `file` and renames: the old or the new text is there at any moment, complete.
Expected<void> write_text_file(const std::filesystem::path& file, const std::string& text);

/// Largest resident memory of this process so far, bytes.
std::uint64_t peak_resident_bytes();

}  // namespace hooke::io
