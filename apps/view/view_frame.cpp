// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "view_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <type_traits>

#include "hooke/base/parallel.h"
#include "hooke/core/contacts.h"

namespace hooke::view {
namespace {

constexpr std::size_t kPiece = 8192;  // particles that a thread takes

float length_of(const Vec3f& v) { return std::sqrt(dot(v, v)); }

// Values by place of a range of particles, which are asked for in ascending order.
class Values {
 public:
  Values(const ViewFrame& frame, const ColorRequest& color, const std::vector<Timeline::Birth>& births)
      : frame_(frame),
        color_(color),
        births_(births),
        up_(vec_cast<float>(color.up)),
        floor_(static_cast<float>(color.floor - dot(color.up, frame.origin))) {}

  float at(std::size_t i) {
    switch (color_.by) {
      case Coloring::material:
      case Coloring::speed:
        return length_of(frame_.velocities[i]);
      case Coloring::height:
        return dot(frame_.positions[i], up_) - floor_;
      case Coloring::pressure:
      case Coloring::contacts:
        return of_column(frame_.ids[i]);
      case Coloring::age:
        return age_of(frame_.ids[i]);
      case Coloring::id:
        break;
    }
    return static_cast<float>(frame_.ids[i]);
  }

 private:
  float of_column(std::uint64_t id) {
    if (!color_.column || color_.column->by != color_.by) return 0;
    const std::vector<std::uint64_t>& ids = color_.column->id;
    if (in_column_ >= ids.size() || ids[in_column_] != id) {
      in_column_ = static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
    }
    return in_column_ < ids.size() && ids[in_column_] == id ? color_.column->value[in_column_++] : 0;
  }
  float age_of(std::uint64_t id) {
    while (birth_ + 1 < births_.size() && births_[birth_ + 1].first_id <= id) ++birth_;
    return static_cast<float>(frame_.time - births_[birth_].time);
  }

  const ViewFrame& frame_;
  const ColorRequest& color_;
  const std::vector<Timeline::Birth>& births_;
  Vec3f up_;
  float floor_;
  std::size_t in_column_ = 0, birth_ = 0;
};

}  // namespace

namespace {

// Copies what there is of the particles, with positions relative to the frame's origin. It is subtracted before they
// are rounded to floats: far from 0, that would move them by more than their size.
template <class Real>
Expected<void> copy_particles(const Simulation& simulation, std::vector<Vec3<Real>>& positions,
                              std::vector<Vec3<Real>>& velocities, ViewFrame& frame) {
  const auto count = static_cast<std::size_t>(simulation.particle_count());
  frame.particles.resize(count);
  frame.ids.resize(count);
  frame.materials.resize(count);
  frame.positions.resize(count);
  frame.velocities.resize(count);
  positions.resize(count);
  velocities.resize(count);
  ParticleColumns<Real> columns;
  columns.id = frame.ids.data();
  columns.material = frame.materials.data();
  columns.position = positions.data();
  columns.velocity = velocities.data();
  if (auto copied = simulation.copy_particles(columns); !copied) return copied;
  parallel_ranges(count, kPiece, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      frame.positions[i] = vec_cast<float>(vec_cast<double>(positions[i]) - frame.origin);
      if constexpr (!std::is_same_v<Real, float>) frame.velocities[i] = vec_cast<float>(velocities[i]);
    }
  });
  return {};
}

}  // namespace

Expected<void> fill_frame(const Simulation& simulation, const Timeline& timeline, const ColorRequest& color,
                          const Vec3d& origin, ViewFrame& frame) {
  const auto count = static_cast<std::size_t>(simulation.particle_count());
  frame.steps = timeline.steps();
  frame.step_count = simulation.step_count();
  frame.time = simulation.time();
  frame.origin = origin;
  frame.poses.assign(simulation.collider_poses().begin(), simulation.collider_poses().end());
  const bool single = simulation.backend_info().precision == Precision::single_precision;
  auto copied = single ? copy_particles(simulation, frame.positions, frame.velocities, frame)
                       : copy_particles(simulation, frame.double_positions, frame.double_velocities, frame);
  if (!copied) return copied;
  const auto& structure = simulation.scene().structure;
  frame.snapshot = structure && !structure->surfaces.empty() ? simulation.snapshot() : nullptr;

  // Of materials, the value is the share of white of fast water.
  const bool by_material = color.by == Coloring::material;
  const double low = by_material ? 0.35 * color.foam_speed : color.low;
  const double high = by_material ? 0.9 * color.foam_speed : color.high;
  const auto scale = static_cast<float>(1 / (high - low));
  std::mutex mutex;
  frame.lowest = std::numeric_limits<double>::infinity();
  frame.highest = -frame.lowest;
  parallel_ranges(count, kPiece, [&](std::size_t first, std::size_t last) {
    Values values(frame, color, timeline.births());
    float least = std::numeric_limits<float>::infinity(), most = -least;
    for (std::size_t i = first; i < last; ++i) {
      const float value = values.at(i);
      least = std::min(least, value);
      most = std::max(most, value);
      float share = (value - static_cast<float>(low)) * scale;
      if (by_material) share = share > 0 ? std::min(share * share, 1.0f) : 0;
      const Vec3f& x = frame.positions[i];
      frame.particles[i] = {x.x, x.y, x.z, render::live_tag(frame.materials[i], share)};
    }
    const std::lock_guard lock(mutex);
    frame.lowest = std::min(frame.lowest, static_cast<double>(least));
    frame.highest = std::max(frame.highest, static_cast<double>(most));
  });
  return {};
}

ColorColumn contact_column(const Scene& scene, const Snapshot& snapshot, std::span<const std::uint64_t> broken_springs,
                           Coloring by) {
  ColorColumn column{by, snapshot.particles.id, {}};
  const ContactFigures figures = contact_figures(scene, snapshot.particles, {snapshot.time, broken_springs});
  if (by == Coloring::pressure) {
    for (const double p : figures.pressure) column.value.push_back(static_cast<float>(p));
  } else {
    for (const std::uint32_t n : figures.count) column.value.push_back(static_cast<float>(n));
  }
  return column;
}

}  // namespace hooke::view
