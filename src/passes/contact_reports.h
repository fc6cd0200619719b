// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hooke/core/backend.h"
#include "hooke/core/sums.h"
#include "hooke/passes/contact_scan.h"
#include "hooke/passes/id_table.h"

namespace hooke {

/// A contact of particle i that is too fast for a step, if there is one: in double precision, with each pair's own
/// limit. `moved`: whether the particles have been brought to their places by a step, in which they may have passed
/// through something. `rows` are the rows of its slice in the neighbour list.
template <class Real>
Condition contact_too_fast(const ContactScan<Real>& scan, std::size_t i, std::span<const std::uint32_t> rows,
                           const ParticleRecord<Real>* records, const Scene& scene, const IdTable& ids, bool moved);

/// Adds particle i, whose record is `p`, and its contacts to `sums`.
template <class Real>
void measure_particle(const ContactScan<Real>& scan, std::size_t i, std::span<const std::uint32_t> rows,
                      const ParticleRecord<Real>& p, const Scene& scene, MeasurementSums& sums);

/// Adds the energy (J) of the contacts of particle i with other particles. A contact with one of `among` (indices,
/// ascending) counts half: that particle adds the other half.
template <class Real>
void add_contact_energy(const ContactScan<Real>& scan, std::size_t i, std::span<const std::uint32_t> rows,
                        std::span<const std::uint32_t> among, ExactSum& sum);

}  // namespace hooke
