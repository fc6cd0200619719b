// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "hooke/base/ascending.h"
#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"
#include "hooke/core/contact_walk.h"
#include "hooke/core/placed_colliders.h"
#include "hooke/core/springs.h"
#include "hooke/neighbours/cell_grid.h"

namespace hooke {

namespace {

// A contact from the side of particle a; it is found a second time from the other side.
struct Touch {
  Contact contact;
  double normal_force;  // N, > 0 pushes a away
};

// Particles in cells, and the contacts between them.
class ContactSearch {
 public:
  /// Some pairs further apart than `furthest` (m) may be missed.
  ContactSearch(const Scene& scene, const ParticleSet& particles, const ContactInstant& now,
                double furthest = std::numeric_limits<double>::infinity())
      : scene_(scene),
        particles_(particles),
        table_(scene.materials, scene.contacts),
        furthest_(furthest) {
    HOOKE_ASSERT(are_particles_of(particles, scene), particles.size(), scene.materials.size());
    HOOKE_ASSERT(is_ascending(now.broken_springs), now.broken_springs.size());
    if (particles.empty()) return;
    place_colliders(now.time);
    find_exclusions(now.broken_springs);
    lay_out_grid();
    sort_spheres();
  }

  // All pairs nearer than this, m, are compared.
  double reach() const { return reach_; }

  // How many comparisons it takes to find everything.
  double comparisons() const {
    Neighbourhood around(*this);
    double all = 0;
    for (std::size_t k = 0, next; k < keys_.size(); k = next) {
      next = k + 1;
      while (next < keys_.size() && keys_[next] == keys_[k]) ++next;
      around.move_to(keys_[k]);
      all += static_cast<double>(next - k) * static_cast<double>(around.size());
    }
    return all;
  }

  // body(i, touches) for every particle of the set, or each `every`-th, on all threads, in the order of cells. In
  // `touches`, pairs come first.
  template <class Body>
  void for_each_particle(const Body& body, std::size_t every = 1) const {
    parallel_ranges(spheres_.size(), kBlock, [&](std::size_t first, std::size_t last) {
      Neighbourhood around(*this);
      std::vector<Touch> touches;
      for (std::size_t k = first + (every - first % every) % every; k < last; k += every) {
        around.move_to(keys_[k]);
        touches.clear();
        add_pairs(k, around.near(k), touches);
        add_walls(k, touches);
        add_colliders(k, touches);
        body(spheres_[k].index, std::span(touches));
      }
    });
  }

 private:
  static constexpr std::size_t kBlock = 4096;  // particles per piece of work
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  // A particle of the set, in the order of cells.
  struct Sphere {
    Vec3d x;
    double radius;
    Vec3d v;
    std::uint32_t index;
    std::uint16_t material;
  };

  struct Range {
    std::size_t first, last;
  };

  // The particles in and around the current cell, as ranges of the sorted spheres. Cells come in ascending order.
  class Neighbourhood {
   public:
    explicit Neighbourhood(const ContactSearch& search) : search_(search) {}

    void move_to(std::uint64_t key) {
      if (key == key_) return;
      key_ = key;
      CellGrid::KeyRange cells[CellGrid::kMostRanges];
      count_ = search_.grid_.neighbour_ranges(key, cells);
      const std::vector<std::uint64_t>& keys = search_.keys_;
      for (std::size_t r = 0; r < count_; ++r) {
        const std::size_t first = cursors_[r].seek(keys, cells[r].first);
        std::size_t last = first;
        while (last < keys.size() && keys[last] <= cells[r].last) ++last;
        ranges_[r] = {first, last};
      }
    }

    std::size_t size() const {
      std::size_t all = 0;
      for (const Range& range : std::span(ranges_.data(), count_)) all += range.last - range.first;
      return all;
    }

    // The spheres that may touch sphere k, itself included.
    std::span<const std::uint32_t> near(std::size_t k) {
      return search_.any_periodic_ ? filter<true>(k) : filter<false>(k);
    }

