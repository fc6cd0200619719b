// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/skin_bodies.h"

#include <cstddef>
#include <numeric>

namespace hooke::render {

namespace {

// The first particle of each one's body, once the bodies of both ends of all springs are joined.
class Bodies {
 public:
  explicit Bodies(std::size_t particles) : before_(particles) {
    std::iota(before_.begin(), before_.end(), std::size_t{0});
  }

  std::size_t first(std::size_t i) {
    while (before_[i] != i) i = before_[i] = before_[before_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    i = first(i);
    j = first(j);
    before_[i > j ? i : j] = i > j ? j : i;
  }

 private:
  std::vector<std::size_t> before_;
};

// ParticleSet::find(), at once where no particle before this one is gone.
std::size_t find(const ParticleSet& particles, std::uint64_t id) {
  const std::uint64_t likely = particles.empty() ? 0 : id - particles.id.front();
  if (likely < particles.size() && particles.id[likely] == id) return static_cast<std::size_t>(likely);
  return particles.find(id);
}

}  // namespace

std::vector<std::uint8_t> skin_bodies(const Scene& scene, const ParticleSet& particles) {
  Bodies bodies(particles.size());
  std::vector<char> tied(particles.size(), 0);
  if (scene.structure) {
    const SpringSet& springs = scene.structure->springs;
    for (std::size_t s = 0; s < springs.size(); ++s) {
      const std::size_t i = find(particles, springs.a[s]), j = find(particles, springs.b[s]);
      if (i == particles.size() || j == particles.size()) continue;
      bodies.join(i, j);
      tied[i] = tied[j] = 1;
    }
  }
  std::size_t next = scene.materials.size();
  std::vector<std::size_t> number(particles.size());
  std::vector<std::uint8_t> body(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const std::size_t first = bodies.first(i);
    number[i] = tied[i] == 0 ? particles.material[i] : first == i ? next++ : number[first];
    body[i] = static_cast<std::uint8_t>(1 + number[i] % 255);
  }
  return body;
}

}  // namespace hooke::render
