// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "hooke/core/scene.h"

namespace hooke::test {

/// The summary of a pile, as its README defines it: spheres of one radius in a box, up is z.
struct PileStatistics {
  double height_995 = 0;        ///< 99.5 % quantile of z of the centres, m
  double phi_bulk = 0;  ///< volume fraction in 4 R < z < 0.8 height, centres at least 4 R from the side walls
  double phi_overall = 0;  ///< over the whole footprint, 0 to 0.9 height
  double z_all_pp = 0;  ///< contacts a particle, between particles
  double z_all_with_walls = 0;
  double z_bulk = 0;  ///< the same, in the interior
  double rattlers = 0;  ///< part with fewer than 4 contacts
  double max_overlap_over_d = 0;
  double deep_overlap_over_d = 0;  ///< one contact in a thousand exceeds it
  double mean_overlap_over_d = 0;  ///< over contacts
  double zcm = 0;  ///< m
};

/// One slab of the profile.
struct SlabStatistics {
  double particles = 0;
  double contacts_each = 0;  ///< between particles
  double mean_overlap_over_d = 0;  ///< over the contacts of its particles
};

PileStatistics pile_statistics(const std::vector<Vec3d>& x, double radius, const Domain& box);

/// Slabs between consecutive `edges` (m).
std::vector<SlabStatistics> pile_profile(const std::vector<Vec3d>& x, double radius, const std::vector<double>& edges);

}  // namespace hooke::test
