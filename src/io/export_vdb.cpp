// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// OpenVDB, one file per snapshot: particles as points, or their fluid as a volume.
#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/output_file.h"
#include "hooke/volumes/vdb_file.h"

namespace hooke {

namespace {

namespace fs = std::filesystem;

std::string names_of(const std::vector<MaterialInfo>& materials) {
  std::string names;
  for (const MaterialInfo& m : materials) names += (names.empty() ? "" : ",") + m.name;
  return names;
}

template <class Write>
std::vector<fs::path> export_grids(const ExportJob& job, const Write& write) {
  return export_each(job, [&](std::size_t index, const fs::path& file) {
    const Snapshot snapshot = take(job.run.read(index));
    take(write(snapshot.particles, VdbInstant{snapshot.step, snapshot.time}, unfinished_name(file)), file);
    publish(file);
  });
}

}  // namespace

std::vector<fs::path> export_vdb_points(const ExportJob& job) {
  const auto& materials = job.run.info().materials;
  return export_grids(job, [&](const ParticleSet& particles, const VdbInstant& instant, const fs::path& file) {
    return write_vdb_points(particles, radii(materials), names_of(materials), instant, file);
  });
}

std::vector<fs::path> export_vdb_volume(const ExportJob& job) {
  const std::vector<double> radius = radii(job.run.info().materials);
  return export_grids(job, [&](const ParticleSet& particles, const VdbInstant& instant, const fs::path& file) {
    return write_vdb_volume(particles, radius, job.options.surface, instant, file);
  });
}

}  // namespace hooke
