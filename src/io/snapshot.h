// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/core/simulation.h"
#include "hooke/core/snapshot.h"

namespace hooke::io {

/// The properties of a material that files keep.
struct MaterialInfo {
  std::string name;
  double radius = 0;  ///< m
  double mass = 0;    ///< kg

  friend bool operator==(const MaterialInfo&, const MaterialInfo&) = default;
};

/// The radius of each material, m.
std::vector<double> radii(const std::vector<MaterialInfo>& materials);

/// The description of its run in every file of a run.
struct RunInfo {
  std::string scene;      ///< Scene::name
  double time_step = 0;   ///< dt, s
  Integrator integrator = Integrator::symplectic_euler;
  Precision precision = Precision::single_precision;  ///< in which the back end computed
  std::vector<MaterialInfo> materials;                ///< ParticleSet::material is an index into these
  std::vector<std::string> colliders{};               ///< their names

  friend bool operator==(const RunInfo&, const RunInfo&) = default;
};

/// The description of a run of `scene` in this precision (that of BackendInfo).
RunInfo describe_run(const Scene& scene, Precision precision);
RunInfo describe_run(const Simulation& simulation);

/// The reasons why a run of `scene` can't continue from a checkpoint of `checkpoint` with the same bits: time step,
/// integrator, precision, names and order of the materials. Empty where it can; coefficients may differ.
std::vector<Finding> check_resumable(const RunInfo& checkpoint, const RunInfo& scene);

}  // namespace hooke::io
