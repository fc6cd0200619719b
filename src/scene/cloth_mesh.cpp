// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/cloth_mesh.h"

#include "hooke/scene/mesh_file.h"
#include "hooke/scene/mesh_repair.h"

namespace hooke::scene {

Expected<ClothMesh> read_cloth_mesh(const std::filesystem::path& file) {
  auto triangles = read_obj_triangles(file);
  if (!triangles) return fail(triangles.error());
  try {
    ClothMesh cloth;
    cloth.mesh = std::move(*triangles);
    cloth.vertex = mend(cloth.mesh, cloth.warnings);
    const std::vector<std::uint32_t> kept = drop_unused_vertices(cloth.mesh);
    for (std::uint32_t& v : cloth.vertex) v = kept[v];
    return cloth;
  } catch (const std::bad_alloc&) {
    return fail(Error::Kind::bad_input, "", "needs more memory than there is");
  }
}

}  // namespace hooke::scene
