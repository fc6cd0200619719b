// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/base/vec3.h"

namespace hooke {

struct ParticleSet;

/// Which way a spring acts.
enum class SpringMode : std::uint8_t {
  both,
  compression,  ///< only while it is shorter than its rest length
  extension,    ///< only while it is longer
};

/// One spring between two particles.
struct Spring {
  std::uint64_t a = 0, b = 0;  ///< ids, a != b
  double rest_length = 1;      ///< m, > 0
  double stiffness = 0;        ///< N/m, >= 0
  double damping = 0;          ///< N s/m, >= 0: damper along the spring
  double break_strain = std::numeric_limits<double>::infinity();  ///< > 0: extension over rest length that tears it
  SpringMode mode = SpringMode::both;
  bool contact = true;  ///< false: the two particles don't touch each other for as long as it holds
};

/// Springs, one entry of every column per spring. Each particle adds up its springs by ascending index.
struct SpringSet {
  std::vector<std::uint64_t> a, b;
  std::vector<double> rest_length, stiffness, damping, break_strain;
  std::vector<SpringMode> mode;
  std::vector<std::uint8_t> contact;  ///< 0 or 1

  std::size_t size() const { return a.size(); }
  bool empty() const { return a.empty(); }
  void reserve(std::size_t n);
  void push_back(const Spring& spring);
  Spring operator[](std::size_t i) const;  ///< i < size()

  friend bool operator==(const SpringSet&, const SpringSet&) = default;
};

/// A surface that particles span: the part of a cloth that is drawn and exported.
struct Surface {
  std::string name;                      ///< of its material
  std::vector<std::uint64_t> particles;  ///< ids of its corners
  std::vector<std::uint32_t> triangles;  ///< three corners each, indices into `particles`

  friend bool operator==(const Surface&, const Surface&) = default;
};

/// The springs that one entry of a scene made: from the end of the group before (0 for the first) up to `end`.
struct SpringGroup {
  std::string name;  ///< where the entry is, e.g. bodies[0]
  std::size_t end = 0;  ///< no less than that of the group before, and no more than there are springs

  friend bool operator==(const SpringGroup&, const SpringGroup&) = default;
};

/// What ties particles together, and what holds them. It does not change during a run; which springs are broken is
/// part of the state.
struct Structure {
  SpringSet springs;
  std::vector<SpringGroup> groups;  ///< names of springs in messages; without a group, their particles name them
  std::vector<std::uint64_t> pinned;  ///< ids of particles that no force moves, ascending
  std::vector<Surface> surfaces;

  friend bool operator==(const Structure&, const Structure&) = default;
};

/// What makes a structure unusable whatever its particles are; empty where all is well. At most 20 findings of a kind.
/// `single` asks that values survive the rounding to float.
std::vector<Finding> validate(const Structure& structure, bool single);

/// Ids in the structure that none of `particles` has, which are in ascending order of id.
std::vector<Finding> check_ids(const Structure& structure, const ParticleSet& particles);

}  // namespace hooke
