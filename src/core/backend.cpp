// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/backend.h"

namespace hooke {

void download(const Backend& backend, Integrator integrator, ParticleSet& out) {
  const auto count = static_cast<std::size_t>(backend.particle_count());
  out.resize(count);
  out.acceleration.resize(integrator == Integrator::velocity_verlet ? count : 0);
  backend.download(ParticleColumns<double>{out.id.data(), out.material.data(), out.position.data(), out.velocity.data(),
                                           out.acceleration.data()});
}

}  // namespace hooke
