// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/passes/spring_table.h"

#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "hooke/base/ascending.h"
#include "hooke/base/assert.h"
#include "hooke/physics/periodic.h"
#include "hooke/physics/spring.h"

namespace hooke {

template <class Real>
void SpringTable<Real>::configure(const std::shared_ptr<const Structure>& structure, const Vec3<Real>& period) {
  period_ = period;
  if (structure != structure_ || kinds_.empty()) take(structure);
  break_springs({});
}

template <class Real>
void SpringTable<Real>::break_springs(const std::vector<std::uint64_t>& broken) {
  HOOKE_ASSERT(is_ascending(broken), broken.size());
  HOOKE_ASSERT(broken.empty() || broken.back() < kind_.size(), broken.back(), kind_.size());
  broken_.assign(kind_.size(), 0);
  for (const std::uint64_t s : broken) broken_[s] = 1;
}

template <class Real>
std::vector<std::uint64_t> SpringTable<Real>::broken_springs() const {
  std::vector<std::uint64_t> all;
  for (std::size_t s = 0; s < broken_.size(); ++s) {
    if (broken_[s] != 0) all.push_back(s);
  }
  return all;
}

template <class Real>
void SpringTable<Real>::bind(const IdTable& ids) {
  if (empty()) return;
  ids_ = ids;
  const SpringSet& springs = structure_->springs;
  first_side_.assign(ids.size() + 1, 0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> apart;
  const auto each = [&](const auto& visit) {
    for (std::size_t s = 0; s < springs.size(); ++s) {
      const std::size_t a = ids.find(springs.a[s]), b = ids.find(springs.b[s]);
      if (a < ids.size() && b < ids.size()) {
        visit(static_cast<std::uint32_t>(s), static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
      }
    }
  };
  each([&](std::uint32_t s, std::uint32_t a, std::uint32_t b) {
    ++first_side_[a + 1];
    ++first_side_[b + 1];
    if (springs.contact[s] == 0 && broken_[s] == 0) apart.emplace_back(a, b);
  });
  for (std::size_t id_index = 0; id_index < ids.size(); ++id_index) first_side_[id_index + 1] += first_side_[id_index];
  sides_.resize(first_side_.back());
  std::vector<std::uint32_t> next(first_side_.begin(), first_side_.end() - 1);
  each([&](std::uint32_t s, std::uint32_t a, std::uint32_t b) {
    sides_[next[a]++] = {s, b};
    sides_[next[b]++] = {s, a};
  });
  exclusions_ = Exclusions(ids.size(), apart);
}

template <class Real>
void SpringTable<Real>::grow(std::size_t id_indices) {
  if (empty()) return;
  HOOKE_ASSERT(id_indices + 1 >= first_side_.size(), id_indices, first_side_.size());
  first_side_.resize(id_indices + 1, first_side_.back());
  exclusions_.grow(id_indices);
}

template <class Real>
void SpringTable<Real>::take(const std::shared_ptr<const Structure>& structure) {
  structure_ = structure;
  constexpr Real kInfinite = std::numeric_limits<Real>::infinity(), kNever = std::numeric_limits<Real>::quiet_NaN();
  kinds_.assign(kFirstSpringKind, {Real(0), Real(0), kInfinite, kNever});
  kind_.clear();
  rest_length_.clear();
  sides_.clear();
  first_side_.clear();
  exclusions_ = {};
  is_tearable_ = false;
  if (!structure) return;
  const SpringSet& springs = structure->springs;
  std::map<std::tuple<double, double, double, SpringMode>, std::uint32_t> known;
  kind_.reserve(springs.size());
  rest_length_.reserve(springs.size());
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const auto [kind, is_new] =
        known.try_emplace({springs.stiffness[s], springs.damping[s], springs.break_strain[s], springs.mode[s]},
                          static_cast<std::uint32_t>(kinds_.size()));
    if (is_new) {
      const SpringMode mode = springs.mode[s];
      kinds_.push_back({static_cast<Real>(springs.stiffness[s]), static_cast<Real>(springs.damping[s]),
                        static_cast<Real>(springs.break_strain[s]),
                        Real(mode == SpringMode::compression ? -1
                             : mode == SpringMode::extension ? 1
                                                             : 0)});
      is_tearable_ = is_tearable_ || kinds_.back().break_strain < kInfinite;
    }
    kind_.push_back(kind->second);
    rest_length_.push_back(static_cast<Real>(springs.rest_length[s]));
  }
}

template <class Real>
double SpringTable<Real>::energy_of(std::uint32_t spring, const ParticleRecord<Real>& i,
                                    const ParticleRecord<Real>& p) const {
  const SpringKind<Real>& kind = kinds_[kind_[spring]];
  const Vec3<Real> x_ip = nearest_displacement(i.x, p.x, period_);
  const Real extension = sqrt_of(dot(x_ip, x_ip)) - rest_length_[spring];
  return spring_acts(extension, kind.side) ? static_cast<double>(spring_energy(extension, kind.stiffness)) : 0.0;
}

template <class Real>
bool SpringTable<Real>::tear(std::uint32_t spring, std::uint32_t a, std::uint32_t b) {
  broken_[spring] = 1;
  if (structure_->springs.contact[spring] != 0) return false;
  exclusions_.release(a, b);
  return true;
}

template <class Real>
void SpringTable<Real>::tear(std::uint32_t spring) {
  if (broken_[spring] != 0) return;
  const std::size_t a = ids_.find(structure_->springs.a[spring]), b = ids_.find(structure_->springs.b[spring]);
  if (a < ids_.size() && b < ids_.size()) {
    tear(spring, static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  } else {
    broken_[spring] = 1;
  }
}

template class SpringTable<float>;
template class SpringTable<double>;

}  // namespace hooke
