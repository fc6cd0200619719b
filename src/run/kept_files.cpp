// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/kept_files.h"

#include <algorithm>
#include <system_error>

#include "hooke/io/output_file.h"

namespace hooke::run {

namespace fs = std::filesystem;

Expected<KeptFiles> KeptFiles::copy(const std::vector<scene::SceneFile>& files, const fs::path& folder) {
  KeptFiles kept_files;
  for (const scene::SceneFile& file : files) {
    const fs::path name(file.name), kept = folder / name;
    const bool inside = name.is_relative() && std::find(name.begin(), name.end(), "..") == name.end();
    std::error_code ignored;
    if (!inside || fs::equivalent(file.path, kept, ignored)) continue;
    if (auto copied = kept_files.copy_one(file.path, kept); !copied) return fail(std::move(copied).error());
  }
  return kept_files;
}

Expected<void> KeptFiles::copy_one(const fs::path& from, const fs::path& kept) {
  std::vector<fs::path> made;
  std::error_code fault;
  for (fs::path at = fs::absolute(kept, fault).lexically_normal().parent_path(); !fs::exists(at, fault);) {
    made.push_back(at);
    at = at.parent_path();
  }
  folders_.insert(folders_.begin(), made.begin(), made.end());
  fs::create_directories(kept.parent_path(), fault);
  if (fault) return fail(Error::Kind::io, kept.parent_path().string(), "can't be made: " + fault.message());
  if (fs::is_directory(kept, fault)) return fail(Error::Kind::io, kept.string(), "is a folder, not a mesh");
  const fs::path unfinished = io::unfinished_name(kept);
  copies_.emplace_back(unfinished, kept);
  fs::copy_file(from, unfinished, fs::copy_options::overwrite_existing, fault);
  if (fault) {
    return fail(Error::Kind::io, kept.string(), "can't be copied from " + from.string() + ": " + fault.message());
  }
  return {};
}

Expected<void> KeptFiles::keep() {
  for (const auto& [copy, kept] : copies_) {
    std::error_code fault;
    fs::rename(copy, kept, fault);
    if (fault) return fail(Error::Kind::io, kept.string(), "can't be written: " + fault.message());
  }
  copies_.clear();
  folders_.clear();
  return {};
}

KeptFiles::~KeptFiles() {
  std::error_code ignored;
  for (const auto& [copy, kept] : copies_) fs::remove(copy, ignored);
  for (const fs::path& folder : folders_) fs::remove(folder, ignored);  // as far as they are empty
}

}  // namespace hooke::run
