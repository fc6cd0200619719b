// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/render/gl/gl_buffers.h"
#include "hooke/render/visible_spheres.h"

namespace hooke::render {

/// The spheres of a frame that are seen from one side, the eye's or the sun's, on the device by kind. Water hides no
/// other spheres, since they show through it.
class SeenSpheres {
 public:
  /// Which ones are seen; needs no OpenGL. `spheres` must live until upload().
  void find(std::span<const Sphere> spheres, const Projection& from);
  void upload();

  /// Those of a kind, after upload().
  const SphereBuffer& of(SphereKind kind) const { return buffers_[static_cast<std::size_t>(kind)]; }
  bool has(SphereKind kind) const { return !of(kind).empty(); }
  std::size_t count() const { return solid_.size() + water_.size(); }
  /// Indices into the frame's spheres, of water or of all others.
  std::span<const std::uint32_t> indices(bool water) const { return water ? water_ : solid_; }

 private:
  std::span<const Sphere> spheres_;
  std::vector<std::uint32_t> solid_, water_;
  std::array<SphereBuffer, 4> buffers_;
};

}  // namespace hooke::render
