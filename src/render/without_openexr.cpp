// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Replaces what needs OpenEXR in a build without it.
#include "hooke/render/linear_image.h"

namespace hooke::render {

bool has_openexr() { return false; }

Expected<std::string> encode_exr(const LinearImage&) {
  return fail(Error::Kind::bad_input, "OpenEXR", "is not in this build (HOOKE_WITH_OPENEXR)");
}

}  // namespace hooke::render
