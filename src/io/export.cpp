// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "hooke/base/ascending.h"
#include "hooke/base/assert.h"
#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"

namespace hooke::io {

namespace {

struct Format {
  ExportFormatInfo info;
  ExportFunction* write;
};

constexpr ExportContent kParticles = ExportContent::particles;
constexpr ExportContent kContacts = ExportContent::contacts;
constexpr ExportContent kSurface = ExportContent::surface;
constexpr ExportContent kVolume = ExportContent::volume;
constexpr ExportContent kCloths = ExportContent::cloths;
constexpr ExportContent kSprings = ExportContent::springs;

constexpr Format kFormats[] = {
    {{".csv", kParticles, "a table: step,t,id,material,x,y,z,vx,vy,vz"}, export_csv},
    {{".vtp", kParticles, "VTK PolyData; with several snapshots a .pvd and one .vtp each"}, export_vtp},
    {{".pvd", kParticles, "ParaView collection of one .vtp a snapshot"}, export_vtp},
    {{".ply", kParticles, "binary PLY points"}, export_ply},
    {{".usda", kParticles, "USD points with time samples"}, export_usda},
    {{".xyz", kParticles, "extended XYZ"}, export_xyz},
    {{".extxyz", kParticles, "extended XYZ"}, export_xyz},
    {{".dump", kParticles, "LAMMPS text dump"}, export_lammps_dump},
    {{".lammpstrj", kParticles, "LAMMPS text dump"}, export_lammps_dump},
    {{".data", kParticles, "LAMMPS data file, atom_style sphere"}, export_lammps_data},
    {{".lmp", kParticles, "LAMMPS data file, atom_style sphere"}, export_lammps_data},
    {{".vdb", kParticles, "OpenVDB points"}, export_vdb_points},
    {{".csv", kContacts, "a table: step,t,id_a,id_b,image_x,image_y,image_z,overlap,fx,fy,fz"}, export_contacts_csv},
    {{".vtp", kContacts, "VTK PolyData, a line a contact; with several snapshots a .pvd"}, export_contacts_vtp},
    {{".pvd", kContacts, "ParaView collection of one .vtp a snapshot"}, export_contacts_vtp},
    {{".obj", kSurface, "Wavefront OBJ mesh"}, export_surface_obj},
    {{".ply", kSurface, "binary PLY mesh with velocities"}, export_surface_ply},
    {{".obj", kCloths, "Wavefront OBJ mesh of triangles"}, export_cloth_obj},
    {{".ply", kCloths, "binary PLY mesh of triangles with velocities"}, export_cloth_ply},
    {{".csv", kSprings, "a table: step,spring,a,b,rest_length,stiffness,damping,broken; of the run's checkpoint"},
     export_springs_csv},
    {{".vdb", kVolume, "OpenVDB: density, surface (level set), vel"}, export_vdb_volume},
};

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Whether the material indices of the run mean the same materials in the scene.
bool same_materials(const Scene& scene, const RunInfo& info) {
  return std::equal(scene.materials.begin(), scene.materials.end(), info.materials.begin(), info.materials.end(),
                    [](const Material& a, const MaterialInfo& b) { return a.name == b.name; });
}

}  // namespace

std::vector<ExportFormatInfo> export_formats() {
  std::vector<ExportFormatInfo> formats;
  for (const Format& format : kFormats) formats.push_back(format.info);
  return formats;
}

WrittenFiles::~WrittenFiles() {
  std::error_code ignored;
  for (const std::filesystem::path& file : files_) {
    if (std::filesystem::is_regular_file(std::filesystem::symlink_status(file, ignored))) {
      std::filesystem::remove(file, ignored);
    }
  }
}

std::filesystem::path numbered_file(const std::filesystem::path& file, std::size_t k, std::size_t count) {
  HOOKE_ASSERT(k < count, k, count);
  const std::size_t digits = std::max<std::size_t>(4, std::to_string(count - 1).size());
  return file.parent_path() / fmt::format("{}_{:0{}}{}", file.stem().string(), k, digits, file.extension().string());
}

std::vector<std::filesystem::path> export_each(
    const ExportJob& job, const std::function<void(std::size_t, const std::filesystem::path&)>& write) {
  WrittenFiles written;
  for (std::size_t k = 0; k < job.indices.size(); ++k) {
    const auto file = job.indices.size() == 1 ? job.file : numbered_file(job.file, k, job.indices.size());
    write(job.indices[k], file);
    written.add(file);
  }
  return written.keep();
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
    case ExportContent::cloths:
      return "cloths";
    case ExportContent::springs:
      return "springs";
  }
  return "";
}

Expected<std::vector<std::filesystem::path>> export_run(const RunReader& run, std::span<const std::size_t> indices,
                                                        const std::filesystem::path& file,
                                                        const ExportOptions& options) {
  HOOKE_ASSERT(is_ascending(indices), indices.size());
  HOOKE_ASSERT(indices.empty() || run.size() == 0 || indices.back() < run.size(), indices.back(), run.size());
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
    if (options.scene && !same_materials(*options.scene, run.info())) {
      throw Failure(Error::Kind::bad_input, run.file(), "has other materials than the scene that is said to be its");
    }
    return format->write({run, indices, file, options});
  });
}

}  // namespace hooke::io
