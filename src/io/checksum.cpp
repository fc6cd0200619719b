// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/checksum.h"

#include <bit>

#include "hooke/base/hash.h"

namespace hooke::io {
namespace {

template <class Real>
std::uint64_t checksum_as(const Snapshot& snapshot) {
  const ParticleSet& p = snapshot.particles;
  std::uint64_t sum = combine64(p.size(), static_cast<std::uint64_t>(snapshot.step));
  const auto add = [&sum](double x) {
    sum = combine64(sum, std::bit_cast<std::uint64_t>(static_cast<double>(static_cast<Real>(x))));
  };
  sum = combine64(sum, std::bit_cast<std::uint64_t>(snapshot.time));
  for (std::size_t i = 0; i < p.size(); ++i) {
    sum = combine64(combine64(sum, p.id[i]), p.material[i]);
    for (const Vec3d& a : {p.position[i], p.velocity[i]}) {
      add(a.x);
      add(a.y);
      add(a.z);
    }
  }
  return sum;
}

}  // namespace

std::uint64_t checksum(const Snapshot& snapshot, Precision precision) {
  return precision == Precision::single_precision ? checksum_as<float>(snapshot) : checksum_as<double>(snapshot);
}

std::uint64_t checksum(std::string_view text) {
  std::uint64_t sum = text.size();
  for (const char c : text) sum = combine64(sum, static_cast<unsigned char>(c));
  return sum;
}

}  // namespace hooke::io
