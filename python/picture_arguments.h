// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "arrays.h"
#include "hooke/render/image.h"
#include "hooke/run/picture_arguments.h"

namespace hooke::python {

/// The options of pictures as Python calls them; InputError where one is out of range.
run::PictureArguments to_picture_arguments(std::pair<int, int> size, const std::string& color_by,
                                           const std::optional<std::array<double, 2>>& range, int samples, bool legend,
                                           bool alpha);

/// uint8 of shape (height, width, 3), or 4 with alpha, without a copy of the pixels.
py::array to_array(render::Image image, bool alpha);

}  // namespace hooke::python
