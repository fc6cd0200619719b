// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/studio.h"

#include <fmt/format.h>

#include "hooke/base/assert.h"
#include "hooke/render/action.h"
#include "hooke/render/legend.h"
#include "hooke/run/gl_loader.h"

namespace hooke::run {

Expected<Studio> Studio::open(const PictureArguments& arguments, bool linear) {
  auto renderer = load_gl_renderer({arguments.width, arguments.height, arguments.samples, linear});
  if (!renderer) return fail(std::move(renderer).error());
  return Studio(arguments, std::move(*renderer));
}

void Studio::set_scene(const Scene& scene, const ParticleSet& first) {
  scene_ = &scene;
  look_ = render::make_look(scene, first, arguments_.color_by, arguments_.range);
}

void Studio::frame_action(std::span<const ParticleSet> moments) {
  HOOKE_ASSERT(scene_ != nullptr);
  look_.action = render::seen_action_box(*scene_, moments);
}

render::Frame Studio::frame_at(const ParticleSet& particles, double time) const {
  HOOKE_ASSERT(scene_ != nullptr);
  const double aspect = static_cast<double>(arguments_.width) / arguments_.height;
  render::Frame frame = render::make_frame(*scene_, particles, time, look_, aspect);
  if (arguments_.alpha) {
    frame.transparent = true;
    frame.ground.reset();
  }
  return frame;
}

Expected<render::LinearImage> Studio::linear_picture(const ParticleSet& particles, double time) {
  auto image = renderer_->render_linear(frame_at(particles, time));
  figures_ = renderer_->figures();
  return image;
}

Expected<render::Image> Studio::picture(const ParticleSet& particles, double time) {
  const render::Frame frame = frame_at(particles, time);
  auto image = renderer_->render(frame);
  if (!image) return image;
  figures_ = renderer_->figures();
  const bool legend = arguments_.legend && !arguments_.alpha;  // nothing to write it on
  if (frame.scale && legend) render::draw_legend(*image, *frame.scale);
  if (legend) render::draw_caption(*image, fmt::format("{:.2f} s", time));
  return image;
}

}  // namespace hooke::run
