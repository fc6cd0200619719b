// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// OpenVDB, one file per snapshot: particles as points, or their fluid as a volume.
#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/output_file.h"
#include "hooke/volumes/vdb_file.h"

namespace hooke::io {

namespace {

namespace fs = std::filesystem;

std::string names_of(const std::vector<MaterialInfo>& materials) {
  std::string names;
  for (const MaterialInfo& m : materials) names += (names.empty() ? "" : ",") + m.name;
  return names;
}

template <class MakeBytes>
std::vector<fs::path> export_grids(const ExportJob& job, const MakeBytes& make_bytes) {
  return export_each(job, [&](std::size_t index, const fs::path& file) {
    const Snapshot snapshot = take(job.run.read(index));
    OutputFile out(file);
    out.write(take(make_bytes(snapshot.particles, volumes::VdbInstant{snapshot.step, snapshot.time}), file));
    out.finish();
  });
}

}  // namespace

std::vector<fs::path> export_vdb_points(const ExportJob& job) {
  const auto& materials = job.run.info().materials;
  return export_grids(job, [&](const ParticleSet& particles, const volumes::VdbInstant& instant) {
    return volumes::vdb_points(particles, radii(materials), names_of(materials), instant);
  });
}

std::vector<fs::path> export_vdb_volume(const ExportJob& job) {
  const std::vector<double> radius = radii(job.run.info().materials);
  return export_grids(job, [&](const ParticleSet& particles, const volumes::VdbInstant& instant) {
    return volumes::vdb_volume(particles, radius, job.options.surface, instant);
  });
}

}  // namespace hooke::io
