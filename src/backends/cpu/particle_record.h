// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

#include "hooke/base/vec3.h"

namespace hooke {

/// A particle as the CPU back end stores it: two quads of numbers, so that a pack of records is loaded with a few wide
/// loads and one 4 x 4 transpose. 32 bytes in single precision, half a cache line; 64 in double.
template <class Real>
struct alignas(8 * sizeof(Real)) ParticleRecord {
  Vec3<Real> x;   // m
  Real material;  // index into the scene's materials, a whole number
  Vec3<Real> v;   // m/s
  Real rank;      // rank_code() of the place of its id among all ids
};

/// The x of a record that stands for no particle: removed ones until the next sort, and the filling of short lanes. So
/// far away that nothing touches it, and its square still finite in single precision.
inline constexpr double kNowhere = 1e18;

template <class Real>
ParticleRecord<Real> nowhere_record(Real rank) {
  const Real far = static_cast<Real>(kNowhere);
  return {{far, far, far}, Real(0), {Real(0), Real(0), Real(0)}, rank};
}

template <class Real>
bool is_nowhere(const ParticleRecord<Real>& record) {
  return record.x.x == static_cast<Real>(kNowhere);
}

/// A rank as a number that compares like it. Floats hold whole numbers to 2^24 only, so there it is the bits, moved up
/// to where the patterns are ordinary numbers of 1 and above; good for 2^30 particles.
template <class Real>
Real rank_code(std::uint32_t rank);
template <>
inline float rank_code<float>(std::uint32_t rank) {
  return std::bit_cast<float>(0x3f800000U + rank);
}
template <>
inline double rank_code<double>(std::uint32_t rank) {
  return rank;
}

inline std::uint32_t rank_of(float code) { return std::bit_cast<std::uint32_t>(code) - 0x3f800000U; }
inline std::uint32_t rank_of(double code) { return static_cast<std::uint32_t>(code); }

}  // namespace hooke