   private:
    // Without a branch: most are far, and the near ones are unpredictable. The margin leaves the last digits to the
    // exact test.
    template <bool kPeriodic>
    std::span<const std::uint32_t> filter(std::size_t k) {
      const Sphere& i = search_.spheres_[k];
      const Vec3d period = search_.period_;
      const auto squared = [](double d, double length) {
        if (!kPeriodic) return d * d;
        const double nearest = std::min(std::abs(d), std::abs(length - std::abs(d)));
        return nearest * nearest;
      };
      std::size_t count = 0;
      for (const Range& range : std::span(ranges_.data(), count_)) {
        near_.resize(std::max(near_.size(), count + range.last - range.first));
        for (std::size_t n = range.first; n < range.last; ++n) {
          const Sphere& p = search_.spheres_[n];
          const double distance_squared =
              squared(i.x.x - p.x.x, period.x) + squared(i.x.y - p.x.y, period.y) + squared(i.x.z - p.x.z, period.z);
          const double reach = i.radius + p.radius + search_.table_.widest_range();
          near_[count] = static_cast<std::uint32_t>(n);
          count += distance_squared < reach * reach * (1 + 1e-9) ? 1 : 0;
        }
      }
      return {near_.data(), count};
    }

    const ContactSearch& search_;
    std::uint64_t key_ = ~std::uint64_t{0};
    std::size_t count_ = 0;
    std::array<Range, 18> ranges_{};
    std::array<KeyCursor, 18> cursors_;
    std::vector<std::uint32_t> near_;
  };

  double radius(std::size_t i) const { return scene_.materials[particles_.material[i]].radius; }

  void place_colliders(double time) {
    std::vector<ColliderPose> poses;
    for (const Collider& collider : scene_.colliders) poses.push_back(pose_at(collider, time));
    colliders_ = hooke::place_colliders<double>(scene_, poses, largest_radius() + table_.widest_range());
  }

  double largest_radius() const {
    double largest = 0;
    for (const Material& m : scene_.materials) largest = std::max(largest, m.radius);
    return largest;
  }

  void find_exclusions(std::span<const std::uint64_t> broken) {
    if (!scene_.structure) return;
    const SpringSet& springs = scene_.structure->springs;
    for (std::size_t s = 0; s < springs.size(); ++s) {
      if (springs.contact[s] != 0 || std::binary_search(broken.begin(), broken.end(), s)) continue;
      exclusions_.emplace_back(std::minmax(springs.a[s], springs.b[s]));
    }
    std::sort(exclusions_.begin(), exclusions_.end());
  }

  bool excludes(std::uint32_t a, std::uint32_t b) const {
    if (exclusions_.empty()) return false;
    const auto ids = std::minmax(particles_.id[a], particles_.id[b]);
    return std::binary_search(exclusions_.begin(), exclusions_.end(), IdPair(ids));
  }

  void lay_out_grid() {
    double largest = 0;
    Vec3d min = particles_.position.front();
    Vec3d max = min;
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      largest = std::max(largest, radius(i));
      const Vec3d& x = particles_.position[i];
      min = {std::min(min.x, x.x), std::min(min.y, x.y), std::min(min.z, x.z)};
      max = {std::max(max.x, x.x), std::max(max.y, x.y), std::max(max.z, x.z)};
    }
    const double reach = std::min(2 * largest + table_.widest_range(), furthest_);
    reach_ = reach;
    walls_ = scene_.domain.walls();
    images_.period = scene_.domain.period();
    bool periodic[3];
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      periodic[a] = scene_.domain.boundary[a] == Boundary::periodic;
      if (!periodic[a]) continue;
      any_periodic_ = true;
      component(min, axis) = component(scene_.domain.min, axis);
      component(max, axis) = component(scene_.domain.max, axis);
      // On an axis of at least two contact distances the nearest image is the only one that can touch.
      const double length = scene_.domain.length(axis);
      component(period_, axis) = length;
      images_.most[a] = length >= 2 * reach ? 0 : static_cast<std::int32_t>(reach / length) + 1;
    }
    grid_.lay_out(min, max, periodic, reach * (1 + 1e-6));
  }

