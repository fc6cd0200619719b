// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "hooke/backends/gpu/host_device.h"
#include "hooke/core/simulation.h"

namespace hooke {

// How GoogleTest prints a test's parameters.
inline void PrintTo(Integrator integrator, std::ostream* os) {
  *os << (integrator == Integrator::velocity_verlet ? "velocity Verlet" : "symplectic Euler");
}
inline void PrintTo(Precision precision, std::ostream* os) {
  *os << (precision == Precision::single_precision ? "single" : "double");
}

}  // namespace hooke

namespace hooke::test {

/// A back end to test with.
struct Engine {
  std::string device = "cpu";  ///< "cpu", "reference", or "gpu", a loop in place of one
  Precision precision = Precision::double_precision;
  int threads = 1;
  std::string isa;  ///< empty: the widest
  bool check_list = false;  ///< count the contacts that the neighbour list misses
  gpu::ItemOrder item_order = gpu::ItemOrder::shuffled;  ///< of "gpu"

  std::string name() const;  ///< "cpu_double", "cpu_double_avx2", for messages and names of tests
};

inline const Engine kReference{"reference", Precision::double_precision, 1, "", false};
inline const Engine kCpuDouble{"cpu", Precision::double_precision, 1, "", false};
inline const Engine kCpuSingle{"cpu", Precision::single_precision, 1, "", false};
inline const Engine kGpuDouble{"gpu", Precision::double_precision, 1, "", false};
inline const Engine kGpuSingle{"gpu", Precision::single_precision, 1, "", false};

inline void PrintTo(const Engine& engine, std::ostream* os) { *os << engine.name(); }

/// All that must have the same bits in a precision: each instruction set that this processor has, and a GPU with its
/// items in two orders.
std::vector<Engine> engines_with_the_same_bits(Precision precision);

std::unique_ptr<Backend> make_backend(const Engine& engine);

/// A simulation of `particles` on `engine`, with the engine's precision. Where it can't be made, fails the test with
/// the findings and throws.
Simulation simulate(Scene scene, const ParticleSet& particles, const Engine& engine);

/// The same, going on from `state`.
Simulation resume(Scene scene, const SimulationState& state, const Engine& engine);

/// Takes `steps` steps; false, with the error as a test failure, where a step fails.
bool advance(Simulation& simulation, std::int64_t steps);

/// The figures of this instant; a test failure where there are none.
Measurements measured(const Simulation& simulation);

/// All energy, plus what damping, broken springs and departures took, less what births, walls, colliders, holds and
/// fields gave, J: constant up to the integrator's error.
double accounted_energy(const Simulation& simulation);

}  // namespace hooke::test
