// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Replaces what writes pictures and writes into them in a build without OpenGL, where none is ever drawn.
#include "hooke/render/image.h"
#include "hooke/render/legend.h"

namespace hooke::render {

namespace {

Unexpected refuse() {
  return fail(Error::Kind::bad_input, "", "pictures need OpenGL, which is not in this build (HOOKE_WITH_GL)");
}

}  // namespace

Expected<std::string> encode_png(const Image&, bool) { return refuse(); }
Expected<Image> decode_png(const std::string&) { return refuse(); }

void draw_legend(Image&, const ColorScale&) {}
void draw_caption(Image&, const std::string&) {}

}  // namespace hooke::render
