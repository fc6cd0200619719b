// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/describe_file.h"

#include <sys/stat.h>

#include <cerrno>

#include "hooke/io/failure.h"
#include "hooke/io/output_file.h"
#include "hooke/io/run_folder.h"

namespace hooke::io {

namespace {

namespace fs = std::filesystem;

FileDescription describe_checkpoint(const fs::path& file) {
  const Checkpoint checkpoint = take(read_checkpoint(file));
  FileDescription description;
  description.kind = FileDescription::Kind::checkpoint;
  description.info = checkpoint.info;
  description.bytes = fs::file_size(file);
  description.steps = {checkpoint.state.step};
  description.times = {static_cast<double>(checkpoint.state.step) * checkpoint.info.time_step};
  description.particle_counts = {checkpoint.state.particles.size()};
  return description;
}

FileDescription describe_run_file(const fs::path& file) {
  const RunReader run = take(RunReader::open(file));
  FileDescription description;
  description.kind = FileDescription::Kind::particles_file;
  description.info = run.info();
  description.bytes = fs::file_size(run.file());
  description.steps.assign(run.steps().begin(), run.steps().end());
  description.times.assign(run.times().begin(), run.times().end());
  description.particle_counts.assign(run.particle_counts().begin(), run.particle_counts().end());
  return description;
}

/// The size of a file; 0 if it is no regular file, or if it vanished since the folder was listed: a writer may replace
/// its checkpoint meanwhile. Throws std::filesystem::filesystem_error.
std::uint64_t listed_size(const fs::path& file) {
  struct stat status{};
  if (::stat(file.c_str(), &status) != 0) {
    if (errno == ENOENT) return 0;
    throw fs::filesystem_error("cannot get file size", file, std::error_code(errno, std::generic_category()));
  }
  return S_ISREG(status.st_mode) ? static_cast<std::uint64_t>(status.st_size) : 0;
}

FileDescription describe_run_folder(const fs::path& folder) {
  FileDescription description = describe_run_file(folder);
  description.kind = FileDescription::Kind::run_folder;
  description.bytes = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    description.bytes += listed_size(entry.path());
  if (is_there(folder / kCheckpointFile)) {
    description.checkpoint_step = take(read_checkpoint(folder)).state.step;
  }
  return description;
}

}  // namespace

Expected<FileDescription> describe_file(const fs::path& file) {
  return guarded(file, [&] {
    if (!is_there(file)) throw Failure(Error::Kind::bad_input, file, "does not exist");
    if (fs::is_directory(file)) return describe_run_folder(file);
    return take(is_checkpoint(file)) ? describe_checkpoint(file) : describe_run_file(file);
  });
}

const char* to_string(FileDescription::Kind kind) {
  switch (kind) {
    case FileDescription::Kind::run_folder:
      return "run folder";
    case FileDescription::Kind::particles_file:
      return "snapshots";
    case FileDescription::Kind::checkpoint:
      break;
  }
  return "checkpoint";
}

}  // namespace hooke::io
