// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/output_file.h"

namespace hooke {

namespace {

/// A name as a CSV field: quoted where it must be.
std::string csv_field(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

template <class Real>
void append_vector(std::string& line, const Vec3d& v) {
  for (const double c : {v.x, v.y, v.z}) {
    line += ',';
    append_number(line, static_cast<Real>(c));
  }
}

}  // namespace

std::vector<std::filesystem::path> export_csv(const ExportJob& job) {
  const RunReader& run = job.run;
  std::vector<std::string> names;
  for (const MaterialInfo& m : run.info().materials) names.push_back(csv_field(m.name));
  const bool single = run.info().precision == Precision::single_precision;
  OutputFile out(job.file);
  out.write("step,t,id,material,x,y,z,vx,vy,vz\n");
  std::string line;
  for (const std::size_t index : job.indices) {
    const Snapshot snapshot = take(run.read(index));
    const ParticleSet& p = snapshot.particles;
    std::string start;
    append_number(start, snapshot.step);
    start += ',';
    append_number(start, snapshot.time);
    start += ',';
    for (std::size_t i = 0; i < p.size(); ++i) {
      line = start;
      append_number(line, p.id[i]);
      line += ',';
      line += names[p.material[i]];
      for (const Vec3d& v : {p.position[i], p.velocity[i]}) {
        single ? append_vector<float>(line, v) : append_vector<double>(line, v);
      }
      line += '\n';
      out.write(line);
    }
  }
  out.finish();
  return {job.file};
}

}  // namespace hooke
