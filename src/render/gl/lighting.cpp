// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/gl/lighting.h"

#include "hooke/base/assert.h"
#include "hooke/render/gl/render_programs.h"
#include "hooke/render/gl/surroundings.h"

namespace hooke::render {

void Lighting::use(const gl::Program& program, const Projection& view, const RenderTargets& targets) const {
  HOOKE_ASSERT(frame != nullptr);
  program.use();
  set_picture(program, view);
  set_view(program, view);
  program.read("sun_map", 0, targets.sun_map);
  program.read("water_sun_map", 9, targets.water_sun_map);
  program.set("brightest", targets.brightest());
  program.set("has_water", water ? 1 : 0);
  program.set("sphere_size", sphere_size);
  sun.set(program);
  set_surroundings(program, *frame);
}

}  // namespace hooke::render
