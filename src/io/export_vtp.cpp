// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/polydata_file.h"

namespace hooke::io {

namespace {

template <class Real>
void write_vtp(const Snapshot& snapshot, const RunInfo& info, const std::filesystem::path& file) {
  const ParticleSet& p = snapshot.particles;
  std::vector<Real> radius;
  radius.reserve(p.size());
  for (const std::uint16_t material : p.material) radius.push_back(static_cast<Real>(info.materials[material].radius));
  PolyDataFile out(PolyDataFile::Cells::vertices, p.size(), snapshot.time);
  out.add_point_data("id", std::vector<std::int64_t>(p.id.begin(), p.id.end()));
  out.add_point_data("velocity", flatten<Real>(p.velocity), 3);
  out.add_point_data("radius", radius);
  out.add_point_data("material", p.material);
  out.set_points(flatten<Real>(p.position));
  out.write(file);
}

}  // namespace

std::vector<std::filesystem::path> export_vtp(const ExportJob& job) {
  const RunInfo& info = job.run.info();
  const auto write = info.precision == Precision::single_precision ? write_vtp<float> : write_vtp<double>;
  return export_polydata(
      job, [&](std::size_t index, const std::filesystem::path& file) { write(take(job.run.read(index)), info, file); });
}

}  // namespace hooke::io
