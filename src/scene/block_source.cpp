// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/block_source.h"

#include <fmt/format.h>

#include <algorithm>

#include "hooke/base/assert.h"
#include "hooke/base/random.h"
#include "hooke/scene/json_path.h"
#include "hooke/scene/random_packing.h"
#include "hooke/scene/scene_builder.h"

namespace hooke::scene {
namespace {

// Upper end of the centres along one axis where a block names no upper corner.
double default_upper(const Scene& scene, int axis, double lower, double radius, double spacing) {
  const bool periodic = scene.domain.boundary[static_cast<std::size_t>(axis)] == Boundary::periodic;
  return periodic ? lower + scene.domain.length(axis) - spacing : component(scene.domain.max, axis) - radius;
}

Lattice lattice_of(const BlockSource& block) {
  return {block.lattice == "hcp" ? LatticeKind::hcp : LatticeKind::cubic, block.box, block.spacing, block.up};
}

// `x` moved by `by`; a point that leaves through a periodic face enters again through the opposite one.
double moved(double x, double by, const Domain& domain, int axis) {
  const double low = component(domain.min, axis);
  const double high = component(domain.max, axis);
  const double to = x + by;
  const bool periodic = domain.boundary[static_cast<std::size_t>(axis)] == Boundary::periodic;
  if (!periodic || x < low || x >= high || (to >= low && to < high)) return to;
  const double wrapped = to < low ? to + (high - low) : to - (high - low);
  return wrapped < high ? wrapped : low;
}

// Of the block's centres from number `first` on, the last of `centres` from index `from` on.
void add_jitter(const BlockSource& block, const Domain& domain, std::uint64_t first, std::size_t from,
                std::vector<Vec3d>& centres) {
  if (!(block.jitter > 0)) return;
  for (std::size_t i = from; i < centres.size(); ++i) {
    const auto random = uniform4(block.seed, first + (i - from), 0);
    for (int axis = 0; axis < 3; ++axis) {
      const double by = block.jitter * (2 * random[static_cast<std::size_t>(axis)] - 1);
      component(centres[i], axis) = moved(component(centres[i], axis), by, domain, axis);
    }
  }
}

}  // namespace

std::optional<BlockSource> read_block(const Json& json, const std::string& path, const Scene& scene, double radius,
                                      Findings& findings) {
  BlockSource block;
  block.path = path;
  block.lattice = json.at("lattice");
  block.spacing = json.at("spacing");
  block.seed = json.at("seed");
  block.up = up_against(scene.gravity);
  const bool is_random = block.lattice == "random";
  if (!is_random) block.jitter = json.at("jitter");
  if (json.contains("count")) block.count = json.at("count").get<std::uint64_t>();
  block.box.min = vec3_or(json.at("min"), {});
  const bool has_max = json.contains("max");
  if (has_max) block.box.max = vec3_or(json.at("max"), {});
  bool usable = true;
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = component(block.box.min, axis);
    double& upper = component(block.box.max, axis);
    const double farthest = default_upper(scene, axis, lower, radius, block.spacing);
    const bool periodic = scene.domain.boundary[static_cast<std::size_t>(axis)] == Boundary::periodic;
    if (!has_max) {
      upper = farthest;
    } else if (upper < lower) {
      findings.add(join_path(join_path(path, "max"), static_cast<std::size_t>(axis)),
                   fmt::format("is {}; must be at least {}, which is {}", upper, join_path(path, "min"), lower));
      usable = false;
    } else if (is_random && periodic) {
      // Centres keep their distance across periodic faces, too.
      upper = std::max(lower, std::min(upper, farthest));
    }
  }
  return usable ? std::optional(block) : std::nullopt;
}

double expected_count(const BlockSource& block) {
  HOOKE_ASSERT(block.spacing > 0, block.path, block.spacing);
  if (block.count) return static_cast<double>(*block.count);
  if (block.lattice == "random") return random_packing_bound(block.box, block.spacing) / 2;
  return static_cast<double>(lattice_of(block).site_count());
}

std::vector<Vec3d> block_centres(const BlockSource& block, const Domain& domain, Findings& findings) {
  HOOKE_ASSERT(block.spacing > 0 && block.jitter >= 0, block.path, block.spacing, block.jitter);
  std::vector<Vec3d> centres;
  std::uint64_t room = 0;
  if (block.lattice == "random") {
    centres = random_packing(block.box, block.spacing, block.count.value_or(kAsManyAsFit), block.seed);
    room = centres.size();
  } else {
    room = lattice_site_count(block);
    const std::uint64_t wanted = block.count.value_or(room);
    if (wanted <= room) {
      centres.reserve(wanted);
      append_lattice(block, domain, 0, wanted, centres);
    }
  }
  if (block.count && *block.count > room) {
    const auto corner = [](const Vec3d& x) { return fmt::format("[{}, {}, {}]", x.x, x.y, x.z); };
    findings.add(join_path(block.path, "count"),
                 fmt::format("is {}, but only {} centres {} m apart fit between {} and {}", *block.count, room,
                             block.spacing, corner(block.box.min), corner(block.box.max)));
    return {};
  }
  return centres;
}

std::uint64_t lattice_site_count(const BlockSource& block) { return lattice_of(block).site_count(); }

void append_lattice(const BlockSource& block, const Domain& domain, std::uint64_t first, std::uint64_t count,
                    std::vector<Vec3d>& centres) {
  HOOKE_ASSERT(block.lattice != "random", block.path);
  const std::size_t from = centres.size();
  lattice_of(block).append_sites(first, count, centres);
  add_jitter(block, domain, first, from, centres);
}

}  // namespace hooke::scene
