// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/material_words.h"
#include "hooke/io/write_rows.h"

namespace hooke::io {

std::vector<std::filesystem::path> export_csv(const ExportJob& job) {
  const RunReader& run = job.run;
  const std::vector<std::string> names = material_fields(run.info().materials, job.file);
  const bool single = run.info().precision == Precision::single_precision;
  OutputFile out(job.file);
  out.write("step,t,id,material,x,y,z,vx,vy,vz\n");
  for (const std::size_t index : job.indices) {
    const Snapshot snapshot = take(run.read(index));
    const ParticleSet& p = snapshot.particles;
    std::string start;
    append_number(start, snapshot.step);
    start += ',';
    append_number(start, snapshot.time);
    start += ',';
    write_rows(out, p.size(), [&](std::string& text, std::size_t i) {
      text += start;
      append_number(text, p.id[i]);
      text += ',';
      text += names[p.material[i]];
      for (const Vec3d& v : {p.position[i], p.velocity[i]}) {
        text += ',';
        single ? append_vector<float>(text, v, ",") : append_vector<double>(text, v, ",");
      }
      text += '\n';
    });
  }
  out.finish();
  return {job.file};
}

}  // namespace hooke::io