  void sort_spheres() {
    const std::size_t n = particles_.size();
    keys_.resize(n);
    parallel_ranges(n, kBlock, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) keys_[i] = grid_.key_of(particles_.position[i]);
    });
    std::vector<std::uint32_t> order;
    sort_by_key(keys_, order);
    spheres_.resize(n);
    parallel_ranges(n, kBlock, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        const std::uint32_t i = order[k];
        spheres_[k] = {particles_.position[i], radius(i), particles_.velocity[i], i, particles_.material[i]};
      }
    });
  }

  void add_pairs(std::size_t k, std::span<const std::uint32_t> near, std::vector<Touch>& touches) const {
    const Sphere& i = spheres_[k];
    for (const std::uint32_t n : near) {
      const Sphere& p = spheres_[n];
      if (!scene_.materials[i.material].interacts || !scene_.materials[p.material].interacts) continue;
      for_each_image(i.x, p.x, images_, [&](const ImageIndex& image, const Vec3d& x_ip) {
        if (n != k || image != ImageIndex{}) add_if_touching(i, p, image, x_ip, touches);
      });
    }
  }

  void add_if_touching(const Sphere& i, const Sphere& p, const ImageIndex& image, const Vec3d& x_ip,
                       std::vector<Touch>& touches) const {
    const ContactLaw<double>& law = table_.pair(i.material, p.material);
    const auto [overlap, normal] = pair_geometry(x_ip, i.radius + p.radius, i.index > p.index ? 1.0 : -1.0);
    if (!(overlap > -law.surface.range) || excludes(i.index, p.index)) return;  // indices go with ids
    const Vec3d force = contact_force(overlap, normal, p.v - i.v, law);
    touches.push_back({{i.index, p.index, Face::none, image, overlap, force}, dot(force, normal)});
  }

  void add_walls(std::size_t k, std::vector<Touch>& touches) const {
    const Sphere& i = spheres_[k];
    const ContactLaw<double>& law = table_.wall(i.material);
    for_each_wall(walls_, i.x, i.radius, law.surface.range, [&](int face, const Vec3d& normal, double overlap) {
      const Vec3d force = contact_force(overlap, normal, -i.v, law);
      touches.push_back(
          {{i.index, Contact::kWall, static_cast<Face>(face + 1), {}, overlap, force}, dot(force, normal)});
    });
  }

  void add_colliders(std::size_t k, std::vector<Touch>& touches) const {
    const Sphere& i = spheres_[k];
    for (std::size_t n = 0; n < colliders_.all.size(); ++n) {
      const std::uint32_t c = colliders_.of[n];
      const PlacedCollider<double>& collider = colliders_.all[n];
      if (!collider.near.contains(i.x)) continue;
      const ContactLaw<double>& law = table_.collider(i.material, scene_.colliders[c].material);
      for_each_collider_face(collider, i.x, [&](const ColliderFace<double>& face) {
        const double overlap = i.radius - face.distance;
        if (!(overlap > -law.surface.range)) return;
        const Vec3d force = contact_force(overlap, face.normal, face.velocity - i.v, law);
        const Vec3d point = i.x - face.distance * face.normal;
        touches.push_back(
            {{i.index, Contact::kCollider, Face::none, {}, overlap, force, c, point}, dot(force, face.normal)});
      });
    }
  }

  using IdPair = std::pair<std::uint64_t, std::uint64_t>;

  const Scene& scene_;
  const ParticleSet& particles_;
  ContactTable table_;
  double furthest_, reach_ = 0;  // m
  PlacedColliders<double> colliders_;
  std::vector<IdPair> exclusions_;  // smaller id first, ascending: a spring keeps them from touching
  bool any_periodic_ = false;
  Vec3d period_{kNever, kNever, kNever};  // m, of periodic axes
  PeriodicImages images_;
  Walls walls_;
  CellGrid grid_;
  std::vector<std::uint64_t> keys_;  // of cells, ascending
  std::vector<Sphere> spheres_;  // by cell
};

// Whether this side of a contact is the one that is listed.
bool is_listed(const Touch& touch) {
  const Contact& c = touch.contact;
  return c.b > c.a || (c.b == c.a && c.image > ImageIndex{});
}

}  // namespace

