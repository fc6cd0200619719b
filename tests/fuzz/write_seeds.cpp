// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// write_fuzz_seeds FOLDER: a checkpoint and a file of snapshots, small, as seeds for their fuzzers.
#include <cstdio>

#include "hooke/io/checkpoint.h"
#include "samples.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: write_fuzz_seeds FOLDER\n");
    return 2;
  }
  namespace samples = hooke::samples;
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder / "checkpoint");
  std::filesystem::create_directories(folder / "snapshots");
  const samples::TemporaryFolder work;
  if (!hooke::io::write_checkpoint(work / "checkpoint.h5", samples::state(3, 20), samples::run_info())) return 3;
  const std::string sealed = samples::read_file(work / "checkpoint.h5");
  samples::write_file(folder / "checkpoint/small", sealed.substr(0, sealed.size() - 2 * sizeof(std::uint64_t)));
  samples::write_run(work / "run", samples::run_info(), {samples::snapshot(0, 30), samples::snapshot(8, 20)});
  samples::write_file(folder / "snapshots/small", samples::read_file(work / "run/particles.vtkhdf"));
  return 0;
}
