// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/checksum.h"

#include <bit>

#include "hooke/base/hash.h"

namespace hooke::io {

SnapshotChecksum::SnapshotChecksum(std::int64_t step, double time, std::uint64_t particles, Precision precision)
    : precision_(precision),
      sum_(combine64(combine64(particles, static_cast<std::uint64_t>(step)), std::bit_cast<std::uint64_t>(time))) {}

void SnapshotChecksum::add(const ParticleSlice& particles) {
  if (precision_ == Precision::single_precision) {
    add_as<float>(particles);
  } else {
    add_as<double>(particles);
  }
}

template <class Real>
void SnapshotChecksum::add_as(const ParticleSlice& p) {
  std::uint64_t sum = sum_;
  const auto add_real = [&sum](double x) {
    sum = combine64(sum, std::bit_cast<std::uint64_t>(static_cast<double>(static_cast<Real>(x))));
  };
  for (std::size_t i = 0; i < p.size(); ++i) {
    sum = combine64(combine64(sum, p.id[i]), p.material[i]);
    for (const Vec3d& a : {p.position[i], p.velocity[i]}) {
      add_real(a.x);
      add_real(a.y);
      add_real(a.z);
    }
  }
  sum_ = sum;
}

std::uint64_t checksum(std::string_view text) {
  std::uint64_t sum = text.size();
  for (const char c : text) sum = combine64(sum, static_cast<unsigned char>(c));
  return sum;
}

}  // namespace hooke::io