const char* to_string(Face face) {
  constexpr const char* kNames[] = {"", "x-min", "x-max", "y-min", "y-max", "z-min", "z-max"};
  return kNames[static_cast<std::size_t>(face)];
}

std::vector<Contact> find_contacts(const Scene& scene, const ParticleSet& particles, const ContactInstant& now) {
  const ContactSearch search(scene, particles, now);

  // How many contacts each particle lists, then where its list begins.
  std::vector<std::size_t> begin(particles.size() + 1);
  search.for_each_particle([&](std::size_t i, std::span<const Touch> touches) {
    begin[i + 1] = static_cast<std::size_t>(std::count_if(touches.begin(), touches.end(), is_listed));
  });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());

  std::vector<Contact> found(begin.back());
  search.for_each_particle([&](std::size_t i, std::span<const Touch> touches) {
    Contact* const first = found.data() + begin[i];
    Contact* next = first;
    for (const Touch& touch : touches) {
      if (is_listed(touch)) *next++ = touch.contact;
    }
    // Walls and colliders follow the pairs, in order.
    Contact* const pairs_end = std::find_if(first, next, [](const Contact& c) { return c.b >= Contact::kCollider; });
    std::sort(first, pairs_end,
              [](const Contact& c, const Contact& d) { return std::tie(c.b, c.image) < std::tie(d.b, d.image); });
  });
  return found;
}

Overlaps count_overlaps(const Scene& scene, const ParticleSet& particles) {
  constexpr double kMostComparisons = 2e7;
  constexpr int kMostHalvings = 30;
  Overlaps found;
  std::mutex mutex;  // guards the results
  const auto look = [&](const ContactSearch& search) {
    const auto every = static_cast<std::size_t>(std::ceil(std::max(1.0, search.comparisons() / kMostComparisons)));
    double sides = 0;
    search.for_each_particle(
        [&](std::size_t i, std::span<const Touch> touches) {
          const Touch* worst = nullptr;
          double ratio = 0, count = 0;
          for (const Touch& touch : touches) {
            const Contact& c = touch.contact;
            if (c.b >= Contact::kCollider || !(c.overlap > 0)) continue;
            ++count;
            const auto radius = [&](std::size_t k) { return scene.materials[particles.material[k]].radius; };
            const double its = c.overlap / (radius(i) + radius(c.b));
            if (worst != nullptr && (its < ratio || (its == ratio && c.b > worst->contact.b))) continue;
            worst = &touch;
            ratio = its;
          }
          const std::lock_guard lock(mutex);
          sides += count;
          if (worst == nullptr) return;
          const auto pair = std::minmax(worst->contact.a, worst->contact.b);
          if (ratio < found.ratio || (ratio == found.ratio && pair >= std::minmax(found.a, found.b))) return;
          found.a = pair.first;
          found.b = pair.second;
          found.overlap = worst->contact.overlap;
          found.ratio = ratio;
        },
        every);
    found.pairs = std::max(found.pairs, 0.5 * sides * static_cast<double>(every));
    return every == 1;
  };
  // Where only some particles were checked, all particles are checked for nearer pairs.
  double furthest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMostHalvings; ++k) {
    const ContactSearch search(scene, particles, {}, furthest);
    if (k == 0 || search.comparisons() <= kMostComparisons) {
      if (look(search) || k > 0) break;
    }
    furthest = 0.5 * search.reach();
  }
  return found;
}

ContactFigures contact_figures(const Scene& scene, const ParticleSet& particles, const ContactInstant& now) {
  const ContactSearch search(scene, particles, now);
  ContactFigures figures;
  figures.count.resize(particles.size());
  figures.pressure.resize(particles.size());
  search.for_each_particle([&](std::size_t i, std::span<const Touch> touches) {
    double normal_force = 0;
    std::uint32_t touching = 0;
    for (const Touch& touch : touches) {
      normal_force += touch.normal_force;
      if (touch.contact.overlap > 0) ++touching;
    }
    const double r = scene.materials[particles.material[i]].radius;
    const double volume = 4.0 / 3.0 * std::numbers::pi * r * r * r;
    figures.count[i] = touching;
    figures.pressure[i] = r * normal_force / (3 * volume);
  });
  return figures;
}

}  // namespace hooke
