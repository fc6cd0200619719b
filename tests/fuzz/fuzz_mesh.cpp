// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// A file of triangles, in the format of HOOKE_FUZZ_EXTENSION: as a collider's and as a cloth's.
#include <cmath>

#include "fuzz/input.h"
#include "hooke/scene/cloth_mesh.h"
#include "hooke/scene/mesh_file.h"

namespace {

void require_sound(const hooke::TriangleMesh& mesh) {
  for (const hooke::Vec3d& x : mesh.vertices) {
    hooke::fuzz::require(std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z), "vertices are finite");
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      hooke::fuzz::require(corner < mesh.vertices.size(), "corners are vertices");
    }
  }
  (void)hooke::scene::count_open_edges(mesh);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hooke;
  static const fuzz::InputFile file(HOOKE_FUZZ_EXTENSION);
  const std::filesystem::path& path = file.write(fuzz::text_of(data, size));
  std::vector<std::string> warnings;
  if (const auto mesh = scene::read_mesh(path, &warnings)) {
    require_sound(*mesh);
  } else {
    fuzz::require_readable(mesh.error());
  }
  if (const auto cloth = scene::read_cloth_mesh(path)) {
    require_sound(cloth->mesh);
  } else {
    fuzz::require_readable(cloth.error());
  }
  return 0;
}
