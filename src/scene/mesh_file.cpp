// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <new>
#include <stdexcept>

#include "hooke/scene/mesh_repair.h"
#include "hooke/scene/polygon_mesh.h"

namespace hooke::scene {
namespace {

using MeshReader = void(FileScanner& in, PolygonMesh& mesh);

// Null where no format has this extension.
MeshReader* reader_for(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".obj") return read_obj;
  if (extension == ".stl") return read_stl;
  if (extension == ".ply") return read_ply_mesh;
  return nullptr;
}

Unexpected refuse(std::string why) { return fail(Error::Kind::bad_input, "", std::move(why)); }

std::string in_words(const FileFault& fault, bool binary) {
  if (fault.place() == 0) return fault.what();
  return fmt::format("can't be read as a mesh: {} {} {}", binary ? "byte" : "line", fault.place(), fault.what());
}

// Calls `work`, which returns an Expected and may throw what readers throw; `binary` says what places are by then.
template <class Work>
auto without_throwing(const bool& binary, const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const FileFault& fault) {
    return refuse(in_words(fault, binary));
  } catch (const std::bad_alloc&) {
    return refuse("needs more memory than there is");
  } catch (const std::length_error&) {
    return refuse("needs more memory than there is");
  }
}

Expected<PolygonMesh> read_with(MeshReader* read, const std::filesystem::path& file) {
  PolygonMesh mesh;
  return without_throwing(mesh.binary, [&]() -> Expected<PolygonMesh> {
    FileScanner in(file);
    read(in, mesh);
    if (mesh.ends.empty()) return refuse("holds no faces");
    return std::move(mesh);
  });
}

Expected<PolygonMesh> read_polygons(const std::filesystem::path& file) {
  MeshReader* const read = reader_for(file);
  if (read == nullptr) return refuse("is of no format of meshes that can be read: .obj, .stl, .ply");
  return read_with(read, file);
}

}  // namespace

Expected<TriangleMesh> read_obj_triangles(const std::filesystem::path& file) {
  auto polygons = read_with(read_obj, file);
  if (!polygons) return fail(polygons.error());
  return without_throwing(false, [&]() -> Expected<TriangleMesh> { return cut_into_triangles(std::move(*polygons)); });
}

Expected<TriangleMesh> read_mesh(const std::filesystem::path& file, std::vector<std::string>* warnings) {
  auto polygons = read_polygons(file);
  if (!polygons) return fail(polygons.error());
  return without_throwing(false, [&]() -> Expected<TriangleMesh> {
    std::vector<std::string> remarks = std::move(polygons->warnings);
    TriangleMesh mesh = cut_into_triangles(std::move(*polygons));
    merge_equal_vertices(mesh);
    mend(mesh, remarks);
    drop_unused_vertices(mesh);
    if (mesh.triangles.empty()) return refuse("holds no triangle with three corners apart");
    if (warnings != nullptr) warnings->insert(warnings->end(), remarks.begin(), remarks.end());
    return mesh;
  });
}

std::size_t count_open_edges(const TriangleMesh& mesh) {
  const OpenEdges open = open_edges(mesh);
  return open.single + open.odd;
}

}  // namespace hooke::scene
