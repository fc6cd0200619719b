// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/render/image.h"

namespace hooke::test {

/// How alike two pictures look: the structural similarity (Z. Wang, A. Bovik, H. Sheikh, E. Simoncelli, "Image quality
/// assessment: from error visibility to structural similarity", 2004), mean over all windows of 8 x 8 pixels, of the
/// worst of the three colours. 1 where pictures are the same; 0 where their sizes differ or are below a window's.
double similarity(const render::Image& a, const render::Image& b);

}  // namespace hooke::test
