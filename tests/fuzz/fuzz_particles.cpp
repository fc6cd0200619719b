// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// A file of particles, in the format of HOOKE_FUZZ_EXTENSION.
#include <cmath>

#include "fuzz/input.h"
#include "hooke/scene/particle_file.h"

namespace {

hooke::Material material(const char* name, double radius, double mass) {
  hooke::Material made;
  made.name = name;
  made.radius = radius;
  made.mass = mass;
  return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hooke;
  static const fuzz::InputFile file(HOOKE_FUZZ_EXTENSION);
  static const std::vector<Material> materials{material("water", 0.5, 1), material("oil", 0.25, 2)};
  const std::filesystem::path& path = file.write(fuzz::text_of(data, size));

  scene::ParticleFileRules rules;
  rules.materials = materials;
  if (size % 2 == 0) rules.material = 1;
  if (size % 3 == 0) rules.types = {{"1", 0}, {"C", 1}};
  if (size % 5 == 0) rules.frame = size % 10 == 0 ? scene::kLastFrame : 1;
  scene::Findings findings("scene.json");
  std::vector<Finding> warnings;
  const scene::FileParticles read = scene::read_particle_file(path, "input", rules, findings, warnings);
  const bool refused = !findings.empty();
  for (const Finding& finding : findings.take()) fuzz::require_readable(finding);
  for (const Finding& warning : warnings) fuzz::require_readable(warning);
  (void)scene::count_particles(path, rules);
  if (refused) return 0;

  const std::size_t n = read.position.size();
  fuzz::require(n > 0, "a file without particles is a finding");
  fuzz::require(read.material.size() == n && read.velocity.size() == n && read.place.size() == n,
                "columns have one length");
  fuzz::require(read.id.empty() || read.id.size() == n, "columns have one length");
  for (std::size_t i = 0; i < n; ++i) {
    fuzz::require(read.material[i] < materials.size(), "materials exist");
    for (int axis = 0; axis < 3; ++axis) {
      fuzz::require(std::isfinite(component(read.position[i], axis)), "positions are finite");
      fuzz::require(std::isfinite(component(read.velocity[i], axis)), "velocities are finite");
    }
  }
  return 0;
}
