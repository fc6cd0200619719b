// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The springs of a run and which of them are broken, from its checkpoint. CSV: one row per spring.
#include <algorithm>

#include "hooke/io/checkpoint.h"
#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/write_rows.h"

namespace hooke::io {

std::vector<std::filesystem::path> export_springs_csv(const ExportJob& job) {
  const std::filesystem::path folder = job.run.file().parent_path();
  const SimulationState state = take(read_checkpoint(folder)).state;
  if (!state.structure || state.structure->springs.empty()) {
    throw Failure(Error::Kind::bad_input, folder, "is of a run without springs");
  }
  const SpringSet& springs = state.structure->springs;
  OutputFile out(job.file);
  out.write("step,spring,a,b,rest_length,stiffness,damping,broken\n");
  write_rows(out, springs.size(), [&](std::string& text, std::size_t s) {
    append_number(text, state.step);
    for (const std::uint64_t whole : {std::uint64_t{s}, springs.a[s], springs.b[s]}) {
      append_number(text += ',', whole);
    }
    for (const double value : {springs.rest_length[s], springs.stiffness[s], springs.damping[s]}) {
      append_number(text += ',', value);
    }
    text += std::binary_search(state.broken_springs.begin(), state.broken_springs.end(), s) ? ",1\n" : ",0\n";
  });
  out.finish();
  return {job.file};
}

}  // namespace hooke::io
