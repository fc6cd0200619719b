// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hooke {

/// Whether OpenVDB is in this build (HOOKE_WITH_OPENVDB). Without it there are no distance fields of meshes, no
/// surfaces and no files of OpenVDB: what makes them returns an error that says so.
bool has_openvdb();

}  // namespace hooke
