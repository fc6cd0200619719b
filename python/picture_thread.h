// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

#include "hooke/run/studio.h"

namespace hooke::python {

/// Runs a task on the one thread that draws, and waits for it: OpenGL belongs to the thread that opened it, and Python
/// calls from any. To be called without the GIL where the task may take long; the task must not need it. False, and the
/// task is not run, in a process that was forked from the thread's.
bool on_picture_thread(const std::function<void()>& task);

/// Draws the pictures of one scene, from any thread, one at a time.
class PictureMaker {
 public:
  PictureMaker() = default;
  ~PictureMaker() { close(); }
  PictureMaker(const PictureMaker&) = delete;
  PictureMaker& operator=(const PictureMaker&) = delete;

  /// Forgets the scene.
  void close();

  /// `scene` must be the same for all pictures and outlive the maker. Scales and camera follow from `first`, unless
  /// there was a picture with the same arguments before; `moments`, where not null, are what the camera has to see.
  Expected<render::Image> picture(const run::PictureArguments& arguments, const Scene& scene, const ParticleSet& first,
                                  const std::vector<ParticleSet>* moments, const ParticleSet& now, double time);

 private:
  std::unique_ptr<run::Studio> studio_;
  run::PictureArguments arguments_;
};

}  // namespace hooke::python
