// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/export.h"

#include <fmt/format.h>

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

constexpr ExportContent kParticles = ExportContent::particles;

constexpr Format kFormats[] = {
    {{".csv", kParticles, "a table: step,t,id,material,x,y,z,vx,vy,vz"}, export_csv},
    {{".vtp", kParticles, "VTK PolyData; with several snapshots a .pvd and one .vtp each"}, export_vtp},
    {{".pvd", kParticles, "ParaView collection of one .vtp a snapshot"}, export_pvd},
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

std::filesystem::path numbered_file(const std::filesystem::path& file, std::size_t k, std::size_t count) {
  const std::size_t digits = std::max<std::size_t>(4, std::to_string(count - 1).size());
  return file.parent_path() / fmt::format("{}_{:0{}}{}", file.stem().string(), k, digits, file.extension().string());
}

const char* to_string(ExportContent content) {
  switch (content) {
    case ExportContent::particles:
      return "particles";
    case ExportContent::contacts:
      return "contacts";
    case ExportContent::surface:
      return "surface";
    case ExportContent::volume:
      return "volume";
  }
  return "";
}

Expected<std::vector<std::filesystem::path>> export_run(const RunReader& run, std::span<const std::size_t> indices,
                                                        const std::filesystem::path& file,
                                                        const ExportOptions& options) {
  return guarded(file, [&] {
    const std::string extension = lower_case(file.extension().string());
    const auto* format = std::find_if(std::begin(kFormats), std::end(kFormats), [&](const Format& f) {
      return extension == f.info.extension && options.content == f.info.content;
    });
    if (format == std::end(kFormats)) {
      std::string known;
      for (const Format& f : kFormats) {
        if (f.info.content == options.content) known += std::string(known.empty() ? "" : ", ") + f.info.extension;
      }
      throw Failure(
          Error::Kind::bad_input, file,
          fmt::format("has no extension that names a format for {}; known are {}", to_string(options.content), known));
    }
    if (run.size() == 0) throw Failure(Error::Kind::bad_input, run.file(), "holds no complete snapshot");
    if (indices.empty()) throw Failure(Error::Kind::bad_input, file, "no snapshot is chosen");
    return format->write({run, indices, file, options});
  });
}

}  // namespace hooke
