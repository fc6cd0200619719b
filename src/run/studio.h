// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>

#include "hooke/base/expected.h"
#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/render/renderer.h"
#include "hooke/run/picture_arguments.h"

namespace hooke::run {

/// Draws the pictures of one run: holds the renderer and what stays the same between pictures. Belongs to the thread
/// that made it.
class Studio {
 public:
  /// bad_input where OpenGL is missing or can't draw pictures of this size. `linear`: for linear_picture(), else for
  /// picture().
  static Expected<Studio> open(const PictureArguments& arguments, bool linear = false);

  /// `first`: the first snapshot of the run, which determines scales and camera. `scene` must outlive the studio.
  void set_scene(const Scene& scene, const ParticleSet& first);

  /// Frames what particles do at these times of the run, at least one, instead of what its start lets expect.
  void frame_action(std::span<const ParticleSet> moments);

  /// The picture at `time` (s), with its legend. To be called after set_scene().
  Expected<render::Image> picture(const ParticleSet& particles, double time);
  /// The same in linear light, without a legend.
  Expected<render::LinearImage> linear_picture(const ParticleSet& particles, double time);

  const render::RenderFigures& figures() const { return figures_; }
  std::string device() const { return renderer_->device(); }

 private:
  Studio(const PictureArguments& arguments, std::unique_ptr<render::Renderer> renderer)
      : arguments_(arguments),
        renderer_(std::move(renderer)) {}

  render::Frame frame_at(const ParticleSet& particles, double time) const;

  PictureArguments arguments_;
  std::unique_ptr<render::Renderer> renderer_;
  const Scene* scene_ = nullptr;
  render::Look look_;
  render::RenderFigures figures_;
};

}  // namespace hooke::run
