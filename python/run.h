// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "arrays.h"
#include "hooke/io/export.h"
#include "hooke/io/run_folder.h"
#include "picture_thread.h"
#include "snapshot.h"

namespace hooke::python {

/// hooke.Run: reads a run folder.
class PythonRun {
 public:
  explicit PythonRun(const std::filesystem::path& folder);

  const io::RunReader& reader() const { return reader_; }
  const std::filesystem::path& folder() const { return folder_; }

  /// The snapshot that is picked: by one of the three, or the last. InputError where there is none of this step or
  /// index, or the time is outside of the run; else the one nearest in time.
  std::size_t pick(std::optional<double> time, std::optional<std::int64_t> step,
                   std::optional<std::int64_t> index) const;
  SnapshotView snapshot(std::size_t index) const;

  py::array render(std::optional<double> time, std::pair<int, int> size, const std::string& color_by,
                   const std::optional<std::array<double, 2>>& range, int samples, bool legend, bool alpha);
  std::vector<std::filesystem::path> write(const std::vector<std::size_t>& indices, const std::filesystem::path& file,
                                           const std::string& content, const volumes::SurfaceOptions& surface);

 private:
  const Scene& scene();  // kept in the folder, read when it is needed

  std::filesystem::path folder_;
  io::RunReader reader_;
  std::optional<Scene> scene_;
  PictureMaker pictures_;  // goes before the scene that it draws
};

void bind_run(py::module_& module);

}  // namespace hooke::python
