// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/playback.h"

#include <algorithm>
#include <utility>

#include "hooke/render/interpolate.h"

namespace hooke::run {

Expected<ParticleSet> Playback::at(double time) {
  const auto times = run_.times();
  const auto later = std::upper_bound(times.begin(), times.end(), time);
  const std::size_t after = std::min(static_cast<std::size_t>(later - times.begin()), run_.size() - 1);
  const std::size_t before = after > 0 && times[after] > time ? after - 1 : after;
  if (auto read = load(before_, before); !read) return fail(std::move(read).error());
  if (time == times[before]) return before_->particles;
  if (auto read = load(after_, after); !read) return fail(std::move(read).error());
  return render::interpolate(scene_, {before_->time, before_->particles}, {after_->time, after_->particles}, time);
}

Expected<void> Playback::load(std::optional<Snapshot>& slot, std::size_t index) {
  if (slot && slot->step == run_.steps()[index]) return {};
  if (&slot == &before_ && after_ && after_->step == run_.steps()[index]) {
    std::swap(before_, after_);
    return {};
  }
  auto snapshot = run_.read(index);
  if (!snapshot) return fail(std::move(snapshot).error());
  slot = std::move(*snapshot);
  return {};
}

Expected<std::vector<ParticleSet>> moments_of(const io::RunReader& run) {
  constexpr std::size_t kMoments = 5;
  std::vector<ParticleSet> moments;
  std::optional<std::size_t> before;
  for (std::size_t k = 0; k < kMoments; ++k) {
    const std::size_t index = k * (run.size() - 1) / (kMoments - 1);
    if (before == index) continue;
    auto snapshot = run.read(index);
    if (!snapshot) return fail(std::move(snapshot).error());
    moments.push_back(std::move(snapshot->particles));
    before = index;
  }
  return moments;
}

}  // namespace hooke::run
