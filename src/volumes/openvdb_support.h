// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hooke::volumes {

/// Whether this build includes OpenVDB (HOOKE_WITH_OPENVDB). Without it, the functions that make distance fields of
/// meshes, surfaces and OpenVDB files return an error that says so.
bool has_openvdb();

}  // namespace hooke::volumes
