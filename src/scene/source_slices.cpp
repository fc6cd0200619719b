// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/source_slices.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "hooke/base/assert.h"
#include "hooke/scene/overlap_check.h"

namespace hooke::scene {
namespace {

// Whether ids ascend, and are all above those before.
bool go_on(const std::vector<std::uint64_t>& ids, std::uint64_t before) {
  if (ids.empty()) return true;
  return ids.front() > before && std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()) == ids.end();
}

}  // namespace

// Cuts what is put in into slices.
class SourceSlices::Slicer {
 public:
  Slicer(std::size_t rows, const Take& take) : rows_(rows), take_(take) { HOOKE_ASSERT(rows > 0); }

  // Room for more in the present slice, at least for one.
  std::uint64_t room() const { return rows_ - slice_.position.size(); }

  std::vector<Vec3d>& positions() { return slice_.position; }
  // The other columns of particles whose positions have been put in: of a source made, from its particle `first` on.
  void complete(const ParticleSource& source, const Made& made, std::uint64_t first) {
    const std::size_t before = slice_.size(), count = slice_.position.size() - before;
    if (made.id.empty()) {
      slice_.id.resize(before + count);
      std::iota(slice_.id.begin() + static_cast<std::ptrdiff_t>(before), slice_.id.end(), largest_id_ + 1);
    } else {
      append(slice_.id, made.id, first, count);
    }
    if (count > 0) largest_id_ = slice_.id.back();
    if (made.material.empty()) {
      slice_.material.resize(before + count, *source.rules.material);
    } else {
      append(slice_.material, made.material, first, count);
    }
    if (made.velocity.empty()) {
      slice_.velocity.resize(before + count, source.rules.velocity);
    } else {
      append(slice_.velocity, made.velocity, first, count);
    }
    if (slice_.size() == rows_) finish();
  }
  template <class T>
  static void append(std::vector<T>& to, const std::vector<T>& from, std::uint64_t first, std::size_t count) {
    const auto begin = from.begin() + static_cast<std::ptrdiff_t>(first);
    to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
  }

  std::uint64_t largest_id() const { return largest_id_; }

  // Hands out what is left.
  void finish() {
    if (!slice_.empty()) take_(ParticleSlice(slice_, 0, slice_.size()));
    slice_.resize(0);
  }

 private:
  std::size_t rows_;
  const Take& take_;
  ParticleSet slice_;
  std::uint64_t largest_id_ = 0;
};

SourceSlices::SourceSlices(const Scene& scene, std::vector<ParticleSource> sources)
    : domain_(scene.domain),
      materials_(scene.materials),
      attraction_(scene.attraction),
      sources_(std::move(sources)) {
  for (ParticleSource& source : sources_) source.rules.materials = materials_;
}

bool SourceSlices::prepare(const LoadOptions& options, std::vector<Finding>& warnings) {
  HOOKE_ASSERT(counts_.empty(), counts_.size());
  Findings findings("");
  std::vector<Finding> notes;
  PairEstimate pairs(largest_radius(), expected_size());
  bool all_inside = true;
  const Take look = [&](const ParticleSlice& slice) {
    identity_ += slice.identity();
    pairs.add(slice.position);
    for (const Vec3d& x : slice.position) all_inside = all_inside && can_start_at(domain_, x);
  };
  Slicer slicer(std::size_t{1} << 16U, look);
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    if (is_lattice(sources_[s])) {
      const BlockSource& block = *sources_[s].block;
      const std::uint64_t room = lattice_site_count(block);
      counts_.push_back(block.count.value_or(room));
      if (counts_.back() > room) return false;
    } else {
      made_source_.reset();
      made_ = {};
      made_ = make(sources_[s], findings, notes);
      if (!findings.empty() || !go_on(made_.id, slicer.largest_id())) return false;
      made_source_ = s;
      counts_.push_back(made_.position.size());
    }
    hand_out(s, slicer);
  }
  slicer.finish();
  if (!all_inside || !has_room_for_pairs(pairs.most_pairs(size()), options)) return false;
  warnings.insert(warnings.end(), notes.begin(), notes.end());
  return true;
}

std::uint64_t SourceSlices::size() const { return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0}); }

Expected<void> SourceSlices::visit(std::size_t rows, const Take& take) const {
  std::uint64_t identity = 0;
  const Take take_noted = [&](const ParticleSlice& slice) {
    identity += slice.identity();
    take(slice);
  };
  Slicer slicer(rows, take_noted);
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    if (auto held = is_lattice(sources_[s]) ? Expected<void>() : hold(s); !held) return held;
    hand_out(s, slicer);
  }
  slicer.finish();
  if (identity != identity_) return fail(Error::Kind::io, "particles", "a file of them has changed while it was read");
  return {};
}

// The source's particles, once the slice before is filled, as many as counted.
void SourceSlices::hand_out(std::size_t source, Slicer& to) const {
  const ParticleSource& of = sources_[source];
  static const Made kNone;
  const Made& made = is_lattice(of) ? kNone : made_;
  for (std::uint64_t first = 0; first < counts_[source];) {
    const std::uint64_t count = std::min(counts_[source] - first, to.room());
    if (is_lattice(of)) {
      append_lattice(*of.block, domain_, first, count, to.positions());
    } else {
      Slicer::append(to.positions(), made.position, first, count);
    }
    to.complete(of, made, first);
    first += count;
  }
}

// Makes a source, where it is not the one that was made last.
Expected<void> SourceSlices::hold(std::size_t source) const {
  if (made_source_ == source) return {};
  made_source_.reset();
  made_ = {};
  Findings findings(sources_[source].path);
  std::vector<Finding> known;  // warnings
  made_ = make(sources_[source], findings, known);
  if (!findings.empty()) return fail(Error{Error::Kind::bad_input, findings.take()});
  if (made_.position.size() != counts_[source])
    return fail(Error::Kind::io, sources_[source].file_name, "has changed while it was read");
  made_source_ = source;
  return {};
}

SourceSlices::Made SourceSlices::make(const ParticleSource& source, Findings& findings,
                                      std::vector<Finding>& warnings) const {
  Made made;
  if (source.block) {
    made.position = block_centres(*source.block, domain_, findings);
  } else if (source.cluster) {
    ClusterParticles cluster = make_cluster(*source.cluster, materials_[*source.rules.material].mass, attraction_);
    made.position = std::move(cluster.position);
    made.velocity = std::move(cluster.velocity);
    for (Vec3d& v : made.velocity) v += source.rules.velocity;
  } else {
    FileParticles read = read_particle_file(source.file, source.file_name, source.rules, findings, warnings);
    if (read.box) check_box(*read.box, source.file_name, domain_, findings, warnings);
    made = {std::move(read.id), std::move(read.material), std::move(read.position), std::move(read.velocity)};
  }
  return made;
}

// Of the particles; of all materials where a file may name any.
double SourceSlices::largest_radius() const {
  double radius = 0;
  for (const ParticleSource& source : sources_) {
    for (std::size_t m = 0; m < materials_.size(); ++m) {
      if (source.file.empty() ? m == *source.rules.material : materials_[m].is_of_particles())
        radius = std::max(radius, materials_[m].radius);
    }
  }
  return radius;
}

double SourceSlices::expected_size() const {
  double particles = 0;
  for (const ParticleSource& source : sources_) particles += expected_count(source);
  return particles;
}

}  // namespace hooke::scene
