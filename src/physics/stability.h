// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "hooke/base/assert.h"

namespace hooke {

/// m_i m_p / (m_i + m_p), kg, of masses > 0. A partner of infinite mass gives the other's mass.
inline double effective_mass(double mass_i, double mass_p) {
  HOOKE_ASSERT(mass_i > 0 && mass_p > 0, mass_i, mass_p);
  if (std::isinf(mass_i)) return mass_p;
  if (std::isinf(mass_p)) return mass_i;
  return mass_i * mass_p / (mass_i + mass_p);
}

/// c / (2 sqrt(k m_eff)), with m_eff > 0: 1 is critical damping; 0 without a spring.
inline double damping_ratio(double damping, double stiffness, double m_eff) {
  HOOKE_ASSERT(m_eff > 0, m_eff);
  return stiffness > 0 ? damping / (2 * std::sqrt(stiffness * m_eff)) : 0;
}

/// Largest eigenvalues of the springs and of the dashpots of a pile, as multiples of k/m_eff and c/m_eff of its pairs
/// (docs/theory.md section 4). With equal masses m = 2 m_eff they are 10 k/m and 24 c/m, the upper ends of what
/// packings show; an fcc lattice has 8 and 16.
inline constexpr double kPileSpringFactor = 5;
inline constexpr double kPileDampingFactor = 12;

/// Largest step (s) for which symplectic Euler is stable on x'' = -omega2 x - gamma x':
/// omega2 dt^2 + 2 gamma dt = 4 (docs/theory.md eq. 9). Infinite where both are 0.
inline double critical_step(double omega2, double gamma) {
  if (omega2 <= 0) return gamma > 0 ? 2 / gamma : INFINITY;
  // 4 / (gamma + sqrt(gamma^2 + 4 omega2)) is the positive root without cancellation.
  return 4 / (gamma + std::sqrt(gamma * gamma + 4 * omega2));
}

}  // namespace hooke
