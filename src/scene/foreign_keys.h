// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace hooke::scene {

/// What to write in a scene instead of a key that other particle programs have (LAMMPS, LIGGGHTS, SPlisHSPlasH, MFIX),
/// for instance of `restitution`: the words after "is no key of a scene". Capitals, '_', '-', spaces and apostrophes of
/// the key don't matter. Empty for any other key.
std::string_view foreign_key_hint(std::string_view key);

}  // namespace hooke::scene
