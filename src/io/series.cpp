// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/series.h"

#include "hooke/io/output_file.h"

namespace hooke::io {

namespace {

/// Calls `column` with the name and the value of each column, in order.
template <class Visit>
void for_each_column(const SeriesRow& row, Visit&& column) {
  const Measurements& m = row.measurements;
  const Ledger& l = row.ledger;
  const auto vector = [&](const char* x, const char* y, const char* z, const Vec3d& v) {
    column(x, v.x);
    column(y, v.y);
    column(z, v.z);
  };
  column("step", row.step);
  column("t", row.time);
  column("particles", m.particles);
  column("contacts", m.contacts);
  column("wall_contacts", m.wall_contacts);
  column("kinetic", m.kinetic_energy);
  column("potential", m.potential_energy);
  column("elastic", m.elastic_energy);
  column("wall_elastic", m.wall_elastic_energy);
  column("dissipated", l.dissipated());
  column("wall_work", l.work[Cause::wall]);
  column("collider_elastic", m.collider_elastic_energy);
  column("collider_work", l.work[Cause::collider]);
  column("contact_work", l.work[Cause::contact_spring]);
  column("shear_work", l.work[Cause::contact_shear]);
  column("damping_work", l.work[Cause::contact_damping]);
  column("friction_work", l.work[Cause::contact_friction]);
  column("drag_work", l.work[Cause::drag]);
  column("gravity_work", l.work[Cause::gravity]);
  vector("momentum_x", "momentum_y", "momentum_z", m.momentum);
  vector("centre_x", "centre_y", "centre_z", m.centre_of_mass);
  column("max_speed", m.max_speed);
  column("max_overlap_ratio", m.max_overlap_ratio);
  column("mean_overlap_ratio", m.mean_overlap_ratio);
  column("front_x", m.max.x);
  vector("min_x", "min_y", "min_z", m.min);
  vector("max_x", "max_y", "max_z", m.max);
  vector("wall_force_x", "wall_force_y", "wall_force_z", m.wall_force);
  column("springs", m.springs);
  column("broken_springs", l.springs.broken);
  column("spring", m.spring_energy);
  column("spring_work", l.work[Cause::springs]);
  column("spring_dissipated", l.springs.dissipated);
  column("spring_broken", l.springs.broken_energy);
  column("field_work", l.work[Cause::field]);
  column("attraction", m.attraction_energy);
  column("attraction_work", l.work[Cause::attraction]);
  column("integration", row.integration);
  column("removed_energy", l.removed_energy);
  column("removed_elastic", l.removed_elastic);
  column("born", l.population.born);
  column("born_energy", l.population.born_energy);
  column("expired", l.population.expired);
  column("sunk", l.population.sunk);
  column("removed", l.removed);
}

}  // namespace

SeriesRow make_series_row(const Simulation& simulation, const Measurements& measurements) {
  const Ledger ledger = simulation.ledger();
  return {simulation.step_count(), simulation.time(), measurements, ledger,
          integration_error(measurements, ledger, simulation.initial_elastic())};
}

std::string series_header(const std::vector<std::string>& colliders) {
  std::string line;
  for_each_column({}, [&](const char* name, auto) {
    if (!line.empty()) line += ',';
    line += name;
  });
  for (const std::string& name : colliders) {
    for (const char* what : {"force_x", "force_y", "force_z", "torque_x", "torque_y", "torque_z"}) {
      line += ',' + name + '_' + what;
    }
  }
  return line;
}

std::string to_csv(const SeriesRow& row) {
  std::string line;
  for_each_column(row, [&](const char*, auto value) {
    if (!line.empty()) line += ',';
    append_number(line, value);
  });
  for (const ColliderLoad& load : row.measurements.colliders) {
    for (const Vec3d& v : {load.force, load.torque}) {
      for (int axis = 0; axis < 3; ++axis) append_number(line += ',', component(v, axis));
    }
  }
  return line;
}

}  // namespace hooke::io
