// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/start_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "hooke/base/printable.h"
#include "hooke/core/body_overlaps.h"
#include "hooke/run/numbers.h"

namespace hooke::run {

std::string unstable_step(const Simulation& simulation) {
  const std::string unstable = unstable_step(simulation.scene(), stable_step(simulation));
  return unstable.empty() ? unstable : "time.step: " + unstable;
}

FloatSpacing float_spacing(const Scene& scene) {
  double farthest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    farthest =
        std::max({farthest, std::abs(component(scene.domain.min, axis)), std::abs(component(scene.domain.max, axis))});
  }
  double radius = INFINITY;
  for (const Material& material : scene.materials) {
    if (material.is_of_particles()) radius = std::min(radius, material.radius);
  }
  const auto edge = static_cast<float>(farthest);
  const double spacing = static_cast<double>(std::nextafter(edge, INFINITY)) - static_cast<double>(edge);
  return {spacing, spacing / radius};
}

std::string coarse_positions(const Simulation& simulation) {
  // docs/determinism.md says how a coarser spacing affects a pile.
  constexpr double kFinest = 1e-4;  // radii
  if (simulation.backend_info().precision == Precision::double_precision) return {};
  const double radii = float_spacing(simulation.scene()).radii;
  if (radii <= kFinest) return {};
  return fmt::format(
      "domain: single precision resolves only {:.3g} radii at its edge ({} is fine), too little for particles at rest "
      "there: set \"precision\": \"double\", or move the domain nearer to 0",
      radii, kFinest);
}

std::string small_ranks(const OpenedSimulation& opened) {
  // Below it a rank has a fifth as many ghosts as particles, and more (docs/cluster.md).
  constexpr std::uint64_t kFewest = 20'000;
  if (opened.ranks == 1 || !opened.simulation.scene().emitters.empty()) return {};
  const std::uint64_t each = opened.simulation.particle_count() / static_cast<std::uint64_t>(opened.ranks);
  if (each >= kFewest) return {};
  return fmt::format(
      "{} ranks have {} particles each, below {} each they do little but exchange ghosts: fewer ranks, or threads in "
      "place of ranks, are faster",
      opened.ranks, with_commas(each), with_commas(kFewest));
}

std::string soft_particles(const Simulation& simulation, const Measurements& now) {
  constexpr double kSoft = 0.05;
  if (now.contacts == 0 || now.mean_overlap_ratio <= kSoft) return {};
  const double factor = now.mean_overlap_ratio / kSoft;
  std::vector<const Material*> materials;
  for (const Material& material : simulation.scene().materials) {
    if (material.is_of_particles() && material.interacts) materials.push_back(&material);
  }
  const std::string enough = materials.size() == 1
                                 ? fmt::format("materials{}.stiffness {:.2g} N/m", path_step(materials[0]->name),
                                               factor * materials[0]->contact.stiffness)
                                 : fmt::format("{:.2g} times the stiffness", factor);
  return fmt::format(
      "particles overlap by {:.1f} % of the sum of their radii on average, by about twice that at the bottom: too soft "
      "for their depth; {} would do, with a time step {:.2g} times as long",
      100 * now.mean_overlap_ratio, enough, 1 / std::sqrt(factor));
}

namespace {

// None where the simulation has failed, which the next step will say.
std::vector<BodyOverlap> body_overlaps(const Simulation& simulation) {
  auto found = find_body_overlaps_in_slices(simulation.scene(), *simulation.slices(), simulation.time());
  return found ? std::move(*found) : std::vector<BodyOverlap>{};
}

std::string named(const BodyOverlap& body, const Scene& scene) {
  if (body.face != Face::none) return fmt::format("the wall {}", to_string(body.face));
  return fmt::format("collider \"{}\"", printable(scene.colliders[body.collider].name));
}

std::string particles(std::uint64_t count) {
  return fmt::format("{} particle{}", with_commas(count), count == 1 ? "" : "s");
}

std::string overlap_sentence(const BodyOverlap& body, const Scene& scene) {
  return fmt::format("{} overlap{} {} at the start, particle {} most, by {:.3g} % of its radius",
                     particles(body.touching), body.touching == 1 ? "s" : "", named(body, scene), body.deepest,
                     100 * body.ratio);
}

std::string inside_sentence(const BodyOverlap& body, const Scene& scene) {
  const Collider& collider = scene.colliders[body.collider];
  const std::string who =
      fmt::format("{} {} inside {}", particles(body.inside), body.inside == 1 ? "is" : "are", named(body, scene));
  if (std::holds_alternative<PlaneShape>(collider.shape)) {
    return who + ": behind the plane, which pushes them out along its normal";
  }
  return who + ", a solid, which pushes them out; with \"hollow\": true it is a shell that holds them";
}

}  // namespace

std::vector<std::string> overlapped_bodies(const Simulation& simulation) {
  std::vector<std::string> sentences;
  for (const BodyOverlap& body : body_overlaps(simulation)) {
    if (body.touching > 0) sentences.push_back(overlap_sentence(body, simulation.scene()));
  }
  return sentences;
}

std::vector<Finding> deep_starts(const Simulation& simulation) {
  constexpr double kDeep = 0.5;  // radii
  std::vector<Finding> findings;
  if (simulation.step_count() > 0) return findings;
  const Scene& scene = simulation.scene();
  for (const BodyOverlap& body : body_overlaps(simulation)) {
    const std::string where =
        body.face != Face::none ? std::string("domain.walls") : fmt::format("colliders[{}]", body.collider);
    if (body.inside > 0) {
      findings.push_back({where, inside_sentence(body, scene)});
    } else if (body.ratio > kDeep) {
      findings.push_back({where, overlap_sentence(body, scene)});
    }
  }
  return findings;
}

}  // namespace hooke::run
