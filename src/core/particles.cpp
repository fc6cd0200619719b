// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/particles.h"

#include <algorithm>
#include <numeric>

#include "hooke/base/ascending.h"
#include "hooke/base/assert.h"
#include "hooke/base/hash.h"
#include "hooke/core/particle_slices.h"
#include "hooke/core/scene.h"

namespace hooke {
namespace {

template <class T>
void permute(std::vector<T>& column, const std::vector<std::size_t>& order) {
  if (column.empty()) return;
  std::vector<T> sorted(column.size());
  for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = column[order[i]];
  column = std::move(sorted);
}

}  // namespace

void ParticleSet::reserve(std::size_t n) {
  id.reserve(n);
  material.reserve(n);
  position.reserve(n);
  velocity.reserve(n);
}

void ParticleSet::resize(std::size_t n) {
  id.resize(n);
  material.resize(n);
  position.resize(n);
  velocity.resize(n);
  if (!acceleration.empty()) acceleration.resize(n);
}

void ParticleSet::clear() { *this = ParticleSet{}; }

bool ParticleSet::columns_fit() const {
  const std::size_t n = size();
  return material.size() == n && position.size() == n && velocity.size() == n &&
         (acceleration.empty() || acceleration.size() == n);
}

void ParticleSet::sort_by_id() {
  HOOKE_ASSERT(columns_fit(), id.size(), material.size(), position.size(), velocity.size(), acceleration.size());
  if (std::is_sorted(id.begin(), id.end())) return;
  std::vector<std::size_t> order(size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // By index where ids are equal: stable, without std::stable_sort, whose buffer Clang warns of.
  std::sort(order.begin(), order.end(),
            [this](std::size_t a, std::size_t b) { return id[a] != id[b] ? id[a] < id[b] : a < b; });
  permute(id, order);
  permute(material, order);
  permute(position, order);
  permute(velocity, order);
  permute(acceleration, order);
}

std::size_t ParticleSet::find(std::uint64_t particle_id) const {
  HOOKE_ASSERT(id.empty() || id.front() <= id.back(), id.front(), id.back());  // checking all would take too long
  // Usually ids are consecutive numbers.
  if (!id.empty() && id.back() - id.front() == size() - 1) {
    return particle_id >= id.front() && particle_id <= id.back() ? particle_id - id.front() : size();
  }
  const auto found = std::lower_bound(id.begin(), id.end(), particle_id);
  return found != id.end() && *found == particle_id ? static_cast<std::size_t>(found - id.begin()) : size();
}

bool are_particles_of(const ParticleSet& particles, const Scene& scene) {
  const auto is_known = [&](std::uint16_t material) { return material < scene.materials.size(); };
  return particles.columns_fit() && is_ascending(particles.id) &&
         std::all_of(particles.material.begin(), particles.material.end(), is_known);
}

std::uint64_t ParticleSlice::identity() const {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < size(); ++i) sum += combine64(mix64(id[i]), material[i]);
  return sum;
}

}  // namespace hooke
