// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/outlier_pairs.h"

#include <algorithm>
#include <utility>

namespace hooke {

template <class Real>
bool OutlierPairs<Real>::is_listed(std::size_t i, std::size_t p) const {
  const auto rows = list_.rows(i / NeighbourList::kTile, i % NeighbourList::kTile / kLanes);
  return is_in_lane(rows, i % kLanes, record_offset<Real>(static_cast<std::uint32_t>(p)));
}

// If one of two particles lacks the other, the other lacks it, too. Ghosts have no rows.
template <class Real>
void OutlierPairs<Real>::note_missing(std::size_t i, std::size_t p, std::vector<MissingEntry>& missing) const {
  if (is_ghost(i)) std::swap(i, p);
  if (is_ghost(i) || is_listed(i, p) || exclusions_.hold(id_indices_[i], id_indices_[p])) return;
  const std::lock_guard lock(mutex_);
  for (const auto& [of, other] : {std::pair{i, p}, std::pair{p, i}}) {
    if (is_ghost(of)) continue;
    missing.push_back(
        {static_cast<std::uint32_t>(of), id_indices_[other], record_offset<Real>(static_cast<std::uint32_t>(other))});
  }
}

// Finds the particles that touch an outlier and are not outliers.
template <class Real>
void OutlierPairs<Real>::find_around(std::uint32_t i, const SearchCentre& centre,
                                     std::span<const std::uint16_t> outlying,
                                     std::vector<MissingEntry>& missing) const {
  const double range = centre.range + interaction_radius(i) + margin();
  const auto look_at = [&](std::size_t p) {
    const bool other_is_outlier = (outlying[p / kLanes] >> p % kLanes & 1U) != 0;
    if (!other_is_outlier && touch(i, p)) note_missing(i, p, missing);
  };
  cells_.for_points_near(centre.at, range, [&](std::size_t k) { look_at(slots_.slot_of(k)); });
  if (ghosts_.cells == nullptr || is_ghost(i)) return;
  ghosts_.cells->for_points_near(centre.at, range, [&](std::size_t k) { look_at(ghosts_.first + k); });
}

// Pairs of two outliers. Outliers are sorted into rows along x, as wide as two can touch. Each is compared with the
// outliers that follow it in its row and with those near its x in half of the rows around. At periodic faces, outliers
// near the lower face have an image beyond the upper face.
template <class Real>
void OutlierPairs<Real>::find_among(std::span<const std::uint32_t> outliers, Room& room) const {
  using Outlier = typename Room::Outlier;
  std::vector<Outlier>& sorted = room.sorted;
  sorted.clear();
  const auto reach = static_cast<Real>(2 * rules_.largest_interaction_radius() + margin());
  for (const std::uint32_t i : outliers) {
    if (!is_vacant(records_[i])) add_with_images(i, records_[i].x, 0, reach, sorted);
  }
  std::sort(sorted.begin(), sorted.end(), [](const Outlier& a, const Outlier& b) { return a.is_before(b.row, b.x.x); });
  parallel_ranges(sorted.size(), 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t a = first; a < last; ++a) {
      const Outlier& outlier = sorted[a];
      const auto meet = [&](auto other, std::uint64_t row) {
        for (; other != sorted.end() && other->row == row && other->x.x - outlier.x.x < reach; ++other) {
          if (other->i != outlier.i && touch(outlier.i, other->i)) note_missing(outlier.i, other->i, room.missing);
        }
      };
      meet(sorted.begin() + static_cast<std::ptrdiff_t>(a) + 1, outlier.row);
      for (const std::uint64_t row :
           {outlier.row + 1, outlier.row + kNextY - 1, outlier.row + kNextY, outlier.row + kNextY + 1}) {
        meet(std::partition_point(sorted.begin(), sorted.end(),
                                  [&](const Outlier& s) { return s.is_before(row, outlier.x.x - reach); }),
             row);
      }
    }
  });
}

// Adds a position, and its images across periodic faces from `axis` on.
template <class Real>
void OutlierPairs<Real>::add_with_images(std::uint32_t i, const Vec3<Real>& x, int axis, Real reach,
                                         std::vector<typename Room::Outlier>& to) const {
  if (axis == 3) {
    constexpr double kMost = 1 << 30;  // further away, rows are shared
    const auto index = [&](Real c) {
      return static_cast<std::uint64_t>(
          std::clamp(std::floor(static_cast<double>(c) / static_cast<double>(reach)), -kMost, kMost) + 2 * kMost);
    };
    to.push_back({index(x.y) * kNextY + index(x.z), x, i});
    return;
  }
  add_with_images(i, x, axis + 1, reach, to);
  const RulesView<Real>& rules = rules_.view();
  if (!rules.periodic[axis] || component(x, axis) >= component(rules.min, axis) + reach) return;
  Vec3<Real> image = x;
  component(image, axis) += component(rules.length, axis);
  add_with_images(i, image, axis + 1, reach, to);
}

template class OutlierPairs<float>;
template class OutlierPairs<double>;

}  // namespace hooke
