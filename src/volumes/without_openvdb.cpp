// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Replaces everything that needs OpenVDB in a build without it.
#include "hooke/volumes/mesh_field.h"
#include "hooke/volumes/openvdb_support.h"
#include "hooke/volumes/surface_mesh.h"
#include "hooke/volumes/vdb_file.h"

namespace hooke::volumes {

namespace {

Unexpected refuse() {
  return fail(Error::Kind::bad_input, "", "needs OpenVDB, which is not in this build (HOOKE_WITH_OPENVDB)");
}

}  // namespace

bool has_openvdb() { return false; }

Expected<DistanceField> make_distance_field(const TriangleMesh&, const FieldOptions&) { return refuse(); }

Expected<SurfaceMesh> make_surface_mesh(const ParticleSet&, std::span<const double>, const SurfaceOptions&) {
  return refuse();
}

Expected<std::string> vdb_points(const ParticleSet&, std::span<const double>, const std::string&, const VdbInstant&) {
  return refuse();
}

Expected<std::string> vdb_volume(const ParticleSet&, std::span<const double>, const SurfaceOptions&,
                                 const VdbInstant&) {
  return refuse();
}

}  // namespace hooke::volumes
