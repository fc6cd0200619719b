// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/springs.h"

#include <algorithm>
#include <cmath>

#include "hooke/base/ascending.h"
#include "hooke/base/assert.h"
#include "hooke/base/format.h"
#include "hooke/core/particles.h"

namespace hooke {
namespace {

constexpr std::size_t kMostFindings = 20;
constexpr std::size_t kMostSprings = std::size_t{1} << 31U;

std::string fault_of(const Spring& s, bool single) {
  const auto usable = [single](double value) {
    return std::isfinite(value) && (!single || std::isfinite(static_cast<float>(value)));
  };
  const auto positive = [single](double value) { return value > 0 && (!single || static_cast<float>(value) > 0); };
  if (s.a == s.b) return formatted("ties particle {} to itself", s.a);
  if (!usable(s.rest_length) || !positive(s.rest_length)) {
    return formatted("rest_length {} must be a number greater than 0", s.rest_length);
  }
  if (!usable(s.stiffness) || s.stiffness < 0) return formatted("stiffness {} must be 0 or more", s.stiffness);
  if (!usable(s.damping) || s.damping < 0) return formatted("damping {} must be 0 or more", s.damping);
  if (!(s.break_strain > 0)) return formatted("break_strain {} must be greater than 0", s.break_strain);
  return {};
}

std::vector<Finding> check_columns(const SpringSet& s) {
  const std::size_t n = s.size();
  if (s.b.size() != n || s.rest_length.size() != n || s.stiffness.size() != n || s.damping.size() != n ||
      s.break_strain.size() != n || s.mode.size() != n || s.contact.size() != n) {
    return {{"springs", "columns of different length"}};
  }
  if (n > kMostSprings) return {{"springs", formatted("{} springs; at most {} are possible", n, kMostSprings)}};
  return {};
}

void check_surface(const Surface& surface, std::size_t index, std::vector<Finding>& findings) {
  const auto beyond = std::any_of(surface.triangles.begin(), surface.triangles.end(),
                                  [&](std::uint32_t corner) { return corner >= surface.particles.size(); });
  if (beyond || surface.triangles.size() % 3 != 0) {
    findings.push_back({formatted("surface {}", index), "its triangles don't fit its particles"});
  }
}

}  // namespace

void SpringSet::reserve(std::size_t n) {
  a.reserve(n);
  b.reserve(n);
  rest_length.reserve(n);
  stiffness.reserve(n);
  damping.reserve(n);
  break_strain.reserve(n);
  mode.reserve(n);
  contact.reserve(n);
}

void SpringSet::push_back(const Spring& spring) {
  a.push_back(spring.a);
  b.push_back(spring.b);
  rest_length.push_back(spring.rest_length);
  stiffness.push_back(spring.stiffness);
  damping.push_back(spring.damping);
  break_strain.push_back(spring.break_strain);
  mode.push_back(spring.mode);
  contact.push_back(spring.contact ? 1 : 0);
}

Spring SpringSet::operator[](std::size_t i) const {
  HOOKE_ASSERT(i < size(), i, size());
  return {a[i], b[i], rest_length[i], stiffness[i], damping[i], break_strain[i], mode[i], contact[i] != 0};
}

std::vector<Finding> validate(const Structure& structure, bool single) {
  std::vector<Finding> findings = check_columns(structure.springs);
  if (!findings.empty()) return findings;
  for (std::size_t i = 0; i < structure.springs.size() && findings.size() < kMostFindings; ++i) {
    std::string fault = fault_of(structure.springs[i], single);
    if (!fault.empty()) findings.push_back({formatted("spring {}", i), std::move(fault)});
  }
  const auto& pinned = structure.pinned;
  if (std::adjacent_find(pinned.begin(), pinned.end(), std::greater_equal<>()) != pinned.end()) {
    findings.push_back({"held", "ids must be unique and ascending"});
  }
  std::size_t end = 0;
  for (const SpringGroup& group : structure.groups) {
    if (group.end < end || group.end > structure.springs.size()) {
      findings.push_back({"groups", formatted("{} ends at spring {}; must be {} to {}, the number of springs",
                                              group.name, group.end, end, structure.springs.size())});
      break;
    }
    end = group.end;
  }
  for (std::size_t k = 0; k < structure.surfaces.size(); ++k) check_surface(structure.surfaces[k], k, findings);
  return findings;
}

std::vector<Finding> check_ids(const Structure& structure, const ParticleSet& particles) {
  HOOKE_ASSERT(is_ascending(particles.id), particles.size());
  std::vector<Finding> findings;
  const auto check = [&](std::uint64_t id, const auto& where) {
    if (findings.size() >= kMostFindings || particles.find(id) != particles.size()) return;
    findings.push_back({where(), formatted("names particle {}; there is none of this id", id)});
  };
  for (std::size_t i = 0; i < structure.springs.size(); ++i) {
    const auto where = [i] { return formatted("spring {}", i); };
    check(structure.springs.a[i], where);
    check(structure.springs.b[i], where);
  }
  for (const std::uint64_t id : structure.pinned) check(id, [] { return std::string("held"); });
  for (std::size_t k = 0; k < structure.surfaces.size(); ++k) {
    for (const std::uint64_t id : structure.surfaces[k].particles) {
      check(id, [k] { return formatted("surface {}", k); });
    }
  }
  return findings;
}

}  // namespace hooke
