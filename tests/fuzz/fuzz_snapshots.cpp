// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// A particles.vtkhdf.
#include "fuzz/input.h"
#include "hooke/io/describe_file.h"
#include "hooke/io/run_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hooke;
  static const fuzz::InputFile file(".vtkhdf");
  const std::filesystem::path& path = file.write(fuzz::text_of(data, size));
  if (const auto described = io::describe_file(path); !described) fuzz::require_readable(described.error());
  const auto run = io::RunReader::open(path);
  if (!run) {
    fuzz::require_readable(run.error());
    return 0;
  }
  for (std::size_t k = 0; k < run->size(); ++k) {
    const auto snapshot = run->read(k);
    if (!snapshot) {
      fuzz::require_readable(snapshot.error());
      continue;
    }
    fuzz::require(snapshot->particles.columns_fit(), "columns have one length");
  }
  return 0;
}
