// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "hooke/render/coloring.h"
#include "hooke/render/image.h"

namespace hooke::render {

/// Draws the legend of a picture's colours into its lower right corner: the colour map, the quantity with its unit, and
/// numbers at even steps.
void draw_legend(Image& image, const ColorScale& scale);

/// Writes a line of text into the lower left corner, e.g. the time.
void draw_caption(Image& image, const std::string& text);

}  // namespace hooke::render
