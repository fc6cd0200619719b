// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/export.h"

#include <algorithm>
#include <cctype>

#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"

namespace hooke {

namespace {

struct Format {
  ExportFormatInfo info;
  ExportFunction* write;
};

constexpr Format kFormats[] = {
    {{".csv", "a table: step,t,id,material,x,y,z,vx,vy,vz"}, export_csv},
    {{".vtp", "VTK PolyData; with several snapshots a .pvd and one .vtp each"}, export_vtp},
    {{".pvd", "ParaView collection of one .vtp a snapshot"}, export_pvd},
};

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

std::vector<ExportFormatInfo> export_formats() {
  std::vector<ExportFormatInfo> formats;
  for (const Format& format : kFormats) formats.push_back(format.info);
  return formats;
}

Expected<std::vector<std::filesystem::path>> export_run(const RunReader& run, std::span<const std::size_t> indices,
                                                        const std::filesystem::path& file) {
  return guarded(file, [&] {
    const std::string extension = lower_case(file.extension().string());
    const auto* format = std::find_if(std::begin(kFormats), std::end(kFormats),
                                      [&](const Format& f) { return extension == f.info.extension; });
    if (format == std::end(kFormats)) {
      std::string known;
      for (const Format& f : kFormats) known += std::string(known.empty() ? "" : ", ") + f.info.extension;
      throw Failure(Error::Kind::bad_input, file, "has no extension that names a format; known are " + known);
    }
    if (run.size() == 0) throw Failure(Error::Kind::bad_input, run.file(), "holds no complete snapshot");
    if (indices.empty()) throw Failure(Error::Kind::bad_input, file, "no snapshot is chosen");
    return format->write(run, indices, file);
  });
}

}  // namespace hooke
